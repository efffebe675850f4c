"""What analyses say of a world that was not accelerated, in all that the program writes: nothing."""
import csv
import json
import unittest

import numpy as np

from cli import FLOATING, SEED, CliTest, datasets, layout_text

ANALYSES = ("--damage", "--load-shift", "--walls", "en12642-xl")
COLUMNS = ["boxes_beyond", "load_shift_end_x_m", "load_shift_peak_x_m", "load_shift_peak_time_s"]


class NotAccelerated(CliTest):
    def setUp(self):
        super().setUp()
        self.write("floats.txt", layout_text(FLOATING))
        self.write("stands.txt", layout_text(SEED))
        self.write("brake.txt", "0 0.5 7 0 0\n")

    def screen(self, *arguments, begin="--overwrite"):
        done = self.run_here("screen", "--layouts", "floats.txt", "stands.txt", "--accelerations", "brake.txt", begin,
                             *ANALYSES, *arguments)
        self.assert_exit(done, 0)
        return done.stdout

    def rows(self, table):
        with open(self.folder / "tables" / table, newline="") as file:
            return list(csv.DictReader(file))

    def test_tables_have_the_accelerated_layouts_alone(self):
        text = self.screen()
        for table in ("damage:", "load shift:", "walls:"):
            lines = text[text.index(table):].split("\n\n")[0]
            self.assertIn("stands.txt", lines)
            self.assertNotIn("floats.txt", lines)
        self.assertEqual(text.count("of 1 accelerated worlds"), 2)

    def test_the_file_and_its_csv(self):
        self.screen()
        data = datasets(self.folder / "results.h5")
        self.assertEqual(data["/damage/boxes_beyond"][0], 2**32 - 1)
        for name in ("/damage/peak_acceleration", "/damage/velocity_change"):
            self.assertTrue(np.isnan(data[name][:len(FLOATING)]).all(), name)
            self.assertFalse(np.isnan(data[name][len(FLOATING):]).any(), name)
        for name in ("/load_shift/end", "/load_shift/peak", "/load_shift/peak_time", "/walls/lasting_force", "/walls/impulse"):
            self.assertTrue(np.isnan(data[name][0]).all(), name)
            self.assertFalse(np.isnan(data[name][1]).all(), name)
        self.assertEqual(len(data["/walls/force"]), len(data["/series/time"]))

        self.assert_exit(self.run_here("summary", "results.h5", "--csv", "tables"), 0)
        floats, stands = self.rows("worlds.csv")
        self.assertEqual([floats[column] for column in COLUMNS], [""] * len(COLUMNS))
        self.assertNotIn("", [stands[column] for column in COLUMNS])
        for box in self.rows("boxes.csv"):
            known = [box[column] != "" for column in ("peak_acceleration_m_s2", "velocity_change_m_s", "beyond")]
            self.assertEqual(known, [box["layout"] == "stands.txt"] * 3)
        self.assertEqual({row["layout"] for row in self.rows("walls.csv")}, {"stands.txt"})

    def test_json_of_a_run_and_of_one_that_goes_on(self):
        for begin in ("--overwrite", "--resume"):
            floats, stands = map(json.loads, self.screen("--json", begin=begin).splitlines())
            self.assertEqual((floats["verdict"], floats["layout"]), ("unstable", "floats.txt"))
            for name in ("damage", "load_shift", "walls"):
                self.assertNotIn(name, floats)
                self.assertIn(name, stands)


if __name__ == "__main__":
    unittest.main()
