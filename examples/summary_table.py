#!/usr/bin/python3
"""Prints the verdicts as a table, or another column of the summary: one row per layout, one column per acceleration; '-' where a
world was not simulated.

Example: examples/summary_table.py demo/results.h5 --column moved_boxes --csv moved.csv
"""
import argparse
import sys

import h5py
import pandas as pd

VERDICTS = {0: "stayed", 1: "moved", 2: "fell", 3: "unstable", 4: "failed", 6: "not needed"}

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", type=argparse.FileType("rb"), help="results file of holdfast")
parser.add_argument("--column", default="verdict", help="column of summary/worlds (default: %(default)s)")
parser.add_argument("--csv", metavar="FILE", help="write the table there as well")
options = parser.parse_args()

with h5py.File(options.results) as file:
    columns = file.get("summary/worlds", {})
    if options.column not in columns:
        sys.exit(f"{options.results.name} has no column {options.column}; there are: {', '.join(columns) or 'none'}")
    worlds = pd.DataFrame({
        "layout": file["inputs/layouts/name"].asstr()[:][file["worlds/layout"][:]],
        "acceleration": file["inputs/accelerations/name"].asstr()[:][file["worlds/acceleration"][:]],
        "value": columns[options.column][:],
    })
    simulated = file["worlds/stop_reason"][:] != 0

if options.column == "verdict":
    worlds["value"] = worlds["value"].map(VERDICTS)
if pd.api.types.is_integer_dtype(worlds["value"]):
    worlds["value"] = worlds["value"].astype("Int64")  # integers that may be missing
worlds.loc[~simulated, "value"] = pd.NA
# Inputs of the same name from different folders keep rows of their own.
worlds["copy"] = worlds.groupby(["layout", "acceleration"]).cumcount()
table = worlds.pivot(index=["layout", "copy"], columns="acceleration", values="value")
table = table.droplevel("copy").loc[:, worlds["acceleration"].unique()]
print(options.column)
print(table.astype(object).where(table.notna(), "-").to_string())
if options.csv:
    table.to_csv(options.csv)
