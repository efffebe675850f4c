#!/usr/bin/python3
"""Draws the report of `holdfast validate -o DIR` from the tables in that folder: DIR/index.html, the pictures in it
and tables.md.

The page needs no network and no other file. Example: validation_report.py validation
"""
import argparse
import html
import io
import math
import re
from pathlib import Path

import matplotlib
import pandas as pd
from matplotlib.figure import Figure

matplotlib.rcParams["svg.fonttype"] = "none"
matplotlib.rcParams["svg.hashsalt"] = "holdfast"

SUITES = {
    "slide": "when and how boxes slide",
    "tip": "when and how boxes tip over",
    "rebound": "collisions, drops and rebounds",
    "manoeuvre": "braking, cornering, lane changes",
    "hard": "stacks, mass ratios, thin plates, tiny gaps, twins",
    "oscillate": "sine trains, vibration, shocks, noise of ships and lorries",
    "load": "real loads against a converged reference",
}
# What is drawn against cost: title, case, part of the metric's name.
CURVES = [
    ("Slide: path of one second at 1.5 times the limit", "slide_path", "displacement"),
    ("Tip: smallest acceleration that tips, l/h = 0.4", "tip_ratio_0.4_along_x", "acceleration"),
    ("Stack of five: smallest acceleration that slides it", "slide_stack_5", "10 mm"),
    ("Topple: largest error of the angle (degrees), 2 % over the limit", "topple_tower_2_percent_over", "largest"),
    ("Vibration: path of a box under 100 Hz", "walk_100_hz", "farthest off"),
    ("Rocking: largest tilt after two cycles that leave the box standing", "rocking_26x60x135_tilt", "2 x 0.5 s"),
    ("Real loads: displacement while predictable (m, median)", "real_loads", "median"),
    ("Real loads: share with another verdict on 'any moved'", "real_loads", "moved"),
]
# What the suite `oscillate` comes to: title, cases, metrics, and whether the errors are added or the largest counts.
OSCILLATE = [
    ("of 36 trains that overturn the block of 26 x 60 x 135 cm, missed", "rocking_26x.*cycles", "that overturn", "sum"),
    ("of 18 that leave it standing, overturned", "rocking_26x.*cycles", "that leave", "sum"),
    ("of 48 that overturn the other three blocks, missed", "rocking_(?!26x).*cycles", "that overturn", "sum"),
    ("of 24 that leave these standing, overturned", "rocking_(?!26x).*cycles", "that leave", "sum"),
    ("largest tilt of trains that leave a block standing, largest error", "rocking_.*tilt", "tilt", "max"),
    ("path of one box under vibration, largest error", "walk_[0-9]+_hz$", "farthest", "max"),
    ("paths of several boxes under vibration, largest error", "walk_[0-9]+_hz_(?!across)", "farthest", "max"),
    ("paths under vibration across a steady acceleration, largest error", "walk_[0-9]+_hz_across", "farthest", "max"),
    ("speed after a shock, largest error", "shock_", "velocity", "max"),
    ("path after a shock, largest error", "shock_", "displacement", "max"),
    ("path after a ramp through the static limit, largest error", "kinetic_ramp", "farthest", "max"),
    ("path of stick-slip with kinetic friction, largest error", "kinetic_(?!ramp)", "displacement (?!aside)", "max"),
    ("path in noise, largest error", "sea|lorry", "farthest", "max"),
    ("displacement in noise below the limits, largest (m)", "rest_in_noise", "displacement", "max"),
]
# An engine that runs on a device, and the setting on the processor that it is set beside.
DEVICE_ENGINE, BESIDE = "bullet-opencl", "bullet, 240 Hz, 50 it"
DEVICE_COST = (
    "<p><code>bullet-opencl</code> is made for batches. A step takes a device about 340 launches of kernels, whatever is in it, "
    "so that the single boxes of these cases cost as much as a full load would. The time in the table, nearly all of it spent waiting "
    "for the device, says nothing about a batch, and is left out of the picture: docs/develop/opencl.md has what a world costs in one. Only "
    "the quick cases are measured with it, and no real loads.</p>")
STYLE = """body{font:15px/1.5 sans-serif;max-width:75em;margin:2em auto;padding:0 1em;color:#222}
table{border-collapse:collapse;font-size:13px;margin:1em 0}td,th{border:1px solid #ccc;padding:2px 6px;text-align:right}
th,td:first-child{text-align:left}th{background:#f2f2f2}.pass{background:#e2f4e2}.fail{background:#fbe3e0}
.best{font-weight:bold}svg{max-width:100%;height:auto}summary{cursor:pointer;font-weight:bold;margin:.7em 0}"""


def read(folder):
    rows = pd.read_csv(folder / "measurements.csv")
    rows["label"] = rows["engine"] + ", " + rows["setting"]
    costs = pd.read_csv(folder / "costs.csv")
    costs["label"] = costs["engine"] + ", " + costs["setting"]
    return rows, costs, pd.read_csv(folder / "cases.csv")


def cost_of(costs):
    """Microseconds of processor time for a box and a simulated second: on real loads where there are any."""
    table = costs[costs["suite"] == "load"] if (costs["suite"] == "load").any() else costs
    sums = table.groupby("label", sort=False)[["cpu_seconds", "box_seconds"]].sum()
    return 1e6 * sums["cpu_seconds"] / sums["box_seconds"]


def svg(figure):
    stream = io.StringIO()
    figure.savefig(stream, format="svg", bbox_inches="tight", metadata={"Date": None})
    text = stream.getvalue()
    return text[text.index("<svg"):]


def is_best(points):
    """Of (cost, error) points: which none beats in both."""
    return [not any((c <= cost and e < error) or (c < cost and e <= error) for c, e in points) for cost, error in points]


def draw_work_precision(rows, cost):
    rows = rows[rows["engine"] != DEVICE_ENGINE]
    curves = [(title, rows[(rows["case"] == case) & rows["metric"].str.contains(metric, regex=False)])
              for title, case, metric in CURVES]
    curves = [(title, table.groupby(["engine", "setting", "label"], sort=False)["error"].max().reset_index())
              for title, table in curves if not table.empty]
    if not curves:
        return ""
    figure = Figure(figsize=(13, 4.2 * math.ceil(len(curves) / 2)))
    axes = figure.subplots(math.ceil(len(curves) / 2), 2, squeeze=False).flat
    for axis in list(axes)[len(curves):]:
        axis.set_visible(False)
    for axis, (title, table) in zip(figure.axes, curves):
        table = table[table["label"].isin(cost.index)]
        points = [(cost[label], max(error, 1e-13)) for label, error in zip(table["label"], table["error"])]
        best = is_best(points)
        for engine, colour in zip(rows["engine"].unique(), matplotlib.rcParams["axes.prop_cycle"].by_key()["color"]):
            mine = [point for point, name in zip(points, table["engine"]) if name == engine]
            if mine:
                axis.loglog(*zip(*sorted(mine)), "o", color=colour, label=engine)
        for point, setting, front in zip(points, table["setting"], best):
            axis.annotate(setting, point, fontsize=7, xytext=(4, 3), textcoords="offset points",
                          fontweight="bold" if front else "normal")
        front = sorted(point for point, kept in zip(points, best) if kept)
        axis.loglog(*zip(*front), "-", color="grey", linewidth=0.8, zorder=0, label="none better in both")
        axis.set(title=title, xlabel="processor time (µs a box and simulated second)", ylabel="error")
        axis.title.set_size(10)
    figure.axes[0].legend(fontsize=8)
    figure.tight_layout()
    return svg(figure)


def draw_thresholds(rows, pattern, metric, xlabel, title):
    """Measured thresholds over the exact ones, as in figures 10 and 11 of the paper the tool comes from."""
    table = rows[rows["case"].str.match(pattern) & rows["metric"].str.contains(metric, regex=False)].copy()
    if table.empty:
        return ""
    table["x"] = table["case"].str.extract(pattern)[0].astype(float)
    table["heading"] = table["case"].str.extract(pattern)[1].str.replace("_", " ")
    headings = table["heading"].unique()
    figure = Figure(figsize=(13, 3.6))
    for axis, heading in zip(figure.subplots(1, len(headings), sharey=True, squeeze=False).flat, headings):
        mine = table[table["heading"] == heading]
        exact = mine.drop_duplicates("x").sort_values("x")
        axis.plot(exact["x"], exact["expected"], "-", color="black", linewidth=0.8, label="exact")
        for label, one in mine.groupby("label", sort=False):
            axis.plot(one["x"], one["value"], "o", markersize=3, label=label)
        axis.set(title=heading, xlabel=xlabel)
        axis.title.set_size(10)
    figure.axes[0].set_ylabel("acceleration (g)")
    figure.axes[0].legend(fontsize=6)
    figure.suptitle(title, fontsize=11)
    figure.tight_layout()
    return svg(figure)


def number(value):
    return "lost" if not math.isfinite(value) else f"{value:.3g}"


def overview(rows, cost):
    labels = list(dict.fromkeys(rows["label"]))
    suites = [suite for suite in SUITES if suite in set(rows["suite"])]
    lines = ["<table><tr><th>engine and setting</th>" + "".join(f"<th>{suite}</th>" for suite in suites) +
             "<th>µs a box and simulated second</th></tr>"]
    for label in labels:
        mine = rows[rows["label"] == label]
        cells = [mine[mine["suite"] == suite]["pass"] for suite in suites]
        lines.append(f"<tr><td>{html.escape(label)}</td>" +
                     "".join(f"<td>{cell.sum()} of {len(cell)}</td>" if len(cell) else "<td>-</td>" for cell in cells) +
                     (f"<td>{cost[label]:.0f}{' (one box at a time: see below)' if label.startswith(DEVICE_ENGINE) else ''}</td></tr>"
                      if label in cost.index else "<td>-</td></tr>"))
    return "\n".join(lines) + "</table>"


def oscillate_markdown(rows):
    """The suite `oscillate` at the accuracies of the native engine as Markdown; nothing where it was not measured."""
    rows = rows[(rows["suite"] == "oscillate") & (rows["engine"] == "native")]
    settings = [name for name in ("screening", "standard", "reference") if name in set(rows["setting"])]
    if not settings:
        return []
    lines = ["", "| | " + " | ".join(settings) + " |", "| --- |" + " --- |" * len(settings)]
    for title, case, metric, way in OSCILLATE:
        mine = rows[rows["case"].str.match(case) & rows["metric"].str.contains(metric)]
        if not mine.empty:
            errors = mine.groupby("setting")["error"].agg(way)
            lines.append(f"| {title} | " + " | ".join(number(errors[name]) for name in settings) + " |")
    seconds = rows.drop_duplicates(["setting", "case"]).groupby("setting")["cpu_seconds"].sum()
    return lines + ["| processor time (s) | " + " | ".join(f"{seconds[name]:.2g}" for name in settings) + " |"]


def markdown(rows, cost):
    """The overview and the errors of the curves' metrics as Markdown, for a page of documentation."""
    labels = list(dict.fromkeys(rows["label"]))
    suites = [suite for suite in SUITES if suite in set(rows["suite"])]

    def passed(label, suite):
        cell = rows[(rows["label"] == label) & (rows["suite"] == suite)]["pass"]
        return f"{cell.sum()} of {len(cell)}" if len(cell) else "-"

    lines = ["| passed | " + " | ".join(suites) + " | µs a box and simulated second |",
             "| --- |" + " --- |" * (len(suites) + 1)]
    lines += [f"| {label} | " + " | ".join(passed(label, suite) for suite in suites) +
              (f" | {cost[label]:.0f} |" if label in cost.index else " | - |") for label in labels]
    for title, case, metric in CURVES:
        table = rows[(rows["case"] == case) & rows["metric"].str.contains(metric, regex=False)]
        if not table.empty:
            errors = table.pivot_table(index="label", columns="metric", values="error", sort=False)
            lines += ["", title, "", "| error | " + " | ".join(errors.columns) + " |",
                      "| --- |" + " --- |" * len(errors.columns)]
            lines += [f"| {label} | " + " | ".join(number(error) for error in row) + " |"
                      for label, row in zip(errors.index, errors.values)]
    return "\n".join(lines + oscillate_markdown(rows)) + "\n"


def beside_the_processor(rows):
    """What the device's engine does worse than the same physics on the processor, the worst first, with what to know of its cost."""
    if DEVICE_ENGINE not in set(rows["engine"]):
        return ""
    parts = [f"<h2>On a device: {DEVICE_ENGINE}</h2>", DEVICE_COST]
    key = ["case", "metric"]
    on_processor = rows[rows["label"] == BESIDE].drop_duplicates(key).set_index(key)
    for label in dict.fromkeys(rows.loc[rows["engine"] == DEVICE_ENGINE, "label"]):
        both = rows[rows["label"] == label].drop_duplicates(key).join(on_processor[["error", "pass"]], on=key, how="inner", rsuffix="_beside")
        if both.empty:
            continue
        error, beside = both["error"].fillna(math.inf), both["error_beside"].fillna(math.inf)
        worse = (error > 2 * beside) & (both["pass"] == 0)
        better = (beside > 2 * error) & (both["pass_beside"] == 0)
        parts.append(f"<p><b>{html.escape(label)}</b> beside <b>{BESIDE}</b>, of {len(both)} measurements of both: within the tolerance "
                     f"{both['pass'].sum()} and {both['pass_beside'].sum()}. In {better.sum()} the processor's error is beyond the "
                     f"tolerance and more than twice as large as the device's; in {worse.sum()} it is the other way round, and these are "
                     "where the device is worse:</p>")
        lines = ["<table><tr><th>case and metric</th><th>tolerance</th><th>on the device</th><th>on the processor</th></tr>"]
        order = (error / beside.clip(lower=1e-12))[worse].sort_values(ascending=False, kind="stable").index
        for _, row in both.loc[order].iterrows():
            lines.append(f"<tr><td>{html.escape(row['case'])}<br>{html.escape(row['metric'])}</td><td>{number(row['tolerance'])}</td>"
                         f"<td class='fail'>{number(row['error'])}</td>"
                         f"<td class='{'pass' if row['pass_beside'] else 'fail'}'>{number(row['error_beside'])}</td></tr>")
        parts.append(f"<details open><summary>{len(order)} of them</summary>" + "\n".join(lines) + "</table></details>")
    return "\n".join(parts)


def suite_table(rows, cases, suite):
    mine = rows[rows["suite"] == suite]
    labels = list(dict.fromkeys(mine["label"]))
    about = cases.set_index("case")
    lines = ["<table><tr><th>case and metric</th><th>exact</th><th>tolerance</th>" +
             "".join(f"<th>{html.escape(label)}</th>" for label in labels) + "</tr>"]
    for (case, metric), group in mine.groupby(["case", "metric"], sort=False):
        hint = f"{about.loc[case, 'question']}. Goes wrong: {about.loc[case, 'trap']}" if case in about.index else ""
        errors = group.drop_duplicates("label").set_index("label")
        cells = "".join(
            f"<td class='{'pass' if errors.loc[label, 'pass'] else 'fail'}'>{number(errors.loc[label, 'error'])}</td>"
            if label in errors.index else "<td></td>" for label in labels)
        lines.append(f"<tr><td title='{html.escape(hint, quote=True)}'>{html.escape(case)}<br>{html.escape(metric)}</td>"
                     f"<td>{number(group['expected'].iloc[0])}</td><td>{number(group['tolerance'].iloc[0])}</td>{cells}</tr>")
    return "\n".join(lines) + "</table>"


def page(rows, costs, cases):
    cost = cost_of(costs)
    pictures = [
        draw_work_precision(rows, cost),
        draw_thresholds(rows, r"slide_mu_([\d.]+)_(\w+)", "10 mm", "friction coefficient", "Acceleration that slides a box"),
        draw_thresholds(rows, r"tip_ratio_([\d.]+)_(\w+)", "", "length over height", "Acceleration that tips a box"),
    ]
    where = ("on the real loads" if (costs["suite"] == "load").any() else "over all cases")
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'><title>holdfast: validation</title>",
        f"<style>{STYLE}</style><h1>How wrong, and at what cost</h1>",
        "<p>Every engine and setting is measured on the same cases, whose answers are known: from a formula, from an "
        "independent integration of high precision, or, for real loads, from a converged reference. A cell of the tables "
        "is the <b>error</b>: relative where the exact value is not zero, else as a share of the scale that the metric "
        "names. It is green where it is within the tolerance of its case, which is the same for all engines: rest is "
        "rest (1e-12), a closed formula is met (1e-6), a trajectory nearly so (1e-4), a verdict is right or wrong. Red "
        "cells are no defect of the build but what an engine does not reach. Hold the pointer over a case for its "
        "question and for what typically goes wrong.</p>",
        "<h2>Passed, by suite</h2>", overview(rows, cost), f"<p>Processor time {where}.</p>",
        "<h2>Speed against error</h2><p>Left is quicker, lower is more accurate. The line joins the settings that no "
        "other one beats in both; their names are bold. An error below 1e-13 is drawn there.</p>", pictures[0],
        beside_the_processor(rows),
        "<h2>Thresholds</h2><p>The two benchmark tests of the paper that the tool comes from: the smallest acceleration "
        "that slides a box (its figure 10) and that tips one (figure 11).</p>", pictures[1], pictures[2],
    ]
    for suite, meaning in SUITES.items():
        if suite in set(rows["suite"]):
            parts.append(f"<h2>{suite}: {meaning}</h2><details><summary>{(rows['suite'] == suite).sum()} measurements"
                         f"</summary>{suite_table(rows, cases, suite)}</details>")
    return "\n".join(parts) + "</html>\n", pictures


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("folder", type=Path, help="folder with measurements.csv, costs.csv and cases.csv")
folder = parser.parse_args().folder
measured_rows, measured_costs, known_cases = read(folder)
text, drawn = page(measured_rows, measured_costs, known_cases)
(folder / "index.html").write_text(text)
(folder / "tables.md").write_text(markdown(measured_rows, cost_of(measured_costs)))
for name, picture in zip(("speed_against_error", "slide_thresholds", "tip_thresholds"), drawn):
    if picture:
        (folder / f"{name}.svg").write_text(re.sub(r"^<svg", "<svg xmlns='http://www.w3.org/2000/svg'", picture)
                                            if "xmlns=" not in picture[:300] else picture)
