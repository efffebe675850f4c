#!/usr/bin/env python3
"""A guard for changes that must not change results: lists what a program writes, and compares two such lists.

    tools/same_results.py list build/release/bin/holdfast --output before    # before the change
    tools/same_results.py compare before build/release/bin/holdfast          # after it

`list` runs the program on the bundled inputs: every analysis, engine and command. It prints one line for each text and
for each dataset and attribute of the results files, with its hash. With --output, it also keeps what was written in a
folder, from which `compare` explains differences; from the lines alone, it names them. `compare` takes a program, such a
folder, or a file of such lines on either side, and runs of a program what the other side has. It exits with 0 when both are
the same, and with 1 when they differ or a program is missing. The table LEFT_OUT in results_listing.py says what
is not compared.
"""
import argparse
import collections
import os
import pathlib
import sys
import tempfile
import time

import h5py
import numpy as np

from recorded_runs import ENGINES, Run, chosen_runs, missing_engines, write_inputs
from results_listing import attribute_value, is_same, lines_of_run

MOST_SHOWN = 40
LISTING = "listing.txt"
TITLE = "# run, file, object, description, hash"


class Listing:
    """Lines by (run, file, object), in their order, and the folder of what was written, if it was kept."""

    def __init__(self, lines, folder=None):
        self.lines = {tuple(line[:3]): tuple(line[3:]) for line in lines}
        self.folder = folder

    def runs(self):
        return list(dict.fromkeys(run for run, _, _ in self.lines))

    def limited_to(self, runs):
        return Listing([(*key, *value) for key, value in self.lines.items() if key[0] in runs], self.folder)

    def path(self, key):
        path = self.folder and self.folder / "runs" / key[0] / key[1]
        return path if path and path.is_file() else None


def text_of(listing):
    return "\n".join([TITLE, *("\t".join((*key, *value)) for key, value in listing.lines.items()), ""])


def read_listing(path):
    """Of a folder the files are listed anew, so that a change of this tool does not matter."""
    if path.is_dir():
        folders = sorted(folder for folder in path.glob("runs/*") if folder.name != "inputs")
        if not folders:
            sys.exit(f"{path}: is no folder of `list PROGRAM --output FOLDER`")
        return Listing([line for folder in folders for line in lines_of_run(folder)], path)
    lines = [line.split("\t") for line in path.read_text(encoding="utf-8").split("\n")[1:] if line]
    return Listing(lines)


def is_listing(path):
    if path.is_dir():
        return True
    with path.open("rb") as file:
        return file.readline().decode(errors="replace").strip() == TITLE


def usable_program(path):
    path = pathlib.Path(path)
    if not path.is_file() or not os.access(path, os.X_OK):
        sys.exit(f"{path}: there is no such program")
    return path.resolve()


def run_all(program, folder, runs, threads):
    """Runs the program, each run in its folder below `folder`, and lists what was written."""
    without = missing_engines(program)
    write_inputs(folder / "runs/inputs")
    lines = []
    for name, act in runs.items():
        if ENGINES.get(name) in without:
            print(f"{name}: left out, because the engine {ENGINES[name]} is missing", file=sys.stderr)
            continue
        run = Run(program, folder / "runs" / name, threads)
        begin = time.monotonic()
        act(run)
        lines += lines_of_run(run.folder)
        if sys.stderr.isatty():
            print(f"{name}: {time.monotonic() - begin:.1f} s", file=sys.stderr)
    listing = Listing(lines, folder)
    (folder / LISTING).write_text(text_of(listing), encoding="utf-8")
    return listing


def first_entry(left, right):
    """Where two arrays of one type and shape differ, in words; None if they do not."""
    left, right = np.ascontiguousarray(left).reshape(-1), np.ascontiguousarray(right).reshape(-1)
    width = left.dtype.itemsize
    apart = np.flatnonzero((left.view(np.uint8).reshape(-1, width) != right.view(np.uint8).reshape(-1, width)).any(axis=1))
    if not len(apart):
        return None
    more = f", and {len(apart) - 1} more of {len(left)}" if len(apart) > 1 else ""
    return f"differs at entry {apart[0]}: {left[apart[0]]!s}, {right[apart[0]]!s}{more}"


def first_line(left, right):
    """Where two texts differ, in words."""
    left, right = left.split("\n"), right.split("\n")
    number = next((i for i, (a, b) in enumerate(zip(left, right)) if a != b), min(len(left), len(right)))
    shown = [lines[number] if number < len(lines) else "(ended)" for lines in (left, right)]
    begin = max(0, len(os.path.commonprefix(shown)) - 40)  # long lines from near where they differ
    return f"line {number + 1}: " + " | ".join(("..." if begin else "") + line[begin:begin + 120] for line in shown)


def explain_object(name, files):
    """How an object with the same description differs in two open results files."""
    if name == "state hashes":
        return first_entry(*(file["worlds/state_hash"][:] for file in files)).replace("entry", "world")
    owner, _, attribute = name.partition("@")
    if attribute:
        return ", ".join(str(attribute_value(file[owner], attribute)) for file in files)
    values = [np.asarray(file[name][()]) for file in files]
    return first_entry(*values) or "has the same values, stored in other bytes"


def place_of(key, side):
    """A run, a file or an object in words."""
    run, file, name = (*key, "", "")[:3]
    if not file:
        return f"run {run}"
    place = f"{file} of run {run}"
    if name in ("", "text"):
        return place
    kind = "attribute" if "@" in name else side.lines[key][0].split()[0].rstrip(",") if name.startswith("/") else ""
    return f"{kind} {name} of {place}".lstrip()


def explain(key, sides):
    """One difference in words."""
    name = key[2]
    what = place_of(key, sides[0])
    (left, left_hash), (right, right_hash) = (side.lines[key] for side in sides)
    if left != right and name != "text":
        return f"{what}: {left} | {right}"
    paths = [side.path(key) for side in sides]
    if not all(paths):
        return f"{what}: differs, {left_hash[:12]} | {right_hash[:12]}"
    if name == "text":
        return f"{what}: {first_line(*(path.read_text(encoding='utf-8', errors='surrogateescape') for path in paths))}"
    with h5py.File(paths[0], "r") as one, h5py.File(paths[1], "r") as two:
        return f"{what}: {explain_object(name, (one, two))}"


def only_on_one_side(sides):
    """Runs, files and objects that the other side does not have; what belongs to a missing one is not named as well."""
    for side, other, words in ((sides[0], sides[1], "only on the left"), (sides[1], sides[0], "only on the right")):
        others = {part for key in other.lines for part in parts_of(key)}
        missing = (next((part for part in parts_of(key) if part not in others), None) for key in side.lines)
        yield from (f"{place_of(part, side)}: {words}" for part in dict.fromkeys(missing) if part)


def parts_of(key):
    """A run, its file, an object of that, an attribute of that: as far as the key goes."""
    owner = (*key[:2], key[2].partition("@")[0])
    return dict.fromkeys((key[:1], key[:2], owner, key))


def different_order(sides):
    """Files whose objects are the same and come in another order."""
    orders = []
    for side in sides:
        order = collections.defaultdict(list)
        for run, file, name in side.lines:
            order[run, file].append(name)
        orders.append(order)
    for run, file in orders[0]:
        left, right = orders[0][run, file], orders[1].get((run, file), [])
        if left != right and set(left) == set(right):
            at = next(i for i, (a, b) in enumerate(zip(left, right)) if a != b)
            yield f"order of objects of {file} of run {run}: {left[at]} | {right[at]}"


def differences(sides):
    yield from only_on_one_side(sides)
    yield from different_order(sides)
    for key, value in sides[0].lines.items():
        if key in sides[1].lines and not is_same(key[2], value, sides[1].lines[key]):
            yield explain(key, sides)


def told_same(listing):
    files = len({key[:2] for key in listing.lines if key[1].endswith(".h5")})
    sets = sum(description.startswith("dataset") for description, _ in listing.lines.values())
    worlds = sum(int(description.split()[0]) for (_, _, name), (description, _) in listing.lines.items() if name == "state hashes")
    return f"same: {files} results files, {sets} datasets, {worlds} worlds' state hashes"


def list_command(options):
    program = usable_program(options.program)
    runs = runs_of(options)
    if options.output:
        folder = pathlib.Path(options.output).resolve()
        if folder.exists() and any(folder.iterdir()):
            sys.exit(f"{options.output}: is not empty; give the name of a new folder")
        run_all(program, folder, runs, options.threads)
        return 0
    with tempfile.TemporaryDirectory(prefix="holdfast-") as folder:
        print(text_of(run_all(program, pathlib.Path(folder), runs, options.threads)), end="")
    return 0


def runs_of(options, listed=None):
    """The runs that are asked for; without a wish, those of the other side's listing."""
    if listed is not None and not options.only and not options.all:
        names = set(listed.runs())
        return {name: act for name, act in chosen_runs((), True).items() if name in names}
    runs = chosen_runs(options.only, options.all)
    if not runs:
        sys.exit(f"{', '.join(options.only)}: no such run; there are {', '.join(chosen_runs((), True))}")
    return runs


def compare_command(options):
    given = [pathlib.Path(side) for side in options.sides]
    for path in given:
        if not path.exists():
            sys.exit(f"{path}: there is no such program or listing")
    listings = [read_listing(path) if is_listing(path) else None for path in given]
    listed = next((listing for listing in listings if listing), None)
    runs = runs_of(options, listed)
    with tempfile.TemporaryDirectory(prefix="holdfast-") as folder:
        sides = [listing or run_all(usable_program(path), pathlib.Path(folder) / str(i), runs, options.threads)
                 for i, (path, listing) in enumerate(zip(given, listings))]
        if options.only:
            sides = [side.limited_to(runs) for side in sides]
        found = list(differences(sides))
    print(*found[:MOST_SHOWN], sep="\n", end="\n" if found else "")
    if len(found) > MOST_SHOWN:
        print(f"and {len(found) - MOST_SHOWN} more differences")
    if not found:
        print(told_same(sides[0]))
    return 1 if found else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--only", action="append", default=[], metavar="NAME",
                        help="run of this name, or of names that match, such as 'margin*'; can be given several times")
    common.add_argument("--all", action="store_true", help="also the longer runs: higher accuracies, more layouts")
    common.add_argument("--threads", type=int, default=1, help="threads of the program (default: %(default)s)")
    one = commands.add_parser("list", parents=[common], help="run a program and list what it writes")
    one.add_argument("program", help="the program holdfast")
    one.add_argument("--output", metavar="FOLDER", help="new folder for the listing and all that was written")
    one.set_defaults(act=list_command)
    two = commands.add_parser("compare", parents=[common], help="compare programs or listings")
    two.add_argument("sides", nargs=2, metavar="PROGRAM_OR_LISTING", help="program, folder of `list --output`, or file of what `list` prints")
    two.set_defaults(act=compare_command)
    options = parser.parse_args()
    return options.act(options)


if __name__ == "__main__":
    sys.exit(main())
