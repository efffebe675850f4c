#!/usr/bin/python3
"""Whether worlds told `holds` by their replicas hold with other friction too, and what replicas cost.

  bench/replica_check.py --layouts configs/layouts [--fresh 200] [--accuracy screening]

Every layout under every acceleration is run once with 32 replicas. Then friction is drawn anew, by numpy and not by the
program, and given as keys of a configuration; all worlds told `holds` or `uncertain` are simulated with each of these
draws, and those that fail are counted: how many told `holds` fail in more than 5 % of them, and for how many `uncertain`
ones the share is in the interval that was told. The cost is the processor time of all replicas divided by that of the worlds themselves.
"""
import argparse
import collections
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

SPREAD = 0.1
REPLICAS = 32
BOX = CONTAINER = math.sqrt(0.5)  # friction of the surfaces of boxes and container, the defaults


def worlds(program, folder, config, layouts, accelerations, *options):
    """The worlds of a run, as the program prints them."""
    path = pathlib.Path(folder) / "config.ini"
    path.write_text(config)
    done = subprocess.run([program, "screen", "-c", path, "--layouts", *layouts, "--accelerations", *accelerations,
                           "--json", "--quiet", "--no-series", "--overwrite", "-o", f"{folder}/worlds.h5",
                           *map(str, options)], capture_output=True, text=True, check=False)
    if done.returncode > 1:
        sys.exit(done.stderr)
    return [json.loads(line) for line in done.stdout.splitlines()]


def factors(random, deviation):
    return 1 + deviation * float(np.clip(random.standard_normal(), -3, 3))


def fresh_config(random, accuracy, materials):
    """A configuration with friction drawn as docs/guide/confidence.md says."""
    container = CONTAINER * factors(random, math.sqrt(0.75) * SPREAD)
    text = f"[Native]\nAccuracy = {accuracy}\n[Simulation Settings]\nContainerFriction = {container!r}\n"
    for material in materials:
        text += f"[Material {material}]\nFriction = {BOX * math.sqrt(factors(random, SPREAD))!r}\n"
    return text


def paths_of(given):
    """Files by name, also those of folders."""
    paths = {}
    for path in map(pathlib.Path, given):
        paths |= {file.name: file for file in (sorted(path.glob("*.txt")) if path.is_dir() else [path])}
    return paths


def materials_of(layouts):
    """All material ids of the layouts: the last number of each line but the first."""
    ids = set()
    for path in layouts:
        ids |= {int(line.split()[6]) for line in path.read_text().splitlines()[1:] if line.strip()}
    return sorted(ids)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--layouts", nargs="+", required=True)
    parser.add_argument("--accelerations", nargs="+", default=["configs/accelerations"])
    parser.add_argument("--accuracy", default="screening")
    parser.add_argument("--fresh", type=int, default=200)
    parser.add_argument("--program", default="build/release/bin/holdfast")
    arguments = parser.parse_args()
    layouts, accelerations = paths_of(arguments.layouts), paths_of(arguments.accelerations)
    with tempfile.TemporaryDirectory() as folder:
        told = worlds(arguments.program, folder, f"[Native]\nAccuracy = {arguments.accuracy}\n", layouts.values(),
                      accelerations.values(), "--replicas", REPLICAS)
        told = [world for world in told if "replicas" in world]
        counts = collections.Counter(world["replicas"]["verdict"] for world in told)
        print(f"{len(told)} worlds: " + ", ".join(f"{count} {name}" for name, count in sorted(counts.items())))
        own, beside = (sum(cost) for cost in zip(*((world["cpu_seconds"], world["replicas"]["cpu_seconds"])
                                                   for world in told)))
        print(f"processor time of all replicas: {beside / own:.1f} times that of the worlds themselves")

        checked = collections.defaultdict(list)
        for world in told:
            if world["replicas"]["verdict"] != "fails":
                checked[world["acceleration"]].append(world["layout"])
        random = np.random.default_rng(1)
        materials = materials_of(layouts.values())
        failures = collections.Counter()
        for _ in range(arguments.fresh):
            config = fresh_config(random, arguments.accuracy, materials)
            for acceleration, names in checked.items():
                for world in worlds(arguments.program, folder, config, [layouts[name] for name in names],
                                    [accelerations[acceleration]]):
                    failures[world["layout"], acceleration] += world["verdict"] != "stayed"
    held, inside = [], []
    for world in told:
        share = failures[world["layout"], world["acceleration"]] / arguments.fresh
        if world["replicas"]["verdict"] == "holds":
            held.append(share)
        elif world["replicas"]["verdict"] == "uncertain":
            low, high = world["replicas"]["wilson_95"]
            inside.append(low <= share <= high)
            print(f"  {world['layout']} under {world['acceleration']}: told {100 * low:.0f} to {100 * high:.0f} %, "
                  f"fresh {100 * share:.0f} %")
    print(f"of {len(held)} worlds told holds, {sum(share > 0.05 for share in held)} fail in more than 5 % of "
          f"{arguments.fresh} fresh draws; all together fail in {100 * float(np.mean(held)):.2f} %, the worst in "
          f"{100 * max(held):.1f} %")
    print(f"of {len(inside)} uncertain worlds, {sum(inside)} fail in a share that is in the interval told")


if __name__ == "__main__":
    main()
