"""What geometry alone says of layouts, in all that the program writes: file, table, CSV and JSON."""
import csv
import json
import unittest

import h5py
import numpy as np

from cli import CliTest, SHOVE, datasets, layout_text, same_bits

# In the container of 587 by 233 by 220 cm: a block of three in the corner, one of them on top, and one far from all.
BOXES = [(0, 0, 0, 100, 100, 100), (100, 0, 0, 200, 100, 100), (50, 0, 100, 250, 100, 150), (400, 100, 0, 450, 150, 50)]
VOLUME = np.array([1, 1, 1, 0.125])
CENTRE = np.array([[0.5, 0.5, 0.5], [1.5, 0.5, 0.5], [1.5, 0.5, 1.25], [4.25, 1.25, 0.25]])


class Indicators(CliTest):
    def setUp(self):
        super().setUp()
        self.write("block.txt", layout_text(BOXES))
        self.write("broken.txt", "no layout\n")
        self.write("shove.txt", SHOVE)
        self.write("rest.txt", "0 1 0 0 0\n")

    def screen(self, *arguments, expect=0):
        done = self.run_here("screen", "--layouts", "block.txt", "--accelerations", "rest.txt", "shove.txt",
                             "--overwrite", *arguments)
        self.assert_exit(done, expect)
        return done

    def test_in_file_table_csv_and_json(self):
        done = self.screen("--indicators")
        self.assertRegex(done.stdout[done.stdout.index("indicators,"):],
                         r"block\.txt +10 % +-28 % +-27 % +33 % +0 % +75 %\n")
        data = datasets(self.folder / "results.h5")
        centre = (VOLUME[:, None] * CENTRE).sum(axis=0) / VOLUME.sum()
        np.testing.assert_allclose(data["/indicators/centre_of_gravity"], [centre])
        np.testing.assert_allclose(data["/indicators/centre_offset"], [centre / [5.87, 2.33, 2.2] - 0.5])
        np.testing.assert_allclose(data["/indicators/fill"], VOLUME.sum() / (5.87 * 2.33 * 2.2))
        np.testing.assert_allclose(data["/indicators/base_support"], [1, 1, 0.75, 1])
        self.assertEqual(data["/indicators/supported_sides"].tolist(), [3, 2, 1, 0])
        self.assertEqual((data["/indicators/badly_based"][0], data["/indicators/badly_braced"][0]), (0, 0.75))

        self.assert_exit(self.run_here("summary", "results.h5", "--csv", "tables"), 0)
        with open(self.folder / "tables/worlds.csv", newline="") as file:
            worlds = list(csv.DictReader(file))
        self.assertEqual([float(row["fill"]) for row in worlds], 2 * data["/indicators/fill"].tolist())
        self.assertEqual(float(worlds[1]["centre_offset_y"]), data["/indicators/centre_offset"][0, 1])
        with open(self.folder / "tables/boxes.csv", newline="") as file:
            boxes = list(csv.DictReader(file))
        self.assertEqual([row["supported_sides"] for row in boxes], 2 * ["3", "2", "1", "0"])
        self.assertEqual([np.float32(row["base_support"]) for row in boxes], 2 * data["/indicators/base_support"].tolist())

        layout = json.loads(self.screen("--indicators", "--json").stdout.splitlines()[0])
        self.assertEqual(layout["layout"], "block.txt")
        self.assertEqual(layout["indicators"]["fill"], data["/indicators/fill"][0])
        self.assertNotIn("margins_g", layout)

    def test_together_with_margins_and_damage(self):
        lines = self.screen("--indicators", "--margins", "--damage", "--json").stdout.splitlines()
        layout = json.loads(lines[0])
        self.assertIn("fill", layout["indicators"])
        self.assertIn("left", layout["margins_g"])
        self.assert_exit(self.run_here("summary", "results.h5", "--csv", "tables"), 0)
        with open(self.folder / "tables/boxes.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0][-5:], ["peak_acceleration_m_s2", "velocity_change_m_s", "beyond", "base_support",
                                        "supported_sides"])
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})

    def test_only_where_asked_for_and_without_a_change_of_the_rest(self):
        self.assertNotIn("indicators", self.screen().stdout)
        without = datasets(self.folder / "results.h5")
        self.screen("--indicators")
        told = datasets(self.folder / "results.h5")
        self.assertEqual({name for name in told if name not in without},
                         {name for name in told if name.startswith("/indicators/")})
        for name in ("/worlds/state_hash", "/summary/worlds/verdict"):
            self.assertTrue(same_bits(without[name], told[name]), name)

    def test_a_layout_that_cannot_be_used_and_a_resumed_run(self):
        arguments = ["screen", "--layouts", "block.txt", "broken.txt", "block.txt", "--accelerations", "rest.txt",
                     "shove.txt", "--indicators", "--json", "-o", "whole.h5"]
        whole = self.run_here(*arguments)
        resumed = self.run_here(*arguments, "--resume")
        of_layouts = lambda done: [line for line in done.stdout.splitlines() if "indicators" in line]
        self.assertEqual(len(of_layouts(whole)), 3)
        self.assertEqual(of_layouts(whole), of_layouts(resumed))
        self.assertIsNone(json.loads(of_layouts(whole)[1])["indicators"]["fill"])
        with h5py.File(self.folder / "whole.h5") as file:
            self.assertTrue(np.isnan(file["indicators/badly_braced"][1]))
            self.assertEqual(len(file["indicators/supported_sides"]), 8)
        done = self.run_here("summary", "whole.h5", "--csv", "tables")
        self.assertNotIn("broken.txt", done.stdout[done.stdout.index("indicators,"):])
        with open(self.folder / "tables/worlds.csv", newline="") as file:
            self.assertEqual([row["fill"] == "" for row in csv.DictReader(file)], [False, False, True, True, False, False])


if __name__ == "__main__":
    unittest.main()
