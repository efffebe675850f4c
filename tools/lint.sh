#!/usr/bin/env bash
# Checks format, includes, and names and likely bugs by clang-tidy.
#   tools/lint.sh BUILD_FOLDER [JOBS [FOLDER...]]
# The build folder must be configured: compile_commands.json says how files are compiled. Folders (src, tests, bench, python)
# limit what clang-tidy reads, which takes seconds per file; without them it reads all.
set -euo pipefail
build=${1:?give the build folder}
jobs=${2:-$(nproc)}
folders=("${@:3}")
cd "$(dirname "$0")/.."

echo "Lint: format"
git ls-files -z --cached --others --exclude-standard 'src/*.[ch]pp' 'tests/*.[ch]pp' 'tests/*.c' 'bench/*.[ch]pp' 'python/*.[ch]pp' 'include/*.h*' 'examples/*.[ch]*' |
  xargs -0 -r clang-format --dry-run -Werror

echo "Lint: includes"
python3 tools/check_includes.py

echo "Lint: clang-tidy"
# GCC's flags are passed on: those that Clang does not know are no finding. Largest files first, to end together.
python3 -c '
import json, os, sys
files = {os.path.join(c["directory"], c["file"]) for c in json.load(open(sys.argv[1]))}
tops = tuple(os.getcwd() + "/" + folder for folder in sys.argv[2:] or [""])
own = [f for f in files if f.startswith(tops) and "/build/" not in f]
print(*sorted(own, key=os.path.getsize, reverse=True), sep="\n")' "$build/compile_commands.json" "${folders[@]}" |
  xargs -r -d '\n' -n 1 -P "$jobs" clang-tidy --quiet -p "$build" --extra-arg=-Wno-unknown-warning-option 2> >(grep -vE '^[0-9]+ warnings? (generated|treated)' >&2)
echo "Lint: all clean"
