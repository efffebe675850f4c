"""Replicas: worlds with friction that is not known exactly, and all the program writes of them."""
import csv
import json
import unittest

import numpy as np

from cli import REST, SEED_LAYOUT, SOURCE, CliTest, datasets, layout_text, schedulers

CONFIG = "[Native]\nAccuracy = screening\n[Screening]\nReplicas = 32\n"
BRAKE = "0 1 4.6 0 0\n"  # m/s2: near what friction of 0.5 holds
BUNDLED = [SOURCE / "configs/layouts" / name for name in ("BR15_077_wall.txt", "BR5_020_wall_h60.txt")]
NAMES = {f"/replicas/{name}" for name in ("count", "failed", "share", "wilson_low", "wilson_high", "verdict", "simulated",
                                          "cpu_seconds", "box_share")}


class Replicas(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", CONFIG)
        self.inputs = ["--layouts", SEED_LAYOUT, *BUNDLED, "--accelerations", self.write("brake.txt", BRAKE),
                       self.write("rest.txt", REST)]

    def screen(self, *arguments, output="replicas.h5", config="config.ini"):
        done = self.run_here("screen", "-c", config, *self.inputs, "-o", output, "--no-series", *arguments)
        self.assert_exit(done, 0)
        return done, datasets(self.folder / output)

    def test_change_nothing_of_the_worlds(self):
        self.write("plain.ini", CONFIG.replace("Replicas = 32", ""))
        plain, none = self.screen(output="plain.h5", config="plain.ini")
        done, data = self.screen()
        self.assertEqual(set(data) - set(none), NAMES)
        np.testing.assert_array_equal(data["/worlds/state_hash"], none["/worlds/state_hash"])
        self.assertNotIn("replicas", plain.stdout)
        self.assertIn("replicas: each world again", done.stdout)
        same, by_option = self.screen("--replicas", 32, output="option.h5", config="plain.ini")
        np.testing.assert_array_equal(by_option["/replicas/box_share"], data["/replicas/box_share"])
        self.assertEqual(same.stdout.replace("option.h5", "replicas.h5"), done.stdout)

    def test_are_consistent(self):
        data = {name.rsplit("/", 1)[1]: values for name, values in self.screen()[1].items() if name in NAMES}
        np.testing.assert_array_equal(data["share"], data["failed"] / data["count"])
        self.assertTrue((data["wilson_low"] <= data["share"]).all() and (data["share"] <= data["wilson_high"]).all())
        np.testing.assert_array_equal(data["verdict"] == 1, data["wilson_high"] < 0.125)
        np.testing.assert_array_equal(data["verdict"] == 2, data["wilson_low"] > 0.5)
        # Layout by layout: brake, rest. All hold at rest, told by one world each.
        np.testing.assert_array_equal(data["verdict"][1::2], 1)
        np.testing.assert_array_equal(data["simulated"][1::2], 1)
        self.assertTrue((data["failed"][0::2] > 0).any())

    def test_are_the_same_whatever_runs_beside_them(self):
        _, together = self.screen("--threads", 2)
        for scheduler in schedulers():
            _, other = self.screen("--scheduler", scheduler, "--threads", 3, output=f"{scheduler}.h5")
            for name in NAMES - {"/replicas/cpu_seconds"}:
                np.testing.assert_array_equal(together[name], other[name])
        self.inputs = ["--layouts", BUNDLED[1], "--accelerations", "brake.txt"]
        _, alone = self.screen(output="alone.h5")
        self.assertEqual(alone["/replicas/share"][0], together["/replicas/share"][4])
        np.testing.assert_array_equal(alone["/replicas/box_share"],
                                      together["/replicas/box_share"][together["/boxes/world"] == 4])

    def test_are_written_as_table_and_json(self):
        done, data = self.screen("--json")
        worlds = [json.loads(line)["replicas"] for line in done.stdout.splitlines()]
        self.assertEqual([world["failed"] for world in worlds], data["/replicas/failed"].tolist())
        self.assertEqual([world["wilson_95"][1] for world in worlds], data["/replicas/wilson_high"].tolist())
        again = self.run_here("screen", "-c", "config.ini", *self.inputs, "-o", "replicas.h5", "--no-series", "--json",
                              "--resume")
        self.assertEqual(again.stdout, done.stdout)
        self.run_here("summary", "replicas.h5", "--csv", "tables")
        with open(self.folder / "tables/replicas.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([float(row["share"]) for row in rows], data["/replicas/share"].tolist())
        self.assertEqual([row["verdict"] for row in rows],
                         [("none", "holds", "fails", "uncertain")[i] for i in data["/replicas/verdict"]])

    def test_worlds_that_are_not_simulated_have_none(self):
        bad = self.write("bad.txt", "1 1\n0 0 0 80 60\n")
        self.inputs = ["--layouts", SEED_LAYOUT, bad, "--accelerations", "rest.txt"]
        done = self.run_here("screen", "-c", "config.ini", *self.inputs, "-o", "replicas.h5")
        self.assert_exit(done, 1)
        data = datasets(self.folder / "replicas.h5")
        self.assertEqual(data["/replicas/count"].tolist(), [32, 0])
        self.assertEqual(data["/replicas/verdict"].tolist(), [1, 0])
        self.assertTrue(np.isnan(data["/replicas/share"][1]))

    def test_a_world_that_ends_early_has_replicas_that_do(self):
        tower = self.write("tower.txt", layout_text([(200, 100, 40 * i, 230, 130, 40 * (i + 1)) for i in range(5)]))
        self.inputs = ["--layouts", tower, "--accelerations", "brake.txt"]
        _, whole = self.screen()
        _, early = self.screen("--stop-when", "moved", output="early.h5")
        self.assertEqual(whole["/replicas/verdict"].tolist(), [2])
        self.assertEqual(early["/replicas/verdict"].tolist(), [2])
        self.assertTrue((early["/replicas/box_share"] <= whole["/replicas/box_share"]).all())

    def test_what_makes_no_sense_is_refused(self):
        def refused(message, *arguments, config="config.ini"):
            done = self.run_here("screen", "-c", config, *self.inputs, *arguments)
            self.assert_exit(done, 2)
            self.assertIn(message, done.stderr.splitlines()[0])

        refused("8; accepted is 0 or a whole number from 27 to 1000", "--replicas", 8)
        self.write("same.ini", CONFIG + "FrictionSpread = 0\n")
        refused("replicas are all the same where neither friction, acceleration nor places vary", config="same.ini")
        self.write("unasked.ini", CONFIG.replace("Replicas = 32", "FrictionSpread = 0"))
        refused("replicas are all the same where neither friction, acceleration nor places vary", "--replicas", 32,
                config="unasked.ini")
        self.write("wide.ini", CONFIG + "FrictionSpread = 0.5\n")
        refused("a number from 0 to 0.3", config="wide.ini")


if __name__ == "__main__":
    unittest.main()
