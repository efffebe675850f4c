#!/usr/bin/python3
"""How exact margins are: every layout at shares of each of its margins, and margins beside a plain bisection.

  bench/margin_check.py --layouts configs/layouts [--accuracy screening] [--shares 0.95 1.05] [--bisect]

For margins in place and margins within the limits it counts the cases in which the load does not hold a constant
acceleration of a share below 1 of the margin, or holds one of a share above. With --bisect, margins are found a second time by halving 0 to
1.5 g down to 1 mg, each acceleration as a full simulation of its own, and the differences are printed.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

DIRECTIONS = {"front": (1, 0), "rear": (-1, 0), "left": (0, 1), "right": (0, -1)}  # acceleration of the container
GRAVITY = 9.81  # m/s2
LARGEST = 1.5  # g
MOVED = 0.005  # m
SECONDS = 5.0  # a margin's load has so long to come to rest
CONFIG = "[Screening]\nRunOutSeconds = 0\n"  # the acceleration of a margin does not end
# By the name of a margin in JSON, whether a world holds.
KINDS = {"margins_g": lambda world: world["peak_displacement_m"] <= MOVED,
         "margins_within_limits_g": lambda world: world["verdict"] == "stayed"}


def worlds(program, command, *arguments):
    """The lines that a command prints as JSON."""
    done = subprocess.run([program, command, *map(str, arguments), "--json", "--quiet", "--overwrite"],
                          capture_output=True, text=True, check=False)
    if done.returncode > 1:
        sys.exit(done.stderr)
    return [json.loads(line) for line in done.stdout.splitlines()]


class Loads:
    """Constant accelerations as files, and what becomes of a layout under them."""

    def __init__(self, folder, arguments):
        self.folder, self.arguments = pathlib.Path(folder), arguments
        (self.folder / "config.ini").write_text(CONFIG)

    def hold(self, kind, layout, cases):
        """Whether the layout holds each (direction, size in g)."""
        for i, (direction, size) in enumerate(cases):
            x, y = (size * GRAVITY * part for part in DIRECTIONS[direction])
            (self.folder / f"{i:03}.txt").write_text(f"0 {SECONDS} {x!r} {y!r} 0\n")
        files = [self.folder / f"{i:03}.txt" for i in range(len(cases))]
        found = worlds(self.arguments.program, "screen", "--layouts", layout, "--accelerations", *files, "--no-series",
                       "-c", self.folder / "config.ini", "--accuracy", self.arguments.accuracy, "-o", self.folder / "worlds.h5")
        return [KINDS[kind](world) for world in found]

    def bisect(self, kind, layout):
        """The margins of a layout, all directions at once."""
        known = {direction: [0.0, LARGEST] for direction in DIRECTIONS}
        for direction, held in zip(DIRECTIONS, self.hold(kind, layout, [(direction, LARGEST) for direction in DIRECTIONS])):
            if held:
                known[direction][0] = LARGEST
        while open_ones := [direction for direction, (low, high) in known.items() if high - low > 1e-3]:
            middles = [(direction, sum(known[direction]) / 2) for direction in open_ones]
            for (direction, middle), held in zip(middles, self.hold(kind, layout, middles)):
                known[direction][0 if held else 1] = middle
        return {direction: low for direction, (low, _) in known.items()}


def check(kind, loads, paths, found, shares, bisect):
    """Tries the margins of one kind, and prints how they did."""
    right, differences = {share: [] for share in shares}, []
    for name, line in found.items():
        margins = line[kind]
        cases = [(direction, share * margin) for direction, margin in margins.items() for share in shares]
        for (direction, size), share, held in zip(cases, shares * len(margins), loads.hold(kind, paths[name], cases)):
            if size > LARGEST:
                continue
            right[share].append(held == (share < 1))
            if not right[share][-1]:
                print(f"{name} {direction}: margin {margins[direction]:.3f} g, "
                      f"{'holds' if held else 'does not hold'} {size:.3f} g")
        if bisect:
            exact = loads.bisect(kind, paths[name])
            differences += [margins[direction] - exact[direction] for direction in margins]
    for share, cases in right.items():
        print(f"{kind}: {share} of the margin {'holds' if share < 1 else 'does not hold'} in {sum(cases)} of {len(cases)} cases")
    if differences:
        near = sum(abs(difference) <= 0.01 for difference in differences)
        print(f"{kind}: within 0.01 g of the bisection: {near} of {len(differences)}; the median difference is "
              f"{statistics.median(differences):+.4f} g")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--layouts", nargs="+", required=True)
    parser.add_argument("--accuracy", default="screening")
    parser.add_argument("--shares", nargs="+", type=float, default=[0.95, 1.05])
    parser.add_argument("--bisect", action="store_true")
    parser.add_argument("--program", default="build/release/bin/holdfast")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        loads = Loads(folder, arguments)
        paths = {}
        for given in map(pathlib.Path, arguments.layouts):
            paths |= {path.name: path for path in (sorted(given.glob("*.txt")) if given.is_dir() else [given])}
        lines = worlds(arguments.program, "margins", "--layouts", *paths.values(), "--accuracy", arguments.accuracy, "-o",
                       f"{folder}/margins.h5")
        # Of the layouts that stand under gravity.
        found = {line["layout"]: line for line in lines if "margins_g" in line and min(line["margins_g"].values()) >= 0}
        for kind in KINDS:
            check(kind, loads, paths, found, arguments.shares, arguments.bisect)
    seconds = [line["cpu_seconds"] for line in found.values()]
    print(f"processor time for four directions: median {1e3 * statistics.median(seconds):.0f} ms, "
          f"largest {1e3 * max(seconds):.0f} ms, {len(seconds)} layouts")


if __name__ == "__main__":
    main()
