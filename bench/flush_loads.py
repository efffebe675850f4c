#!/usr/bin/python3
"""Random loads with flush tops, and a box that slides over them: how far from the exact path it is.

Each load is three rows of blocks, of one to three layers, whose tops are level and which the floor holds. A box on the
last of them slides towards the front for 2.4 m, under a braking of 0.8 g and until it stops, with a friction of 0.5,
over all joints between them. Half of the boxes stand across the joint of two rows. The exact path is that on a level
floor: while it brakes (a - mu g) t^2 / 2, and afterwards (a - mu g) / (mu g) of that. A box is caught where it is off by
more than 5 cm.

Example: bench/flush_loads.py --loads 300
"""
import argparse
import csv
import random
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
GRAVITY = 9.81
BRAKING, FRICTION, GRIP = 0.8 * GRAVITY, 0.5, 1.5
WAY = 2.4  # m
CAUGHT = 0.05  # m
ROW_LENGTH = 480.0  # cm
MASSES = {2: 1, 3: 5, 4: 20}  # kg, by material; the box that slides is of material 1, and has 10
SLIDER = 1
CONFIG = """[Friction]
any, floor = {grip}
any, any = {grip}
{slides}
[Container]
Length = 800
Width = 300
Height = 300
[Material 1]
Mass = 10
{materials}
[Native]
Accuracy = {accuracy}
{keys}
"""


def cut(draw, length, least, most):
    """Pieces from `least` to about `most` that add up to the length."""
    pieces = []
    while length > most + least:
        pieces.append(round(draw.uniform(least, most), 1))
        length -= pieces[-1]
    return [*pieces, length]


def load(number):
    """Lines of a layout file: x y z X Y Z material, in cm."""
    draw = random.Random(f"flush {number}")
    height = round(draw.uniform(20.0, 60.0), 1)
    boxes, y = [], 20.0
    rows = [round(draw.uniform(40.0, 70.0), 1) for _ in range(3)]
    for width in rows:
        x = 0.0
        for length in cut(draw, ROW_LENGTH, max(30.0, height), max(50.0, 1.6 * height)):
            z = 0.0
            for thickness in cut(draw, height, 8.0, draw.choice((height, height / 2, height / 3))):
                boxes.append((x, y, z, x + length, y + width, z + thickness, draw.choice(list(MASSES))))
                z += thickness
            x += length
        y += width
    edges = [round(draw.uniform(40.0, 80.0), 1), round(draw.uniform(35.0, 60.0), 1)]
    high = round(draw.uniform(0.2, 0.9) * edges[0], 1)
    centre = 20.0 + (rows[0] if draw.random() < 0.5 else rows[0] + rows[1] / 2) + draw.uniform(-5.0, 5.0)
    x, y = ROW_LENGTH - edges[0] - draw.uniform(0.0, 30.0), centre - edges[1] / 2
    boxes.append((x, y, height, x + edges[0], y + edges[1], height + high, SLIDER))
    return [f"{len(boxes)} boxes", *(" ".join(f"{value:.6g}" for value in box) for box in boxes)]


def paths(arguments, accuracy, folder):
    """How far the box has slid, m, by load."""
    slides = "\n".join(f"{SLIDER}, {other} = {FRICTION}" for other in (SLIDER, *MASSES))
    materials = "\n".join(f"[Material {number}]\nMass = {mass}" for number, mass in MASSES.items())
    config, results = folder / f"{accuracy}.ini", folder / f"{accuracy}.h5"
    keys = "\n".join(arguments.native)
    config.write_text(CONFIG.format(grip=GRIP, slides=slides, materials=materials, accuracy=accuracy, keys=keys))
    duration = (2.0 * WAY * FRICTION * GRAVITY / BRAKING / (BRAKING - FRICTION * GRAVITY)) ** 0.5
    acceleration = folder / "brake.txt"
    acceleration.write_text(f"0 {duration!r} {BRAKING!r} 0 0\n{duration!r} 1.5 0 0 0\n")
    command = [arguments.program, "screen", "-c", config, "--layouts", folder / "loads", "--accelerations", acceleration]
    command += ["-o", results, "--overwrite", "--quiet", "--engine", arguments.engine]
    if subprocess.run(command).returncode > 1:  # 1: a world has failed, which counts by where its box is
        raise SystemExit(1)
    subprocess.run([arguments.program, "summary", results, "--csv", folder / accuracy], check=True, stdout=subprocess.DEVNULL)
    boxes = {}
    with (folder / accuracy / "boxes.csv").open() as file:
        for row in csv.DictReader(file):
            boxes.setdefault(row["layout"], []).append(row)
    return {layout: -float(rows[-1]["end_displacement_x_m"]) for layout, rows in boxes.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build/release/bin/holdfast")
    parser.add_argument("--loads", type=int, default=300)
    parser.add_argument("--engine", default="native")
    parser.add_argument("--accuracy", nargs="+", default=["screening", "standard", "reference"])
    parser.add_argument("--native", nargs="*", default=[], help="keys of [Native], such as StepsPerSecond=30")
    parser.add_argument("--worst", type=int, default=3, help="loads that are named")
    parser.add_argument("--keep", help="folder of the loads and results")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(arguments.keep or temporary)
        (folder / "loads").mkdir(parents=True, exist_ok=True)
        for left_over in (folder / "loads").glob("*.txt"):
            left_over.unlink()
        for number in range(arguments.loads):
            (folder / "loads" / f"{number:03}.txt").write_text("\n".join(load(number)) + "\n")
        print("| accuracy | caught | error of the others, relative: median | 90 % | largest |")
        print("| --- | --- | --- | --- | --- |")
        for accuracy in arguments.accuracy:
            errors = {layout: abs(path - WAY) for layout, path in paths(arguments, accuracy, folder).items()}
            caught = {layout for layout, error in errors.items() if error > CAUGHT}
            relative = sorted(error / WAY for layout, error in errors.items() if layout not in caught)
            at = [f"{relative[int(share * (len(relative) - 1))]:.1e}" if relative else "-" for share in (0.5, 0.9, 1.0)]
            print(f"| {accuracy} | {len(caught)} of {len(errors)} | " + " | ".join(at) + " |")
            worst = sorted(errors, key=errors.get)[-arguments.worst :]
            print("worst: " + ", ".join(f"{layout} {errors[layout] * 1e3:.1f} mm" for layout in worst), file=sys.stderr)


if __name__ == "__main__":
    main()
