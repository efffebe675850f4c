#!/usr/bin/python3
"""What half and twice of each tuned number of the native engine change.

The sources are copied and built with numbers that are read from the environment, but for sizes of arrays, for which they
are built anew. Each number is then halved and doubled, and compared with the engine as it is. Compared are measurements of
`holdfast validate --quick` that no longer pass or pass now (for numbers of reference those of all suites but loads). On the
bundled layouts under the road accelerations, at screening and at standard, verdicts are compared, and contact iterations
and steps, which are the work without the noise of a clock. Verdicts of up to 5 of 136 worlds change with any bit.

What is found replaces the rows of these numbers in bench/sensitivity.tsv, of which tools/parameters_page.py makes a table of
docs/physics/parameters.md. Literals that merely guard against rounding, and numbers of forces on walls, are left alone.
About a quarter of a minute of processor time per value.

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

SIZES = {"kKnownBalances", "kAndersonDepth"}
COSINES = {"kParallelFaces", "kNearlyAligned"}  # half and twice of their distance from 1
TABLE = ROOT / "bench/sensitivity.tsv"
LAYOUTS = ("configs/layouts", "bench/layouts")
ACCURACIES = ("screening", "standard")
NUMBER = r"\d+(?:\.\d*)?(?:e[+-]?\d+)?"
# Reads a number from TUNED, "name=value" separated by commas.
TUNED = """
#ifndef HOLDFAST_TUNED
#define HOLDFAST_TUNED
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
#endif
"""


@dataclass
class Number:
    name: str
    value: float
    is_whole: bool

    def times(self, factor):
        if self.name in COSINES:
            return round(1.0 - (1.0 - self.value) / factor, 9)
        return max(1, round(self.value * factor)) if self.is_whole else self.value * factor


def tuned_sources(tree):
    """Makes the numbers of the copied sources readable from the environment. Returns them."""
    numbers = []

    def number_of(name, text, is_whole):
        numbers.append(Number(name, float(text), is_whole))
        return f'tuned("{name}", {text})'

    def declared(match, names=None):
        inline, kind, name, value = match.groups()
        is_wanted = name not in parameters_page.NOT_OF_MOTION and (names is None or name in names)
        if name in SIZES:
            numbers.append(Number(name, float(value), True))
        if name in SIZES or not is_wanted or not parameters_page.tuned(value):
            return match[0].replace("constexpr", "const") if is_wanted and "k" in value else match[0]
        plain = re.match(NUMBER, value)[0]
        return f"{inline}const {kind} {name} = {number_of(name, plain, kind != 'double')}{value[len(plain):]};"

    def with_tuned(path, change):
        text = path.read_text()
        changed = change(text)
        if changed != text:
            lines = changed.splitlines(keepends=True)
            first = max(at for at, line in enumerate(lines) if line.startswith("#include")) + 1
            path.write_text("".join(lines[:first]) + TUNED + "".join(lines[first:]) if "tuned(" in changed else changed)

    declaration = re.compile(r"^((?:inline )?)constexpr ([\w:]+) (k\w+) = ([^;]+);", re.MULTILINE)
    with_tuned(tree / parameters_page.CONSTANTS, lambda text: declaration.sub(declared, text))
    for path, names in parameters_page.ELSEWHERE.items():
        with_tuned(tree / path, lambda text, names=names: declaration.sub(lambda match: declared(match, names), text))
    for path in (tree / parameters_page.NATIVE).rglob("*.cpp"):
        with_tuned(path, lambda text: re.sub(r"constexpr (double|int) (\w+ = [^;]*\bk[A-Z]\w+[^;]*);", r"const \1 \2;", text))

    # Fields of an effort and of an accuracy, what large islands have in place of it, and what accuracies have.
    def field(match):
        return f"{match[1]}{number_of(match[2], match[3], match[1].strip().startswith('int'))};"

    def of_large_islands(match):
        return f"{match[1]}{number_of('large_island.' + match[2], match[3], not re.search('[.e]', match[3]))}"

    def options(text):
        text = re.sub(rf"^(  (?:double|int) (\w+) = )({NUMBER});", lambda match: field(match) if parameters_page.tuned(match[3]) else match[0],
                      text, flags=re.MULTILINE)
        return re.sub(rf"([{{ ]\.(\w+) = )({NUMBER})\b(?=[,}}])",
                      lambda match: of_large_islands(match) if parameters_page.tuned(match[3]) else match[0], text)

    with_tuned(tree / parameters_page.OPTIONS, options)
    given, accuracy = tree / parameters_page.OPTIONS.replace(".hpp", ".cpp"), ""
    lines = []
    for line in given.read_text().splitlines():
        case = re.search(r"case Accuracy::(\w+):", line)
        accuracy = case[1] if case else accuracy
        of_accuracy = re.fullmatch(rf"( +options\.(?:\w+\.)?\w+ = (?:options[\w.]+ = )?)({NUMBER});", line)
        if of_accuracy:
            name = f"{accuracy}.{of_accuracy[1].split('options.')[1].split(' ')[0]}"
            line = f"{of_accuracy[1]}{number_of(name, of_accuracy[2], not re.search('[.e]', of_accuracy[2]))};"
        lines.append(line)
    given.write_text("\n".join(lines) + "\n")
    return numbers


def run(tree, *command):
    done = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stdout[-4000:] + done.stderr)


def program_of(tree):
    """The program, built of the sources as they are."""
    run(tree, "cmake", "--build", "--preset", "release", "--target", "holdfast", "-j", str(os.cpu_count()))
    return tree / "build/release/bin/holdfast"


def kept(program, name):
    """A copy beside the program, which finds its data there."""
    copy = program.with_name(f"holdfast_{name}")
    shutil.copy2(program, copy)
    return copy


def program_with(tree, number, value):
    """A program of its own with another size of an array."""
    constants = tree / parameters_page.CONSTANTS
    before = constants.read_text()
    constants.write_text(re.sub(rf"(\b{number.name} = )[^;]+;", rf"\g<1>{value};", before))
    program = kept(program_of(tree), f"{number.name}_{value}")
    constants.write_text(before)
    return program


def build(folder):
    """Sources with numbers that can be set, their program, and the numbers."""
    tree = folder / "tree"
    shutil.rmtree(tree / "src", ignore_errors=True)
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, files.split("\0")):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, tree / name)
    numbers = tuned_sources(tree)
    run(tree, "cmake", "--preset", "release", "-DBUILD_TESTING=OFF")
    return tree, kept(program_of(tree), "as_it_is"), numbers


def lines_of(program, tuned, *arguments):
    """What the program prints with other numbers."""
    done = subprocess.run([program, *arguments, "--json"], capture_output=True, text=True, check=False,
                          env=dict(os.environ, TUNED=tuned))
    if done.returncode > 1:
        sys.exit(f"{tuned}: {done.stderr}")
    return done.stdout


def is_of_reference(name):
    return name.startswith("reference.")


def passes_of(program, tuned, at_reference):
    """Which measurements pass; quick ones are none at `reference`."""
    which = ("--suite", "slide,tip,rebound,manoeuvre,hard,oscillate") if at_reference else ("--quick",)
    return {(each["case"], each["setting"], each["metric"]): each["pass"]
            for each in json.loads(lines_of(program, tuned, "validate", "--engine", "native", *which))}


def worlds_of(program, folder, tuned):
    """Worlds by accuracy."""
    worlds = {}
    for accuracy in ACCURACIES:
        results = folder / f"{tuned.replace('=', '_') or 'as_it_is'}_{accuracy}.h5"
        printed = lines_of(program, tuned, "screen", *(part for path in LAYOUTS for part in ("--layouts", str(ROOT / path))), "--norm",
                           "road", "--no-series", "--accuracy", accuracy, "--threads", "1", "--quiet", "--overwrite", "-o", str(results))
        with h5py.File(results) as file:
            iterations = file["worlds/solve_iterations"][:]
        worlds[accuracy] = sorted((json.loads(line) for line in printed.splitlines()), key=lambda world: world["world"])
        for world, count in zip(worlds[accuracy], iterations):
            world["solve_iterations"] = int(count)
        results.unlink()
    return worlds


def measured(program, folder, name="", value=0):
    """What the program finds with another number: which measurements pass, and worlds where they have this number."""
    tuned = f"{name}={value!r}" if name else ""
    return passes_of(program, tuned, is_of_reference(name)), None if is_of_reference(name) else worlds_of(program, folder, tuned)


def row_of(number, factor, found, base):
    """A row of the table: what is other than in the engine as it is."""
    (passes, worlds), (passed, before) = found, base
    lost = sorted({case for (case, setting, metric), good in passed.items() if good and not passes[case, setting, metric]})
    gained = sum(good and not passed[key] for key, good in passes.items())
    cells = [number.name, f"{number.value:g}", f"{number.times(factor):g}", " ".join(lost), str(gained)]
    if worlds is None:
        return cells + [""] * 3 * len(ACCURACIES)
    for accuracy in ACCURACIES:
        pairs = list(zip(worlds[accuracy], before[accuracy]))
        cells.append(str(sum(now["verdict"] != then["verdict"] for now, then in pairs)))
        for work in (lambda world: world["solve_iterations"], lambda world: world["steps"] - world["steps_skipped"]):
            cells.append(f"{sum(work(now) for now, _ in pairs) / sum(work(then) for _, then in pairs):.2f}")
    return cells


def replace_rows(rows, names):
    """Writes rows into the table in the tree, in the order of the numbers; those of other numbers stay."""
    head = ["number", "value", "other", "fails_now", "passes_now"]
    head += [f"{accuracy}_{what}" for accuracy in ACCURACIES for what in ("verdicts", "iterations", "steps")]
    measured_now = {row[0] for row in rows}
    kept = [line.split("\t") for line in TABLE.read_text().splitlines()[1:]] if TABLE.exists() else []
    rows = rows + [row for row in kept if row[0] in names and row[0] not in measured_now]
    rows.sort(key=lambda row: (names.index(row[0]), float(row[2])))
    TABLE.write_text("".join("\t".join(row) + "\n" for row in [head, *rows]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these numbers alone")
    parser.add_argument("--build", type=Path, default=ROOT / "build/sensitivity", help="folder of the build")
    arguments = parser.parse_args()
    tree, program, numbers = build(arguments.build)
    names = [number.name for number in numbers]
    unknown = set(arguments.only or []) - set(names)
    if unknown:
        parser.error(f"{', '.join(sorted(unknown))}: one of {', '.join(names)}")
    cases = [(number, factor) for number in numbers if not arguments.only or number.name in arguments.only
             for factor in (0.5, 2.0) if number.times(factor) != number.value]
    sizes = {(number.name, factor): program_with(tree, number, number.times(factor))
             for number, factor in cases if number.name in SIZES}
    bases = {True: (passes_of(program, "", True), None)} if any(is_of_reference(number.name) for number, _ in cases) else {}
    if not all(is_of_reference(number.name) for number, _ in cases):
        bases[False] = measured(program, arguments.build)

    def other(case):
        number, factor = case
        return measured(sizes.get((number.name, factor), program), arguments.build, number.name, number.times(factor))

    rows = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        for (number, factor), found in zip(cases, threads.map(other, cases)):
            rows.append(row_of(number, factor, found, bases[is_of_reference(number.name)]))
            print(" | ".join(rows[-1]), flush=True)
            replace_rows(rows, names)


if __name__ == "__main__":
    main()
