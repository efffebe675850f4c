#!/usr/bin/python3
"""Draws docs/guide/verdicts.svg: how far four boxes go over time, and the limits that they are judged by.

It screens four bundled layouts under a brake of 0.8 g for 0.3 s, with a sample every 2 ms, and draws one box of each.

Example: examples/plot_verdicts.py --program build/release/bin/holdfast -o verdicts.svg
"""
import argparse
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np
from matplotlib import rcParams
from matplotlib.figure import Figure

SOURCE = pathlib.Path(__file__).resolve().parent.parent
CONFIG = """[Export Settings]
ResultsIntervallInSeconds = 0.002
[Contact]
FrictionModel = pairs
BoxBox = anti-slip
BoxFloor = anti-slip
BoxWall = timber-plywood
[Screening]
SettleSeconds = 1
"""
BRAKE = "#Initial-Time / Duration / X / Y / Z\n0 0.5 0 0 0\n0.5 0.3 7.848 0 0\n"
BEGIN, END = 0.5, 0.8  # of the acceleration that is not zero, s
BOXES = (  # layout, box, colour, what the picture says of it
    ("unstable_BR2_007_bpjs", 87, "#8e44ad", "unstable: it falls while the load settles"),
    ("BR1_001_ep", 46, "#c0392b", "moved: it tips and comes back"),
    ("seed_example", 3, "#d68910", "moved: it slides on, and is beyond the limit after the brake"),
    ("BR5_020_layer_h60", 78, "#4c8c4a", "stayed: never beyond a limit"),
)
LIMITS = (("displacement (m)", "MoveThreshold", "move_threshold", 0.22), ("drop (m)", "DropThreshold", "drop_threshold", 0.22),
          ("tilt (°)", "TiltThreshold", "tilt_threshold", 24))


def simulate(program, folder):
    (folder / "config.ini").write_text(CONFIG)
    (folder / "brake.txt").write_text(BRAKE)
    layouts = [SOURCE / f"configs/layouts/{layout}.txt" for layout, *_ in BOXES]
    subprocess.run([program, "screen", "-c", folder / "config.ini", "--layouts", *layouts, "--accelerations",
                    folder / "brake.txt", "--quiet", "-o", folder / "results.h5"], check=True)
    return folder / "results.h5"


def excursions(file, layout, box):
    """Time, and displacement, drop and tilt of a box over it, from its pose in the first sample."""
    names = file["inputs/layouts/name"].asstr()[:][file["worlds/layout"][:]]
    world = int(np.flatnonzero(names == f"{layout}.txt")[0])
    row, first, samples, boxes = (int(file[f"worlds/{column}"][world])
                                  for column in ("row_begin", "sample_begin", "sample_count", "box_count"))
    rows = slice(row + box - 1, row + samples * boxes, boxes)
    moved_by, turned_by = file["series/displacement"][rows], file["series/orientation"][rows].astype(float)
    # The scalar part of the rotation from the first orientation is the product of two unit quaternions.
    half_angle = np.arccos(np.clip(np.abs(turned_by @ turned_by[0]), 0, 1))
    return file["series/time"][first:first + samples], (np.linalg.norm(moved_by, axis=1), np.maximum(0, -moved_by[:, 2]),
                                                        np.degrees(2 * half_angle))


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default="build/release/bin/holdfast", help="holdfast (default: %(default)s)")
parser.add_argument("-o", "--output", default="verdicts.svg", help="picture to write (default: %(default)s)")
options = parser.parse_args()

rcParams["svg.hashsalt"] = "holdfast"  # the same picture has the same bytes
figure = Figure(figsize=(9, 7.2), layout="constrained")
axes = figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": (2.2, 1, 1)})
with tempfile.TemporaryDirectory() as folder, h5py.File(simulate(options.program, pathlib.Path(folder))) as file:
    for layout, box, colour, label in BOXES:
        time, paths = excursions(file, layout, box)
        for axis, path in zip(axes, paths):
            axis.plot(time, path, color=colour, linewidth=1.8, label=f"{label} ({layout}, box {box})")
            axis.plot(time[-1], path[-1], "o", color=colour, markersize=5)  # the world ends
    limits = [float(file["summary"].attrs[limit]) for _, _, limit, _ in LIMITS]

for axis, (name, key, _, top), limit in zip(axes, LIMITS, limits):
    axis.axhline(limit, color="#222222", linewidth=1, linestyle="--")
    axis.text(1.98, limit, key, fontsize="small", ha="right", va="bottom")
    axis.axvline(0, color="#222222", linewidth=0.8)
    axis.axvspan(BEGIN, END, color="#dddddd", zorder=0)
    axis.set(ylabel=name, ylim=(-0.02 * top, top), xlim=(-1.02, 2))
    axis.spines[["top", "right"]].set_visible(False)
for middle, phase in ((-0.5, "settling"), (0.25, "no brake yet"), (0.65, "brake"), (1.4, "run-out")):
    axes[0].text(middle, 1.01, phase, transform=axes[0].get_xaxis_transform(), ha="center", va="bottom", fontsize="small")
axes[-1].legend(*axes[0].get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(0, -0.38), fontsize="small", frameon=False)
axes[-1].set(xlabel="time (s); 0: the load has settled, and the acceleration begins")
figure.savefig(options.output, dpi=120, metadata={"Date": None} if options.output.endswith(".svg") else None)
print(options.output)
