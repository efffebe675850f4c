#!/usr/bin/python3
"""Draws what `holdfast bench --csv` wrote: strong scaling, boxes per world, and where the processor time goes.

Example: bench/plot.py measured.csv measured.svg
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas as pd

STAGES = ("read", "build", "simulate", "compress", "write", "assemble")


def medians(table):
    """A row a case, medians over the repetitions."""
    table = table.assign(rate=table["worlds"] / table["wall_seconds"], boxes_each=table["boxes"] / table["worlds"],
                         box_steps_rate=table["box_steps"] / table["wall_seconds"])
    names = ["engine", "layouts", "threads", "series"]
    columns = ["rate", "boxes_each", "box_steps_rate", "cpu_seconds", *[f"{stage}_cpu_seconds" for stage in STAGES]]
    return table.groupby(names, sort=False)[columns].median().reset_index()


def draw_scaling(axes, cases, runs):
    every = cases[(cases["layouts"] == "all") & (cases["series"] == 1)]
    for engine, of_engine in every.groupby("engine", sort=False):
        of_engine = of_engine.sort_values("threads")
        threads, rate = of_engine["threads"], of_engine["rate"]
        line, = axes.plot(threads, rate, "o-", label=engine)
        axes.plot(threads, rate.iloc[0] * threads / threads.iloc[0], ":", color=line.get_color())
        single = runs[(runs["engine"] == engine) & (runs["layouts"] == "all") & (runs["series"] == 1)]
        axes.plot(single["threads"], single["worlds"] / single["wall_seconds"], ".", color=line.get_color(), alpha=0.4)
    axes.set(xlabel="threads (dotted: in proportion)", ylabel="worlds a second", title="strong scaling", ylim=(0, None))
    axes.legend()


def draw_boxes(axes, cases):
    most = cases["threads"].max()
    for engine, of_engine in cases[(cases["threads"] == most) & (cases["series"] == 1)].groupby("engine", sort=False):
        of_engine = of_engine.sort_values("boxes_each")
        axes.plot(of_engine["boxes_each"], of_engine["box_steps_rate"], "o-", label=engine)
    axes.set(xlabel="boxes per world, mean of the class", ylabel="box-steps a second", title=f"size of worlds, {most} threads",
             ylim=(0, None))
    axes.legend()


def draw_stages(axes, cases):
    most = cases["threads"].max()
    shown = cases[(cases["layouts"] == "all") & (cases["threads"] == most)]
    names = [f"{row.engine}\n{'series' if row.series else 'no series'}" for row in shown.itertuples()]
    left = 0.0
    for stage in STAGES:
        share = 100 * shown[f"{stage}_cpu_seconds"] / shown["cpu_seconds"]
        axes.barh(names, share, left=left, label=stage)
        left = left + share
    axes.set(xlabel="% of the processor time", title="stages", xlim=(0, 100))
    axes.legend(fontsize="small")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", help="of `holdfast bench --csv`")
    parser.add_argument("plot", help="picture to write; its ending says which kind: .svg, .png, .pdf")
    arguments = parser.parse_args()
    runs = pd.read_csv(arguments.csv)
    cases = medians(runs)
    plt.rcParams["svg.hashsalt"] = "holdfast"
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.5), layout="constrained")
    draw_scaling(axes[0], cases, runs)
    draw_boxes(axes[1], cases)
    draw_stages(axes[2], cases)
    figure.savefig(arguments.plot)


if __name__ == "__main__":
    main()
