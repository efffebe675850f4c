"""Forces on the walls in all that the program writes: file, table, CSV, JSON, and what it refuses."""
import csv
import json
import unittest

import h5py
import numpy as np

from cli import CliTest, SHOVE, datasets, layout_text, same_bits

SIDES = ["floor", "front", "rear", "left", "right", "roof", "ground", "fixed"]
GRAVITY, DENSITY = 9.81, 250.0
# Friction of 0.3 but at the walls: how these share the weight with the floor is not for statics to say.
CONFIG = """\
[Contact]
FrictionModel = pairs
BoxBox = 0.3
BoxFloor = 0.3
BoxWall = 0
"""
ROW = [(90 * i, 60, 0, 90 * (i + 1), 160, 50) for i in range(6)]
BRAKE = "0 1 7 0 0\n"
MASS = 6 * DENSITY * 0.9 * 1.0 * 0.5


class Walls(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", CONFIG)
        self.write("row.txt", layout_text(ROW))
        self.write("brake.txt", BRAKE)

    def screen_row(self, *arguments, expect=0):
        done = self.run_here("screen", "-c", "config.ini", "--layouts", "row.txt", "--accelerations", "brake.txt",
                             "--overwrite", *arguments)
        self.assert_exit(done, expect)
        return done

    def test_a_braked_row_in_file_table_csv_and_json(self):
        force = MASS * (7 - 0.3 * GRAVITY)
        limit = 0.4 * MASS * GRAVITY
        done = self.screen_row("--walls", "en12642-l")
        table = done.stdout[done.stdout.index("walls:"):]
        self.assertRegex(table, rf"row\.txt +{100 * force / limit:.0f} % +0 % +0 % +0 % +front, brake\.txt, exceeded\n")
        self.assertIn("exceeded in 1 of 1 accelerated worlds", table)

        data = datasets(self.folder / "results.h5")
        self.assertAlmostEqual(data["/walls/lasting_force"][0, 1] / force, 1, delta=1e-3)
        self.assertAlmostEqual(data["/walls/limit"][0, 1] / limit, 1, delta=1e-6)
        self.assertTrue(np.isnan(data["/walls/limit"][0, [0, 5]]).all())
        self.assertEqual(len(data["/walls/force"]), len(data["/series/time"]))
        np.testing.assert_allclose(data["/walls/force"][-1, :2], [MASS * GRAVITY, force], rtol=1e-3)
        # What acted on all sides for a second is the weight and what braking calls for.
        total = data["/walls/impulse"].reshape(8, 3).sum(axis=0)
        np.testing.assert_allclose(total, [-MASS * 7, 0, -MASS * GRAVITY], atol=1e-6 * MASS * GRAVITY)

        self.assert_exit(self.run_here("summary", "results.h5", "--csv", "tables"), 0)
        with open(self.folder / "tables/walls.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["side"] for row in rows], SIDES)
        self.assertEqual([row["exceeded"] for row in rows], ["0", "1"] + 6 * ["0"])
        self.assertEqual(float(rows[1]["lasting_force_N"]), data["/walls/lasting_force"][0, 1])
        self.assertEqual(rows[0]["limit_N"], "")

        world = json.loads(self.screen_row("--walls", "en12642-l", "--json").stdout)
        self.assertEqual(list(world["walls"]), SIDES)
        self.assertEqual(world["walls"]["front"]["lasting_force_N"], data["/walls/lasting_force"][0, 1])
        self.assertIsNone(world["walls"]["floor"]["limit_N"])

    def test_without_a_norm_forces_are_in_kilonewtons(self):
        done = self.screen_row("--wall-forces", "--no-series")
        self.assertRegex(done.stdout, r"in kN\n.*\n  row\.txt +2\.7 +0\.0 +0\.0 +0\.0  front, brake\.txt\n")
        self.assertEqual(datasets(self.folder / "results.h5")["/walls/force"].shape, (0, 8))

    def test_a_bulkhead_that_carries_the_row_has_a_column(self):
        self.write("row.txt", "1 7\n0 40 0 10 180 60 2\n" +
                   "".join(f"{x + 10} {y} {z} {x2 + 10} {y2} {z2} 1\n" for x, y, z, x2, y2, z2 in ROW))
        self.write("config.ini", CONFIG + "[Friction]\n1, 2 = 0\n[Material 2]\nFixed = true\n")
        force = MASS * (7 - 0.3 * GRAVITY) / 1000
        table = self.screen_row("--wall-forces").stdout
        self.assertIn("in kN; fixed: on all fixed boxes together\n", table)
        self.assertRegex(table, r"\n  layout +front +rear +left +right +fixed  largest\n")
        self.assertRegex(table, rf"\n  row\.txt +0\.0 +0\.0 +0\.0 +0\.0 +{force:.1f}  fixed, brake\.txt\n")
        # A norm tests no bulkhead.
        table = self.screen_row("--walls", "en12642-l").stdout
        self.assertRegex(table, rf"\n  row\.txt +0 % +0 % +0 % +0 % +{force:.1f} kN  -\n")
        self.assertIn("exceeded in 0 of 1 accelerated worlds", table)

    def test_only_where_asked_for_and_without_a_change_of_the_rest(self):
        self.assertNotIn("walls", self.screen_row().stdout)
        without = datasets(self.folder / "results.h5")
        self.screen_row("--wall-forces")
        measured = datasets(self.folder / "results.h5")
        self.assertEqual({name for name in measured if name not in without},
                         {name for name in measured if name.startswith("/walls/")})
        for name in ("/worlds/state_hash", "/series/displacement", "/summary/worlds/verdict", "/worlds/steps"):
            self.assertTrue(same_bits(without[name], measured[name]), name)

    def test_bullet_is_within_what_statics_leaves_open(self):
        self.write("config.ini", CONFIG + "[Screening]\nRunOutSeconds = 0\n")
        for engine, rounding in (("bullet", 1e-4), ("bullet-f64", 1e-5)):
            self.screen_row("--wall-forces", "--engine", engine)
            data = datasets(self.folder / "results.h5")
            floor, front = data["/walls/force"][-1, :2] / MASS
            self.assertAlmostEqual(floor / GRAVITY, 1, delta=0.01)
            self.assertGreater(front, 0.99 * (7 - 0.3 * GRAVITY))
            self.assertLess(front, 1.01 * (7 + 0.3 * GRAVITY))
            total = data["/walls/impulse"].reshape(8, 3).sum(axis=0)
            np.testing.assert_allclose(total, [-MASS * 7, 0, -MASS * GRAVITY], atol=rounding * MASS * GRAVITY)

    def test_is_refused_in_a_line_where_it_is_not_measured(self):
        self.write("config.ini", "[Container]\nMotion = free\n")
        for arguments in (("--engine", "native-plain"), ("-c", "config.ini", "--engine", "bullet")):
            done = self.run_here("screen", "--layouts", "row.txt", "--accelerations", "brake.txt", "--wall-forces",
                                 *arguments)
            self.assert_exit(done, 2)
            self.assertRegex(done.stderr, r"^wall forces are not measured by this engine.*\n$")
        done = self.run_here("screen", "--layouts", "row.txt", "--accelerations", "brake.txt", "--walls", "en")
        self.assert_exit(done, 2)
        self.assertIn("en12642-l, en12642-xl, en283 or iso-container", done.stderr)

    def test_a_resumed_run_has_the_same_forces(self):
        names = [f"row{i}.txt" for i in range(6)]
        for name in names:
            self.write(name, layout_text(ROW))
        self.write("broken.txt", "no layout\n")
        self.write("shove.txt", SHOVE)
        arguments = ["screen", "-c", "config.ini", "--layouts", *names[:3], "broken.txt", *names[3:],
                     "--accelerations", "brake.txt", "shove.txt", "--walls", "en283", "--json"]
        whole = self.run_here(*arguments, "-o", "whole.h5")
        resumed = self.run_here(*arguments, "-o", "whole.h5", "--resume")
        drop_costs = lambda line: {key: value for key, value in json.loads(line).items() if key != "cpu_seconds"}
        self.assertEqual([drop_costs(line) for line in whole.stdout.splitlines()],
                         [drop_costs(line) for line in resumed.stdout.splitlines()])
        with h5py.File(self.folder / "whole.h5") as file:
            self.assertTrue(np.isnan(file["walls/peak_force"][6:8]).all())
            self.assertFalse(np.isnan(file["walls/peak_force"][8:]).any())


if __name__ == "__main__":
    unittest.main()
