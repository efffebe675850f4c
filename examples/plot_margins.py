#!/usr/bin/python3
"""Draws how many g layouts stand in each direction, the weakest first, against what a norm or the run asks of them.

The coloured bars are margins within the limits of the verdict, and the thin ones inside them margins in place.

Example: holdfast margins --layouts configs/layouts --norm road -o margins.h5
         examples/plot_margins.py margins.h5 -o margins.svg
"""
import argparse
import sys

import h5py
import numpy as np

from layout_bars import DIRECTIONS, draw_bars

GRAVITY = 9.81
ROUNDING = 1e-6  # g, of what is asked
TICKS = (0, 0.5, 1, 1.5)  # g: larger margins than the last are not told
PUSH = np.array([[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0]])  # of the load; the container's acceleration is opposite


def asked(file):
    """The largest acceleration of the run that pushes in each direction, g; those that take weight off play no part."""
    values = file["inputs/accelerations/value"][:]
    values = values[values[:, 2] == 0]
    return np.maximum(0, (-values @ PUSH.T)).max(axis=0, initial=0) / GRAVITY


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", type=argparse.FileType("rb"), help="results file of holdfast margins or screen --margins")
parser.add_argument("--needed", type=float, nargs=4, metavar=tuple(direction.upper() for direction in DIRECTIONS),
                    help="g that a layout has to stand (default: the accelerations of the run)")
parser.add_argument("--most", type=int, default=40, help="layouts that are drawn (default: %(default)s)")
parser.add_argument("-o", "--output", default="margins.png", help="picture to write (default: %(default)s)")
options = parser.parse_args()

with h5py.File(options.results) as file:
    if "margins" not in file:
        sys.exit(f"{options.results.name} holds no margins: screen with --margins, or use holdfast margins")
    margins, in_place = file["margins/margin_within_limits"][:], file["margins/margin"][:]
    names = file["inputs/layouts/name"].asstr()[:]
    needed = np.array(options.needed) if options.needed else asked(file)

known = ~np.isnan(margins).any(axis=1)
shares = margins / np.where(needed > 0, needed, np.nan) if needed.any() else margins
order = [row for row in np.argsort(np.nanmin(np.where(known[:, None], shares, np.inf), axis=1), kind="stable") if known[row]]
if not order:
    sys.exit(f"{options.results.name} holds no layout whose margins are known")
shown = order[:options.most]
figure = draw_bars([names[row].removesuffix(".txt") for row in shown], margins[shown], margins[shown] >= needed - ROUNDING,
                   [value or None for value in needed], TICKS, "g",
                   "The largest constant acceleration that a layout stands within limits; inside, in place", in_place[shown])
figure.savefig(options.output, dpi=120)
stand = int((margins[order] >= needed - ROUNDING).all(axis=1).sum())
print(f"{options.output}: {len(shown)} of {len(order)} layout{'' if len(order) == 1 else 's'}; "
      f"{stand} {'stands' if stand == 1 else 'stand'} what is asked in every direction")
