"""What impacts do to boxes, in all that the program writes: file, table, CSV, JSON, and what it refuses."""
import csv
import json
import unittest

import h5py
import numpy as np

from cli import CliTest, SHOVE, datasets, layout_text, same_bits, schedulers

# One box 10 cm from the front wall, without friction: the wall takes it over at 1 m/s. Another one is held by the wall.
BOXES = [(10, 60, 0, 110, 160, 40), (0, 0, 0, 100, 50, 40)]
BRAKE = "0 0.5 5 0 0\n"
CONFIG = """\
[Contact]
FrictionModel = pairs
BoxBox = 0
BoxFloor = 0
BoxWall = 0
[Screening]
CriticalAcceleration = 4
CriticalVelocityChange = 0.9
"""


class Damage(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", CONFIG)
        self.write("two.txt", layout_text(BOXES))
        self.write("brake.txt", BRAKE)
        self.write("shove.txt", SHOVE)

    def screen_two(self, *arguments, expect=0):
        done = self.run_here("screen", "-c", "config.ini", "--layouts", "two.txt", "--accelerations", "brake.txt",
                             "--overwrite", *arguments)
        self.assert_exit(done, expect)
        return done

    def test_an_impact_in_file_table_csv_and_json(self):
        done = self.screen_two("--damage")
        table = done.stdout[done.stdout.index("damage:"):]
        self.assertRegex(table, r"two\.txt +1 +5\.\d +1\.0\d  box 1, brake\.txt\n")
        self.assertIn("beyond the boundary in 1 of 1 accelerated worlds", table)

        data = datasets(self.folder / "results.h5")
        self.assertEqual(data["/damage/boxes_beyond"].tolist(), [1])
        self.assertEqual(data["/damage/beyond"].tolist(), [1, 0])
        np.testing.assert_allclose(data["/damage/velocity_change"], [1, 0], atol=0.03)
        np.testing.assert_allclose(data["/damage/peak_acceleration"], [52.5, 5], atol=2.5)

        self.assert_exit(self.run_here("summary", "results.h5", "--csv", "tables"), 0)
        with open(self.folder / "tables/worlds.csv", newline="") as file:
            self.assertEqual([row["boxes_beyond"] for row in csv.DictReader(file)], ["1"])
        with open(self.folder / "tables/boxes.csv", newline="") as file:
            boxes = list(csv.DictReader(file))
        self.assertEqual([row["beyond"] for row in boxes], ["1", "0"])
        self.assertEqual([np.float32(row["peak_acceleration_m_s2"]) for row in boxes],
                         data["/damage/peak_acceleration"].tolist())
        self.assertEqual([np.float32(row["velocity_change_m_s"]) for row in boxes],
                         data["/damage/velocity_change"].tolist())

        world = json.loads(self.screen_two("--damage", "--json").stdout)
        self.assertEqual(world["damage"]["boxes_beyond"], 1)
        self.assertAlmostEqual(world["damage"]["velocity_change_m_s"], data["/damage/velocity_change"][0], delta=1e-6)

    def test_only_where_asked_for_and_without_a_change_of_the_rest(self):
        self.assertNotIn("damage", self.screen_two().stdout)
        without = datasets(self.folder / "results.h5")
        self.assertNotIn("damage", self.screen_two("--json").stdout)
        self.screen_two("--damage")
        measured = datasets(self.folder / "results.h5")
        self.assertEqual({name for name in measured if name not in without},
                         {name for name in measured if name.startswith("/damage/")})
        for name in ("/worlds/state_hash", "/series/displacement", "/summary/worlds/verdict", "/worlds/steps"):
            self.assertTrue(same_bits(without[name], measured[name]), name)

    def test_the_same_bits_whatever_the_threads_and_the_batch(self):
        self.write("other.txt", layout_text([(100, 60, 0, 200, 160, 200)]))
        self.write("config.ini", "[Physics Engine]\nSimulationStepsPerSecond = 240\n")
        for engine in ("native", "bullet-f64"):
            found = []
            for scheduler, threads, layouts in (("serial", "1", ["two.txt"]), (schedulers()[0], "4", ["two.txt", "other.txt"]),
                                                (schedulers()[-1], "3", ["two.txt", "other.txt", "two.txt"])):
                self.assert_exit(self.run_here("screen", "-c", "config.ini", "--layouts", *layouts, "--accelerations",
                                               "brake.txt", "shove.txt", "--damage", "--engine", engine, "--scheduler",
                                               scheduler, "--threads", threads, "--overwrite", "--no-series"), 0)
                data = datasets(self.folder / "results.h5")
                found.append(np.concatenate([data["/damage/peak_acceleration"][:4], data["/damage/velocity_change"][:4]]))
            self.assertTrue(all(same_bits(found[0], other) for other in found[1:]), engine)

    def test_is_refused_in_a_line_where_it_is_not_recorded(self):
        self.write("config.ini", "[Container]\nMotion = free\n")
        done = self.screen_two("--damage", "--engine", "bullet", expect=2)
        self.assertRegex(done.stderr, r"^damage is not recorded by this engine, or not with this motion of the container.*\n$")
        self.write("config.ini", "[Screening]\nDamageWindow = 0\n")
        done = self.screen_two("--damage", expect=2)
        self.assertRegex(done.stderr, r"config\.ini:2:\d+: .*DamageWindow.*0\.1 to 1000")

    def test_a_resumed_run_has_the_same_damage(self):
        self.write("broken.txt", "no layout\n")
        arguments = ["screen", "-c", "config.ini", "--layouts", "two.txt", "broken.txt", "--accelerations", "brake.txt",
                     "shove.txt", "--damage", "--json"]
        whole = self.run_here(*arguments, "-o", "whole.h5")
        resumed = self.run_here(*arguments, "-o", "whole.h5", "--resume")
        drop_costs = lambda line: {key: value for key, value in json.loads(line).items() if key != "cpu_seconds"}
        self.assertEqual([drop_costs(line) for line in whole.stdout.splitlines()],
                         [drop_costs(line) for line in resumed.stdout.splitlines()])
        self.assertNotIn("damage", json.loads(whole.stdout.splitlines()[2]))
        with h5py.File(self.folder / "whole.h5") as file:
            self.assertEqual(file["damage/boxes_beyond"][2:].tolist(), [2**32 - 1] * 2)


if __name__ == "__main__":
    unittest.main()
