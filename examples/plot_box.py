#!/usr/bin/python3
"""Plots how far one box moved over time, with the acceleration of the container below.

Example: examples/plot_box.py demo/results.h5 --layout BR8_009_ep.txt --acceleration road-front-0g8 -o box.png
"""
import argparse
import sys

import h5py
import numpy as np
from matplotlib.figure import Figure


def find_world(file, wanted):
    """The world of the given names; where they leave several open, the one whose boxes moved most."""
    names = {kind: file[f"inputs/{kind}s/name"].asstr()[:][file[f"worlds/{kind}"][:]] for kind in wanted}
    fits = file["worlds/sample_count"][:] > 0
    for kind, name in wanted.items():
        if name and name not in names[kind]:
            sys.exit(f"no {kind} {name}; there are: {', '.join(sorted(set(names[kind])))}")
        fits &= (names[kind] == name) | (not name)
    if not fits.any():
        sys.exit("that world has no samples: it was not simulated")
    world = int(np.where(fits, np.nan_to_num(file["summary/worlds/peak_displacement"][:]), -1).argmax())
    return world, f"{names['layout'][world]} under {names['acceleration'][world]}"


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", type=argparse.FileType("rb"), help="results file of holdfast")
parser.add_argument("--layout", help="its name (default: the world whose boxes moved most)")
parser.add_argument("--acceleration", help="its name (default: the same)")
parser.add_argument("--box", type=int, help="id of the box, from 1 (default: the one that moved most)")
parser.add_argument("-o", "--output", default="box.png", help="picture to write (default: %(default)s)")
options = parser.parse_args()

with h5py.File(options.results) as file:
    if len(file.get("series/displacement", ())) == 0:
        sys.exit(f"{options.results.name} holds no series: screen without --no-series to record them")
    world, title = find_world(file, {"layout": options.layout, "acceleration": options.acceleration})
    row, first, samples, boxes = (int(file[f"worlds/{column}"][world])
                                  for column in ("row_begin", "sample_begin", "sample_count", "box_count"))
    displacement = file["series/displacement"][row:row + samples * boxes].reshape(samples, boxes, 3)
    time = file["series/time"][first:first + samples]
    container = file["series/container_acceleration"][first:first + samples]

box = int(np.linalg.norm(displacement, axis=2).max(axis=0).argmax()) + 1 if options.box is None else options.box
if not 1 <= box <= boxes:
    sys.exit(f"no box {box}: there are boxes 1 to {boxes}")
figure = Figure(figsize=(8, 6))
above, below = figure.subplots(2, sharex=True, gridspec_kw={"height_ratios": (2, 1)})
above.plot(time, displacement[:, box - 1], label=tuple("xyz"))
above.set(title=f"Box {box} of {title}", ylabel="displacement (m)")
above.legend()
below.step(time, container, where="pre")  # at a breakpoint a sample holds the value before it
below.set(xlabel="time (s)", ylabel="container (m/s²)")
figure.savefig(options.output, dpi=120, bbox_inches="tight")
print(f"{options.output}: box {box} of {title}")
