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
        lines = [line for line in lines if "margins_g" in line]
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]], accuracy="screening", unit="cm") as screen:
            margins = screen.margins([screen.read_layout(path) for path in LAYOUTS], names=["a", "b", "c"])
        for found, name in ((margins.margin, "margins_g"), (margins.critical_box, "critical_boxes"),
                            (margins.margin_within_limits, "margins_within_limits_g"),
                            (margins.critical_box_within_limits, "critical_boxes_within_limits")):
            np.testing.assert_array_equal(found, [list(line[name].values()) for line in lines], name)
        self.assertTrue((margins.margin <= margins.margin_within_limits).all())
        np.testing.assert_allclose(margins.margin[0], [0.5, 80 / 212, 1.5, 59 / 212], atol=0.006)
        self.assertEqual(margins.critical_box[0].tolist(), [3, 3, 0, 3])
        self.assertEqual(margins.weakest[0], "right")
        self.assertTrue((margins.trials > 0).all() and (margins.cpu_seconds > 0).all())
        frame = margins.frame()
        self.assertEqual(frame.shape, (12, 7))
        self.assertEqual(frame["direction"].iloc[:4].tolist(), ["front", "rear", "left", "right"])
        self.assertIn("3 layouts, the least", repr(margins))
        self.assertTrue(np.isnan([margins.low, margins.median, margins.high]).all())
        self.assertNotIn("low", frame)
        self.assertIn("<th>a</th><td>0.50 / 0.50 g</td>", margins._repr_html_())
        self.assertIn("<td>1.50+ / 1.50+ g</td>", margins._repr_html_())

    def test_a_notebook_says_what_a_margin_is_not(self):
        def shown(*within):
            none = np.zeros((1, 4), dtype=np.uint32)
            return holdfast.Margins(np.array([within]), none, np.array([within]), none, np.full((3, 1, 4), np.nan),
                                    np.ones(1, dtype=np.uint32), np.zeros(1), (), ())

        self.assertEqual(repr(shown(1.5, 1.5, 1.5, 1.5)), "<holdfast.Margins of 1 layout, the least 1.50+ g within limits>")
        self.assertEqual(repr(shown(-0.2, -0.2, -0.2, -0.2)), "<holdfast.Margins of 1 layout, the least unstable>")
        self.assertEqual(repr(shown(*[np.nan] * 4)), "<holdfast.Margins of 1 layout>")
        self.assertIn("<td>unstable / unstable</td>", shown(-0.2, -0.2, -0.2, -0.2)._repr_html_())
        for margin, text in ((0.495, "0.49"), (0.5, "0.50"), (0.505, "0.50"), (0.57, "0.57")):
            self.assertIn(f"<td>{text} / {text} g</td>", shown(*[margin] * 4)._repr_html_())
        self.assertIn("<td>not known / not known</td>", shown(*[np.nan] * 4)._repr_html_())

    def test_layouts_are_judged_within_limits(self):
        shifted = BOX + [0.03 - 2, 0, 0, 0.03 - 2, 0, 0, 0]  # a gap of 3 cm to the front wall
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]]) as screen:
            margins = screen.margins([shifted])
        np.testing.assert_allclose(margins.margin[0], 0.5, atol=0.006)
        np.testing.assert_allclose(margins.margin_within_limits[0], [1.5, 0.5, 0.5, 0.5], atol=0.006)
        self.assertEqual((margins.critical_box[0, 0], margins.critical_box_within_limits[0, 0]), (1, 0))
        self.assertEqual(margins.weakest, ["rear"])
        np.testing.assert_allclose(margins.over([0.75, 0.5, 0.5, 0.5]), 1.0, atol=0.02)
        np.testing.assert_allclose(margins.over([0.75, 0, 0, 0]), 2.0, atol=0.02)

    def test_replicas_tell_how_far_friction_moves_them(self):
        with holdfast.Screen([[[0.0, 1.0, 0.0, 0.0, 0.0]]], config="[Screening]\nReplicas = 32\n") as screen:
            margins = screen.margins([BOX, STACK])
        self.assertEqual(margins.low.shape, (2, 4))
        within_limits = margins.margin_within_limits
        # The box slides; the stack tips to the side, whatever its friction.
        self.assertTrue((margins.low <= within_limits).all() and (within_limits <= margins.high).all())
        self.assertTrue((margins.low[0] < within_limits[0]).all() and (within_limits[0] < margins.high[0]).all())
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
