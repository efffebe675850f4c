#!/usr/bin/python3
"""Draws how hard layouts press each wall, the hardest first, against the test forces of a norm.

Example: holdfast screen --layouts configs/layouts --norm road --walls en12642-xl -o walls.h5
         examples/plot_walls.py walls.h5 -o walls.svg
"""
import argparse
import sys

import h5py
import numpy as np

from layout_bars import draw_bars, round_ticks

WALLS = slice(1, 5)  # of floor, front, rear, left, right, roof

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", type=argparse.FileType("rb"), help="results file of holdfast screen --walls or --wall-forces")
parser.add_argument("--most", type=int, default=40, help="layouts that are drawn (default: %(default)s)")
parser.add_argument("-o", "--output", default="walls.png", help="picture to write (default: %(default)s)")
options = parser.parse_args()

with h5py.File(options.results) as file:
    if "walls" not in file:
        sys.exit(f"{options.results.name} holds no wall forces: screen with --walls NAME or --wall-forces")
    force = file["walls/lasting_force"][:, WALLS]
    limit = file["walls/limit"][:, WALLS]
    layout = file["worlds/layout"][:]
    names = file["inputs/layouts/name"].asstr()[:]
    norm = file["inputs/settings"].attrs["Screening/Walls"]

limited = np.isfinite(limit).any()
pressed = 100 * force / limit if limited else force / 1000
# The largest over the accelerations; a layout that was never accelerated has none.
worst = np.full((len(names), 4), -np.inf)
np.maximum.at(worst, layout, np.where(np.isnan(pressed), -np.inf, pressed))
order = [row for row in np.argsort(-worst.max(axis=1), kind="stable") if np.isfinite(worst[row]).all()]
if not order:
    sys.exit(f"{options.results.name} holds no world that was accelerated")
shown = order[:options.most]
ticks = (0, 100, 200) if limited else round_ticks(worst[shown].max())
figure = draw_bars([names[row].removesuffix(".txt") for row in shown], worst[shown],
                   worst[shown] <= 100 if limited else np.ones((len(shown), 4), bool), [100 if limited else None] * 4, ticks,
                   f"% of {norm}" if limited else "kN", "The largest force on each wall for 0.05 s")
figure.savefig(options.output, dpi=120)
pressing = int((worst[order] > 100).any(axis=1).sum())
beyond = f"; {pressing} {'presses' if pressing == 1 else 'press'} a wall beyond {norm}" if limited else ""
print(f"{options.output}: {len(shown)} of {len(order)} layout{'' if len(order) == 1 else 's'}{beyond}")
