"""The statistics of bench/peers on worlds made up so that the answers are known; no peer is needed."""
import sys
import unittest
from pathlib import Path

import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "peers"))
import peer_statistics as statistics  # noqa: E402


def world(setting, layout, displacement, cpu=1.0, repeat=0, **more):
    return {"setting": setting, "layout": layout, "acceleration": "brake", "repeat": repeat, "cpu_seconds": cpu,
            "simulated_seconds": 2.0, "peak_displacement": displacement, **more}


def place(setting, box, x, time=0.5):
    return {"setting": setting, "layout": "a", "acceleration": "brake", "time": time, "box": box, "x": x, "y": 0.0, "z": 0.0}


class Speed(unittest.TestCase):
    def test_cpu_is_the_median_of_repeats_over_simulated_time_in_the_order_of_the_run(self):
        worlds = pd.DataFrame([world("z", "a", 0.0, 1.0), world("b", "a", 0.0, 5.0), world("z", "a", 0.0, 9.0, repeat=1),
                               world("z", "a", 0.0, 2.0, repeat=2)])
        cpu = statistics.cpu_per_second(worlds)
        self.assertEqual(list(cpu.index), ["z", "b"])
        self.assertEqual(list(cpu), [1.0, 2.5])

    def test_exponent_of_a_square_law_is_two(self):
        worlds = pd.DataFrame([world("s", f"{size}", 0.0, 1e-6 * size**2, size=size) for size in (100, 200, 400)])
        self.assertAlmostEqual(statistics.exponents(statistics.cost_of_sizes(worlds))["s"], 2.0)


class Verdicts(unittest.TestCase):
    def test_only_worlds_on_which_the_references_agree_count(self):
        references = pd.DataFrame([world("r", "a", 0.2), world("q", "a", 0.4), world("r", "b", 0.0), world("q", "b", 0.02),
                                   world("r", "c", 0.09), world("q", "c", 0.11)])
        worlds = pd.DataFrame([world("s", "a", 0.05), world("s", "b", 0.0), world("s", "c", 5.0)])
        errors, counted, every, apart = statistics.verdict_errors(worlds, references)
        self.assertEqual((counted, every), (2, 3))
        self.assertEqual(errors["wrong"]["s"], 1)
        self.assertAlmostEqual(errors["difference"]["s"], (0.25 + 0.01) / 2)
        self.assertAlmostEqual(apart, (0.2 + 0.02) / 2)

    def test_a_world_that_failed_is_wrong(self):
        references = pd.DataFrame([world("r", "a", 0.0), world("q", "a", 0.0)])
        errors, *_ = statistics.verdict_errors(pd.DataFrame([world("s", "a", float("nan"))]), references)
        self.assertEqual(errors["wrong"]["s"], 1)


class Consensus(unittest.TestCase):
    def setUp(self):
        places = [place("p", 1, 0.0), place("q", 1, 0.0005), place("p", 2, 0.0), place("q", 2, 0.002),
                  place("p", 3, 1.0), place("q", 3, 1.0)]
        self.middle, self.share = statistics.consensus(pd.DataFrame(places))

    def test_boxes_further_apart_than_a_millimetre_are_left_out(self):
        self.assertEqual(list(self.middle.index.get_level_values("box")), [1, 3])
        self.assertAlmostEqual(self.middle["x"].iloc[0], 0.00025)
        self.assertAlmostEqual(self.share[0.5], 2 / 3)

    def test_far_boxes_and_missing_ones_count_as_the_cap(self):
        errors = statistics.consensus_errors(pd.DataFrame([place("s", 1, 0.00025)]), self.middle)
        self.assertAlmostEqual(errors["mean"][0.5]["s"], statistics.CAP / 2)
        errors = statistics.consensus_errors(pd.DataFrame([place("s", 1, 0.00325), place("s", 3, 9.0)]), self.middle)
        self.assertAlmostEqual(errors["mean"][0.5]["s"], (0.003 + 0.01) / 2)
        self.assertAlmostEqual(errors["rms"][0.5]["s"], ((0.003**2 + 0.01**2) / 2)**0.5)


class Front(unittest.TestCase):
    def test_a_setting_that_is_dearer_and_no_better_is_not_on_the_front(self):
        cost = pd.Series({"dear": 4.0, "cheap": 1.0, "beaten": 2.0, "middle": 3.0})
        error = pd.Series({"dear": 0.1, "cheap": 5.0, "beaten": 5.0, "middle": 2.0})
        self.assertEqual(statistics.pareto_front(cost, error), ["cheap", "middle", "dear"])


if __name__ == "__main__":
    unittest.main()
