#!/usr/bin/python3
"""What half and twice of each tuned number of the native engine change.

The sources are copied and built with numbers that are read from the environment. Each number is then halved and doubled,
and compared with the engine as it is: measurements of `holdfast validate --quick` that no longer pass or pass now, and
of the bundled layouts under the road accelerations, at screening and at standard, verdicts, contact iterations and steps,
which are the work without the noise of a clock. Verdicts of up to 3 of 136 worlds change with any bit.

Sizes of arrays, and constants that are made of others, are left out. About a quarter of a minute of processor time per value.

Example: bench/sensitivity.py --only kSmall kCheckEvery     # all numbers without --only: half an hour on two cores
"""
import argparse
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import parameters_page  # noqa: E402
from tables import table_of  # noqa: E402

SIZES = {"kKnownBalances", "kAndersonDepth"}
LAYOUTS = ("configs/layouts", "bench/layouts")
ACCURACIES = ("screening", "standard")
NUMBER = r"\d+(?:\.\d*)?(?:e[+-]?\d+)?"
# Reads a number from TUNED, "name=value" separated by commas.
TUNED = """
#include <cstdlib>
#include <cstring>
template <class Number>
Number tuned(const char* name, Number value) {
  const char* const given = std::getenv("TUNED");
  if (given == nullptr) return value;
  const std::size_t size = std::strlen(name);
  for (const char* at = given; (at = std::strstr(at, name)) != nullptr; at += size)
    if ((at == given || at[-1] == ',') && at[size] == '=') return static_cast<Number>(std::atof(at + size + 1));
  return value;
}
"""


@dataclass
class Number:
    name: str
    value: float
    is_whole: bool

    def times(self, factor):
        return max(1, round(self.value * factor)) if self.is_whole else self.value * factor


def tuned_sources(tree):
    """Makes the numbers of the copied sources readable from the environment. Returns them."""
    numbers = []

    def declared(match):
        indent, kind, name, value = match.groups()
        if name in SIZES or not parameters_page.tuned(value):
            return match[0].replace("constexpr", "const") if "k" in value else match[0]
        numbers.append(Number(name, float(value), kind not in ("double",)))
        return f'{indent}const {kind} {name} = tuned<{kind}>("{name}", {value});'

    declaration = re.compile(r"^((?:inline )?)constexpr ([\w:]+) (k\w+) = ([^;]+);", re.MULTILINE)
    constants = tree / parameters_page.CONSTANTS
    text = declaration.sub(declared, constants.read_text())
    constants.write_text(text.replace("#pragma once\n", "#pragma once\n" + TUNED, 1))
    for path in (tree / parameters_page.NATIVE).rglob("*.cpp"):
        text = path.read_text()
        changed = re.sub(r"constexpr (double|int) (\w+ = [^;]*\bk[A-Z]\w+[^;]*);", r"const \1 \2;", text)
        if changed != text:
            path.write_text(changed)

    options = tree / parameters_page.OPTIONS.replace(".hpp", ".cpp")
    lines, accuracy = [], ""
    for line in options.read_text().splitlines():
        case = re.search(r"case Accuracy::(\w+):", line)
        accuracy = case[1] if case else accuracy
        given = re.fullmatch(rf"( +options\.(?:\w+\.)?\w+ = (?:options[\w.]+ = )?)({NUMBER});", line)
        if given:
            name = f"{accuracy}.{given[1].split('options.')[1].split(' ')[0]}"
            numbers.append(Number(name, float(given[2]), not re.search("[.e]", given[2])))
            line = f'{given[1]}tuned("{name}", {given[2]});'
        lines.append(line)
    options.write_text("\n".join(lines) + "\n")
    return numbers


def build(folder):
    """A program with numbers that can be set, and these."""
    tree = folder / "tree"
    shutil.rmtree(tree / "src", ignore_errors=True)
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, files.split("\0")):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, tree / name)
    numbers = tuned_sources(tree)
    for command in (["cmake", "--preset", "release", "-DBUILD_TESTING=OFF"],
                    ["cmake", "--build", "--preset", "release", "--target", "holdfast", "-j", str(os.cpu_count())]):
        done = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stdout[-4000:] + done.stderr)
    return tree / "build/release/bin/holdfast", numbers


def measured(program, folder, tuned):
    """What the program finds with other numbers: which measurements pass, and worlds by accuracy."""
    environment = dict(os.environ, TUNED=tuned)

    def lines(*arguments):
        done = subprocess.run([program, *arguments, "--json"], capture_output=True, text=True, env=environment, check=False)
        if done.returncode > 1:
            sys.exit(f"{tuned}: {done.stderr}")
        return done.stdout

    passes = {(each["case"], each["setting"], each["metric"]): each["pass"]
              for each in json.loads(lines("validate", "--quick", "--engine", "native"))}
    worlds = {}
    for accuracy in ACCURACIES:
        results = folder / f"{tuned.replace('=', '_') or 'as_it_is'}_{accuracy}.h5"
        printed = lines("screen", *(part for path in LAYOUTS for part in ("--layouts", str(ROOT / path))), "--norm", "road",
                        "--no-series", "--accuracy", accuracy, "--threads", "1", "--quiet", "--overwrite", "-o", str(results))
        with h5py.File(results) as file:
            iterations = file["worlds/solve_iterations"][:]
        worlds[accuracy] = sorted((json.loads(line) for line in printed.splitlines()), key=lambda world: world["world"])
        for world, count in zip(worlds[accuracy], iterations):
            world["solve_iterations"] = int(count)
        results.unlink()
    return passes, worlds


def row_of(number, factor, found, base):
    """A row of the table: what is other than in the engine as it is."""
    passes, worlds = found
    lost = sorted({case for (case, setting, metric), good in base[0].items() if good and not passes[case, setting, metric]})
    gained = sum(good and not base[0][key] for key, good in passes.items())
    cells = [f"`{number.name}`", f"{number.value:g}", f"{number.times(factor):g}", ", ".join(f"`{case}`" for case in lost) or "–", str(gained)]
    for accuracy in ACCURACIES:
        now, before = worlds[accuracy], base[1][accuracy]
        cells.append(str(sum(a["verdict"] != b["verdict"] for a, b in zip(now, before))))
        cells.append(f"{sum(a['solve_iterations'] for a in now) / sum(b['solve_iterations'] for b in before):.2f}")
        done = [sum(each["steps"] - each["steps_skipped"] for each in which) for which in (now, before)]
        cells.append(f"{done[0] / done[1]:.2f}")
    return cells


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these numbers alone")
    parser.add_argument("--output", type=Path, default=ROOT / "build/sensitivity", help="folder of the build and of the table")
    arguments = parser.parse_args()
    program, numbers = build(arguments.output)
    names = {number.name for number in numbers}
    unknown = set(arguments.only or []) - names
    if unknown:
        parser.error(f"{', '.join(sorted(unknown))}: one of {', '.join(sorted(names))}")
    wanted = [number for number in numbers if not arguments.only or number.name in arguments.only]
    cases = [(number, factor) for number in wanted for factor in (0.5, 2.0) if number.times(factor) != number.value]
    base = measured(program, arguments.output, "")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        found = threads.map(lambda case: measured(program, arguments.output, f"{case[0].name}={case[0].times(case[1])!r}"), cases)
        rows = []
        for (number, factor), each in zip(cases, found):
            rows.append(row_of(number, factor, each, base))
            print(" | ".join(rows[-1]), flush=True)
    head = ["number", "value", "in place of it", "no longer pass", "pass now"]
    for accuracy in ACCURACIES:
        head += [f"`{accuracy}`: other verdicts", "iterations", "steps"]
    (arguments.output / "table.md").write_text(table_of("Half and twice of each number", head, rows) + "\n")
    print(arguments.output / "table.md")


if __name__ == "__main__":
    main()
