#!/usr/bin/env bash
# Runs apt-get as root and without questions. Where another package manager is at work, it waits, up to ten minutes.
#   tools/apt_get.sh update
#   tools/apt_get.sh install -y --no-install-recommends PACKAGE...
set -uo pipefail

as_root=()
((EUID == 0)) || as_root=(sudo)
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -qq -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=600)

errors=$(mktemp)
trap 'rm -f "$errors"' EXIT
for ((waited = 0;; waited += 5)); do
  code=0
  "${apt[@]}" "$@" < /dev/null 2> "$errors" || code=$?
  # apt-get itself waits for dpkg's lock alone: without the locks of its lists and downloads it fails at once.
  if ((code == 0 || waited >= 600)) || ! grep -q 'Could not get lock' "$errors"; then
    cat "$errors" >&2
    exit $code
  fi
  ((waited > 0)) || echo "Waiting until another package manager is done" >&2
  sleep 5
done
