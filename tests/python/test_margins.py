"""How many g layouts stand, as arrays."""
import json
import subprocess
import tempfile
import unittest

import numpy as np

import holdfast
from samples import BOX, LAYOUTS, PROGRAM, STACK, main


class MarginsTest(unittest.TestCase):
    def test_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([PROGRAM, "margins", "--layouts", *LAYOUTS, "--accuracy", "screening", "--json", "--quiet",
                                   "-o", f"{folder}/margins.h5"], check=True, capture_output=True, text=True)
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        expected = [list(line["margins_g"].values()) for line in lines if "margins_g" in line]
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]], accuracy="screening", unit="cm") as screen:
            margins = screen.margins([screen.read_layout(path) for path in LAYOUTS], names=["a", "b", "c"])
        np.testing.assert_array_equal(margins.margin, expected)
        np.testing.assert_allclose(margins.margin[0], [0.5, 80 / 212, 1.5, 59 / 212], atol=0.006)
        self.assertEqual(margins.critical_box[0].tolist(), [2, 2, -1, 2])
        self.assertEqual(margins.weakest[0], "right")
        self.assertTrue((margins.trials > 0).all() and (margins.cpu_seconds > 0).all())
        frame = margins.frame()
        self.assertEqual(frame.shape, (12, 5))
        self.assertEqual(frame["direction"].iloc[:4].tolist(), ["front", "rear", "left", "right"])
        self.assertIn("3 layouts, the least", repr(margins))
        self.assertTrue(np.isnan([margins.low, margins.median, margins.high]).all())
        self.assertNotIn("low", frame)
        self.assertIn("<th>a</th>", margins._repr_html_())

    def test_replicas_tell_how_far_friction_moves_them(self):
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]], config="[Screening]\nReplicas = 32\n") as screen:
            margins = screen.margins([BOX, STACK])
        self.assertEqual(margins.low.shape, (2, 4))
        self.assertTrue((margins.low < margins.margin).all() and (margins.margin < margins.high).all())
        np.testing.assert_allclose(margins.median, 0.5, atol=0.03)
        np.testing.assert_array_equal(margins.frame()["high"], margins.high.ravel())

    def test_a_fitness_is_the_worst_share_of_what_is_needed(self):
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]]) as screen:
            margins = screen.margins([BOX, STACK])
        np.testing.assert_allclose(margins.margin, 0.5, atol=0.006)
        np.testing.assert_allclose(margins.over([0.8, 0.5, 0.5, 0.5]), 0.5 / 0.8, atol=0.01)
        np.testing.assert_allclose(margins.over([0, 0.25, 0, 0]), 2.0, atol=0.03)
        for wrong in ([0.8, 0.5], [0, 0, 0, 0], [-1, 1, 1, 1], [np.nan] * 4):
            with self.assertRaises(ValueError):
                margins.over(wrong)

    def test_bad_layouts_and_engines(self):
        bad = BOX.copy()
        bad[0, 3] = np.nan
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]]) as screen:
            with self.assertRaises(holdfast.Error):
                screen.margins([BOX, bad])
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]], errors="mark") as screen:
            margins = screen.margins([BOX, bad])
        self.assertEqual(np.isnan(margins.margin).any(axis=1).tolist(), [False, True])
        self.assertEqual([problem.layout for problem in margins.problems], [1])
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]], engine="native-plain") as screen:
            with self.assertRaisesRegex(holdfast.Error, "cannot find margins"):
                screen.margins([BOX])


if __name__ == "__main__":
    main()
