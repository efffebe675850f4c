#!/usr/bin/env bash
# Prints how many compilers may run at once: one a core, but each needs about 1.5 GB with Eigen and Catch2.
set -euo pipefail
kib_a_job=1500000

cores=$(nproc)
available=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
# A container may hold less than the machine has.
limit_file=/sys/fs/cgroup/memory.max
if [[ -r $limit_file && $(<"$limit_file") != max ]]; then
  used=$(cat /sys/fs/cgroup/memory.current 2>/dev/null || echo 0)
  left=$((($(<"$limit_file") - used) / 1024))
  if ((left < available)); then available=$left; fi
fi

jobs=$((available / kib_a_job))
if ((jobs > cores)); then jobs=$cores; fi
if ((jobs < 1)); then jobs=1; fi
echo "$jobs"
