#!/usr/bin/python3
"""Draws the outputs of loading_search: the fullest loading that holds over processor time, one panel per instance.

The names of the files say what they are: INSTANCE_CHECK_SEED.txt, such as BR10_loop_1.txt.

Example: examples/search/plot.py search.svg build/search/*.txt
"""
import argparse
from pathlib import Path

import matplotlib
import pandas as pd
from matplotlib.figure import Figure

COLOURS = {"loop": "tab:blue", "after": "tab:orange"}
LABELS = {"loop": "holds, check in the loop", "after": "holds, checked afterwards"}


def read(path):
    """The rows of the table, and the processor time at the end of the run."""
    lines = path.read_text(encoding="ascii").splitlines()
    rows = [[float(word) for word in line.split()] for line in lines[1:-2]]
    table = pd.DataFrame(rows, columns=["seconds", "generation", "loadings", "checked", "held", "fill", "holds"])
    return table, float(lines[-2].split()[1])


def draw(axes, instance, runs):
    labels = {}
    for check, path in runs:
        table, end = read(path)
        table = pd.concat([table, table.tail(1).assign(seconds=end)])
        if check == "after":  # the search by fill alone, of which nobody knows what holds
            labels["fill"], = axes.step(table["seconds"], table["fill"], where="post", color="0.6", linewidth=1)
        holding = table[table["holds"] > 0]
        if not holding.empty:
            labels[check], = axes.step(holding["seconds"], holding["holds"], where="post", color=COLOURS[check])
            axes.plot(holding["seconds"].iloc[0], holding["holds"].iloc[0], "o", color=COLOURS[check])
    fullest = max(read(path)[0]["fill"].max() for _, path in runs)
    axes.set(title=instance, xlabel="processor time (s)", ylabel="share of the container filled",
             ylim=(fullest - 0.06, fullest + 0.005))  # not the steep beginning
    axes.legend(labels.values(), [LABELS.get(name, "fullest of a search by fill") for name in labels], loc="lower right")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", help="to write; its ending says which kind: .svg, .png, .pdf")
    parser.add_argument("runs", nargs="+", type=Path, help="outputs of loading_search")
    options = parser.parse_args()
    instances = {}
    for path in options.runs:
        instance, check, _ = path.stem.split("_")
        instances.setdefault(instance, []).append((check, path))
    matplotlib.rcParams["svg.hashsalt"] = "holdfast"
    figure = Figure(figsize=(5.5 * len(instances), 4), layout="constrained")
    for axes, (instance, runs) in zip(figure.subplots(1, len(instances), squeeze=False)[0], instances.items()):
        draw(axes, instance, runs)
    figure.savefig(options.picture)


if __name__ == "__main__":
    main()
