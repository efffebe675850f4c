#!/usr/bin/env bash
# Checks format, includes, and names and likely bugs by clang-tidy.
#   tools/lint.sh --quick                             format and includes alone: seconds
#   tools/lint.sh BUILD_FOLDER [JOBS [FOLDER...]]
# The build folder must be configured: compile_commands.json says how files are compiled. Folders (src, tests, bench, python)
# limit what clang-tidy reads, which takes seconds per file; without them it reads all.
set -euo pipefail
build=${1:?give the build folder, or --quick}
jobs=${2:-$(nproc)}
folders=("${@:3}")
cd "$(dirname "$0")/.."

echo "Lint: format"
git ls-files -z --cached --others --exclude-standard 'src/*.[ch]pp' 'tests/*.[ch]pp' 'tests/*.c' 'bench/*.[ch]pp' 'python/*.[ch]pp' 'include/*.h*' 'examples/*.[ch]*' |
  xargs -0 -r clang-format --dry-run -Werror

echo "Lint: includes"
python3 tools/check_includes.py

[[ $build != --quick ]] || exit 0

echo "Lint: clang-tidy"
# GCC's flags are passed on: those that Clang does not know are no finding. Where CMake compiles several sources at once
# (CMAKE_UNITY_BUILD), the files that include them are in the build folder, and come first: they take longest.
python3 -c '
import json, os, sys
files = {os.path.join(c["directory"], c["file"]) for c in json.load(open(sys.argv[1]))}
build = os.path.dirname(os.path.abspath(sys.argv[1])) + "/"
made = {f for f in files if f.startswith(build)}
folder_of = {f: os.path.relpath(f, build if f in made else os.getcwd()) for f in files}
own = [f for f in files if folder_of[f].startswith(tuple(sys.argv[2:])) or not sys.argv[2:]]
own = [f for f in own if f not in made or "/Unity/" in folder_of[f]]
print(*sorted(own, key=lambda f: (f in made, os.path.getsize(f)), reverse=True), sep="\n")' "$build/compile_commands.json" "${folders[@]}" |
  xargs -r -d '\n' -n 1 -P "$jobs" clang-tidy --quiet -p "$build" --extra-arg=-Wno-unknown-warning-option 2> >(grep -vE '^[0-9]+ warnings? (generated|treated)' >&2)
echo "Lint: all clean"
