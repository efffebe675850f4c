#!/bin/bash
# Shards by GNU parallel, on this machine or on others that see the same folder; then the merge. What was interrupted goes
# on when the same command is given again.
#
#   examples/cluster/parallel_shards.sh 8 layouts/ road results.h5 [options of parallel, such as --sshloginfile nodes.txt]
set -euo pipefail
shards=${1:?give the number of shards}
layouts=${2:?give the folder of the layouts}
norm=${3:?give the norm}
results=${4:?give the results file}

parallel --will-cite --halt soon,fail=1 --workdir . "${@:5}" \
  holdfast screen --layouts "$layouts" --norm "$norm" -o "$results" --part "{}/$shards" --resume --quiet --threads 1 \
  ::: $(seq "$shards")
holdfast merge "$results"
