"""What the tests of the search examples share: inputs, and what must be true of a loading that was found.

By hand: HOLDFAST=build/release/bin/holdfast LOADING_SEARCH=build/release/bin/loading_search /usr/bin/python3 tests/examples/test_search.py
"""
import json
import os
import pathlib
import subprocess
import unittest

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
INSTANCES = SOURCE / "bench/instances.txt"
# Those that a few generations find a loading for.
ACCELERATIONS = sorted((SOURCE / "configs/accelerations").glob("road_corner_*.txt"))
CONTAINER = np.array([587.0, 233.0, 220.0])  # cm


def output_of(*words, **options):
    """Lines of a command that must succeed."""
    result = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise AssertionError(f"{words}\n{result.stdout}{result.stderr}")
    return result.stdout.splitlines()


def overlap(low, high, axis):
    """Lengths along an axis that every pair of boxes has in common; negative where there is a gap."""
    return np.minimum.outer(high[:, axis], high[:, axis]) - np.maximum.outer(low[:, axis], low[:, axis])


class LoadingTest(unittest.TestCase):
    def check_geometry(self, path, support):
        """Boxes are inside and do not overlap, and at least a share of each base is supported from below.
        :return: the share of the container's volume that they fill"""
        boxes = np.loadtxt(path, skiprows=1)
        low, high = boxes[:, :3], boxes[:, 3:6]
        self.assertTrue(np.all(low >= 0) and np.all(high <= CONTAINER) and np.all(high > low), path)
        common = [overlap(low, high, axis) for axis in range(3)]
        together = np.all(np.array(common) > 0, axis=0)
        np.testing.assert_array_equal(together, np.eye(len(boxes), dtype=bool))
        area = np.maximum(common[0], 0) * np.maximum(common[1], 0)
        below = np.equal.outer(low[:, 2], high[:, 2])  # of the box of a row, that of the column
        supported = (area * below).sum(axis=1) / np.prod(high - low, axis=1) * (high - low)[:, 2]
        self.assertTrue(np.all((low[:, 2] == 0) | (supported >= support - 1e-9)), path)
        return np.prod(high - low, axis=1).sum() / np.prod(CONTAINER)

    def check_types(self, path, problem):
        """No more boxes of a type than the instance has."""
        numbers = [[int(word) for word in line.split()] for line in INSTANCES.read_text(encoding="ascii").splitlines()]
        begins = [i for i, line in enumerate(numbers) if len(line) == 3]  # the container of each problem
        first = begins[problem - 1] + 2
        types = numbers[first:first + numbers[first - 1][0]]
        ids = np.loadtxt(path, skiprows=1)[:, 6]
        for kind in types:
            self.assertLessEqual(np.sum(ids == kind[0]), kind[7])
        self.assertTrue(set(ids) <= {kind[0] for kind in types})

    def check_holds(self, path):
        """The program comes to the same verdict."""
        program = os.environ["HOLDFAST"]
        lines = output_of(program, "screen", "--quiet", "--json", "--accuracy", "screening", "--no-series", "--overwrite",
                          "--layouts", path, "--accelerations", *ACCELERATIONS, "-o", path.with_suffix(".h5"))
        self.assertEqual([json.loads(line)["verdict"] for line in lines], ["stayed"] * len(ACCELERATIONS))
