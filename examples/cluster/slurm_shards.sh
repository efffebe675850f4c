#!/bin/bash
# A job array of shards: each task simulates one of them. Slurm puts a task of a lost node into the queue again, and it
# goes on where it was.
#
#   sbatch --array=1-64 examples/cluster/slurm_shards.sh layouts/ road results.h5
#
# When all are done: holdfast merge results.h5
#SBATCH --job-name=holdfast
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail
layouts=${1:?give the folder of the layouts}
norm=${2:?give the norm}
results=${3:?give the results file}

# N is what the array was started with; a task that is started alone later belongs to the same N.
exec holdfast screen --layouts "$layouts" --norm "$norm" -o "$results" --part "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX" \
  --resume --quiet --threads "${SLURM_CPUS_PER_TASK:-1}"
