#!/usr/bin/env bash
# Checks format, includes, and names and likely bugs by clang-tidy.
#   tools/lint.sh BUILD_FOLDER [JOBS]    the folder must be configured: compile_commands.json tells how files are compiled
set -euo pipefail
build=${1:?give the build folder}
jobs=${2:-$(nproc)}
cd "$(dirname "$0")/.."

echo "Lint: format"
git ls-files -z --cached --others --exclude-standard 'src/*.[ch]pp' 'tests/*.[ch]pp' 'bench/*.[ch]pp' |
  xargs -0 -r clang-format --dry-run -Werror

echo "Lint: includes"
python3 tools/check_includes.py

echo "Lint: clang-tidy"
# GCC's flags are passed on: those that Clang does not know are no finding. Largest files first, to end together.
python3 -c '
import json, os, sys
files = {os.path.join(c["directory"], c["file"]) for c in json.load(open(sys.argv[1]))}
own = [f for f in files if f.startswith(os.getcwd() + "/") and "/build/" not in f]
print(*sorted(own, key=os.path.getsize, reverse=True), sep="\n")' "$build/compile_commands.json" |
  xargs -r -d '\n' -n 1 -P "$jobs" clang-tidy --quiet -p "$build" --extra-arg=-Wno-unknown-warning-option 2> >(grep -vE '^[0-9]+ warnings? (generated|treated)' >&2)
echo "Lint: all clean"
