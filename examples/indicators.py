#!/usr/bin/python3
"""Correlates what geometry alone says of layouts with what happened to them, and draws it.

Example: holdfast screen --layouts configs/layouts bench/layouts --norm road --accuracy screening --indicators --margins -o results.h5
         examples/indicators.py results.h5 -o indicators.svg
"""
import argparse
import sys

import h5py
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

STAYED, FAILED, NOT_NEEDED = 0, 4, 6  # codes of verdicts
FEWEST = 5  # layouts from which on ranks say anything
BASES = ("< 0.5", "< 0.75", "< 1", "full")

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", type=argparse.FileType("rb"), help="results file of holdfast screen --indicators")
parser.add_argument("-o", "--output", default="indicators.png", help="picture to write (default: %(default)s)")
options = parser.parse_args()


def columns(group, names):
    return {name: group[name][:] for name in names}


with h5py.File(options.results) as file:
    if "indicators" not in file:
        sys.exit(f"{options.results.name} holds no indicators: screen with --indicators")
    # Rounded: ranks would tell apart offsets that differ by the rounding of a sum alone.
    offset = file["indicators/centre_offset"][:].round(9)
    layouts = pd.DataFrame({
        "fill": file["indicators/fill"][:],
        "badly based": file["indicators/badly_based"][:],
        "badly braced": file["indicators/badly_braced"][:],
        "off centre along": abs(offset[:, 0]),
        "off centre across": abs(offset[:, 1]),
        "height of centre": offset[:, 2] + 0.5,
    })
    begin, count = file["inputs/layouts/box_begin"][:], file["inputs/layouts/box_count"][:]
    base, sides = file["indicators/base_support"][:], file["indicators/supported_sides"][:]
    worlds = pd.DataFrame(columns(file["worlds"], ("layout", "box_begin", "box_count")))
    worlds["verdict"] = file["summary/worlds/verdict"][:]
    happened = np.any([file[f"summary/boxes/{what}"][:] for what in ("fallen", "moved", "tilted", "unstable")], axis=0)
    margins = file["margins/margin_within_limits"][:] if "margins" in file else None

worlds = worlds[~worlds["verdict"].isin([FAILED, NOT_NEEDED])]
# One row per box and world: what geometry says of the box in its layout, and what happened to it.
boxes = pd.concat([pd.DataFrame({
    "base": base[begin[world.layout]:begin[world.layout] + count[world.layout]],
    "sides": sides[begin[world.layout]:begin[world.layout] + count[world.layout]],
    "happened": happened[world.box_begin:world.box_begin + world.box_count],
    "world": world.Index,
}) for world in worlds.itertuples()], ignore_index=True)
worlds["boxes"] = boxes.groupby("world")["happened"].mean()
outcomes = pd.DataFrame({
    "worlds that fail": (worlds["verdict"] != STAYED).groupby(worlds["layout"]).mean(),
    "boxes that move": worlds.groupby("layout")["boxes"].mean(),
})
if margins is not None:
    outcomes["least margin"] = margins.min(axis=1)[outcomes.index]
layouts = layouts.loc[outcomes.index]
if len(layouts) < FEWEST:
    sys.exit(f"{options.results.name} holds {len(layouts)} layouts that were simulated: too few to correlate")

# Spearman's correlation is that of the ranks. An indicator that is the same everywhere has none.
ranks = pd.concat([layouts, outcomes], axis=1).corr(method="spearman").loc[layouts.columns, outcomes.columns]
print(f"Spearman's rank correlation over {len(layouts)} layouts")
print(ranks.round(2).to_string())

by_sides = boxes.groupby("sides")["happened"].agg(["mean", "size"])
classes = pd.cut(boxes["base"], [-1, 0.5, 0.75, 0.999, 2], labels=list(BASES), right=False)
by_base = boxes.groupby(classes, observed=False)["happened"].agg(["mean", "size"])
for name, table in (("supported sides", by_sides), ("base support", by_base)):
    print(f"\nshare of boxes that fell, moved or tilted, by {name}")
    print(table.rename(columns={"mean": "share", "size": "boxes"}).round(3).to_string())

figure = Figure(figsize=(12, 4.4), layout="constrained")
left, middle, right = figure.subplots(1, 3, width_ratios=(1.2, 1, 1))
left.imshow(ranks, cmap="RdBu_r", vmin=-1, vmax=1, aspect="auto")
for (row, column), value in np.ndenumerate(ranks.to_numpy()):
    left.text(column, row, "-" if np.isnan(value) else f"{value:+.2f}", ha="center", va="center")
left.set_xticks(range(len(ranks.columns)), ranks.columns, rotation=20, ha="right")
left.set_yticks(range(len(ranks)), ranks.index)
left.set_title(f"rank correlation, {len(layouts)} layouts")
for axis, name, table in ((middle, "supported sides", by_sides), (right, "base support", by_base)):
    axis.bar(range(len(table)), 100 * table["mean"].fillna(0), color="#5b7db1")
    axis.set_xticks(range(len(table)), [f"{label}\n{size:,}" for label, size in zip(table.index, table["size"])])
    axis.set(title=f"by {name}", ylabel="% of boxes that move", xlabel=f"{name}, and number of boxes")
    axis.spines[["top", "right"]].set_visible(False)
figure.savefig(options.output, dpi=120)
print(f"\n{options.output}")
