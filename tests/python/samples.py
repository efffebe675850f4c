"""What the tests of the Python package share: inputs, and the program to compare with.

PYTHONPATH leads to the package, and HOLDFAST names the program. Run a file by hand with
PYTHONPATH=build/release/python HOLDFAST=build/release/bin/holdfast /usr/bin/python3 tests/python/test_evaluate.py
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("HOLDFAST", SOURCE / "build/release/bin/holdfast")).resolve()
BRAKE = SOURCE / "configs/accelerations/road_brake_0g8.txt"
CORNER = SOURCE / "configs/accelerations/road_corner_left_0g5.txt"
LAYOUTS = [SOURCE / "configs/layouts" / name for name in ("seed_example.txt", "BR0_012_block.txt", "BR15_077_ep.txt")]
LONG_LAYOUT = SOURCE / "configs/layouts/unstable_BR15_077_bpjs.txt"  # takes seconds with accuracy="reference"
PATIENCE = float(os.environ.get("PATIENCE", 100))  # s

SLIDE = [[0.0, 1.0, 7.0, 0.0, 0.0]]  # a box on the floor slides by SLIDES, until it rests again
SLIDES = 0.5 * 7.0 / (0.5 * 9.81) * (7.0 - 0.5 * 9.81)  # m
REST = [[0.0, 1.0, 0.0, 0.0, 0.0]]
BOX = np.array([[2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1.0]])
STACK = np.array([[1.0, 1.0, 0.0, 1.5, 1.5, 0.5, 1.0], [1.0, 1.0, 0.5, 1.5, 1.5, 1.0, 1.0]])


def screened(layouts, accelerations, *options):
    """Worlds of the program, as it prints them: a list of objects."""
    with tempfile.TemporaryDirectory() as folder:
        words = [PROGRAM, "screen", "--quiet", "--json", "--layouts", *layouts, "--accelerations", *accelerations, "-o",
                 "results.h5", *options]
        # A sanitizer's runtime, which Python needs to have loaded, is in the program already.
        environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        lines = subprocess.run([str(word) for word in words], cwd=folder, env=environment, check=True, capture_output=True,
                               text=True).stdout.splitlines()
    return [json.loads(line) for line in lines]


def in_another_process(script, **options):
    """The end of a script that runs in a Python of its own, with the samples at hand."""
    lead = f"import sys; sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})\nfrom samples import *\n"
    return subprocess.run([sys.executable, "-c", lead + script], timeout=PATIENCE, capture_output=True, text=True, **options)


def main():
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
