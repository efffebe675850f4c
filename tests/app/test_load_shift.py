"""How far the load shifts, in all that the program writes: table, file, CSV, JSON."""
import csv
import json
import unittest

from cli import CliTest, datasets, layout_text

# Two boxes of the same mass, without friction: one slides 10 cm to the front wall, the other is at it.
BOXES = [(10, 60, 0, 110, 160, 40), (0, 0, 0, 100, 50, 80)]
CONFIG = "[Contact]\nFrictionModel = pairs\nBoxBox = 0\nBoxFloor = 0\nBoxWall = 0\n"


class LoadShift(CliTest):
    def test_a_shift_in_file_table_csv_and_json(self):
        self.write("config.ini", CONFIG)
        self.write("two.txt", layout_text(BOXES))
        self.write("brake.txt", "0 0.5 5 0 0\n")
        arguments = ("screen", "-c", "config.ini", "--layouts", "two.txt", "--accelerations", "brake.txt", "--overwrite")
        done = self.run_here(*arguments, "--load-shift")
        self.assert_exit(done, 0)
        self.assertRegex(done.stdout, r"load shift: .*\n +layout .*\n +two\.txt +0\.05\d +-0\.05\d +")
        data = datasets(self.folder / "results.h5")
        end = data["/load_shift/end"][0]
        self.assertAlmostEqual(end[0], -0.05, delta=0.002)

        self.assert_exit(self.run_here("summary", "results.h5", "--csv", "tables"), 0)
        with open(self.folder / "tables/worlds.csv", newline="") as file:
            (row,) = csv.DictReader(file)
        self.assertEqual([float(row[f"load_shift_end_{axis}_m"]) for axis in "xyz"], end.tolist())

        without = self.run_here(*arguments, "--json")
        self.assertNotIn("load_shift", without.stdout)
        world = json.loads(self.run_here(*arguments, "--json", "--load-shift").stdout)
        self.assertAlmostEqual(world["load_shift"]["end_m"], 0.05, delta=0.002)


if __name__ == "__main__":
    unittest.main()
