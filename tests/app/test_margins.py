"""How many g layouts stand: against full simulations, against a linear program, and in all the program writes."""
import csv
import json
import re
import unittest

import numpy as np

from cli import SEED_LAYOUT, SOURCE, CliTest, datasets, layout_text
from test_balance import CONFIG, bridge, leaning_row, limit_of, random_stack, storeys, wall

WIDTH = 0.005  # g, by which a margin may be too small
DIRECTIONS = ("front", "rear", "left", "right")
PUSH = {"front": (1, 0), "rear": (-1, 0), "left": (0, 1), "right": (0, -1)}  # acceleration of the container along x, y
GRAVITY = 9.81  # m/s2
BUNDLED = [SOURCE / "configs/layouts" / name for name in ("BR15_077_wall.txt", "BR8_009_wall_h60.txt", "seed_example.txt")]


class Margins(CliTest):
    def margins(self, *arguments, layouts, output="margins.h5"):
        done = self.run_here("margins", "--layouts", *layouts, "--quiet", "-o", output, *arguments)
        self.assert_exit(done, 0)
        return datasets(self.folder / output)

    def test_full_simulations_move_above_a_margin_and_not_below(self):
        """A constant acceleration for two seconds, by the same program without any of the search."""
        data = self.margins("--accuracy", "screening", layouts=BUNDLED)
        for layout, row in zip(BUNDLED, data["/margins/margin"]):
            expected = {}
            for direction, margin in zip(DIRECTIONS, row):
                for share in (0.95, 1.05):
                    if share * margin <= 1.5:
                        x, y = (share * margin * GRAVITY * part for part in PUSH[direction])
                        name = f"{direction}_{share}.txt"
                        self.write(name, f"0 2 {x!r} {y!r} 0\n")
                        expected[name] = share < 1
            done = self.run_here("screen", "--accuracy", "screening", "--layouts", layout, "--accelerations", *expected,
                                 "--json", "--no-series", "--overwrite")
            worlds = [json.loads(line) for line in done.stdout.splitlines()]
            self.assertEqual({world["acceleration"]: world["peak_displacement_m"] < 0.005 for world in worlds}, expected)

    def test_random_stacks_stand_up_to_the_limit_of_a_linear_program(self):
        for make, seed in ((bridge, 3), (bridge, 15), (storeys, 7), (wall, 4), (wall, 12)):
            with self.subTest(make=make.__name__, seed=seed):
                stack = random_stack(make, seed)
                margins = self.margins_of_stack(stack)
                for direction, sign in (("front", 1), ("rear", -1)):
                    least, most = limit_of(stack, sign), limit_of(stack, sign, outside=True)
                    self.assertLessEqual(margins[direction], 1.002 * most)
                    self.assertGreaterEqual(margins[direction], 0.99 * least - WIDTH)

    def test_rows_that_lean_never_stand_more_than_the_linear_program(self):
        for seed in range(4):
            with self.subTest(seed=seed):
                stack = random_stack(leaning_row, seed)
                margins = self.margins_of_stack(stack)
                for direction, sign in (("front", 1), ("rear", -1)):
                    self.assertLessEqual(margins[direction], 1.002 * limit_of(stack, sign, outside=True))

    def margins_of_stack(self, stack):
        masses = "".join(f"[Material {i}]\nMass = {mass}\n" for i, mass in enumerate(stack.masses, 1))
        self.write("config.ini", CONFIG.format(friction=stack.friction) + masses)
        lines = ("\t".join(f"{value:g}" for value in (*box, i)) for i, box in enumerate(stack.boxes, 1))
        self.write("stack.txt", "\n".join([f"1 {len(stack.boxes)}", *lines, ""]))
        data = self.margins("-c", "config.ini", "--overwrite", layouts=["stack.txt"])
        return dict(zip(DIRECTIONS, data["/margins/margin"][0].tolist()))

    def test_are_the_same_whatever_runs_beside_them(self):
        together = self.margins("--threads", 2, layouts=BUNDLED)
        alone = self.margins("--scheduler", "serial", layouts=BUNDLED[1:2], output="alone.h5")
        np.testing.assert_array_equal(together["/margins/margin"][1:2], alone["/margins/margin"])
        np.testing.assert_array_equal(together["/margins/critical_box"][1:2], alone["/margins/critical_box"])

    def test_replicas_tell_how_far_friction_moves_a_margin(self):
        """One box on the floor stands its friction, and that of its replicas."""
        self.write("config.ini", "[Contact]\nFrictionModel = pairs\nBoxFloor = 0.4\n[Screening]\nReplicas = 32\n")
        self.write("box.txt", "1 1\n200 100 0 300 200 20 1\n")
        done = self.run_here("margins", "-c", "config.ini", "--layouts", "box.txt", "--json", "-o", "margins.h5")
        self.assert_exit(done, 0)
        data = datasets(self.folder / "margins.h5")
        low, median, high = (data[f"/margin_spread/{name}"][0] for name in ("low", "median", "high"))
        # 5 and 95 % of a normal distribution with a standard deviation of 10 %, of which 32 numbers are known.
        np.testing.assert_allclose(median, 0.4, atol=0.03)
        np.testing.assert_allclose(low, 0.4 * (1 - 0.1645), atol=0.03)
        np.testing.assert_allclose(high, 0.4 * (1 + 0.1645), atol=0.03)
        for name in ("margin", "margin_within_limits"):
            self.assertTrue((low < data[f"/margins/{name}"][0]).all() and (data[f"/margins/{name}"][0] < high).all())
        told = next(json.loads(line) for line in done.stdout.splitlines() if "margins_g" in line)
        self.assertEqual(told["margins_5_50_95_g"]["rear"], [low[1], median[1], high[1]])
        self.assert_exit(self.run_here("summary", "margins.h5", "--csv", "tables"), 0)
        rows = list(csv.DictReader((self.folder / "tables/margins.csv").read_text().splitlines()))
        self.assertEqual([float(rows[3][f"{name}_g"]) for name in ("low", "median", "high")], [low[3], median[3], high[3]])
        table = self.run_here("summary", "margins.h5").stdout
        self.assertRegex(table, r"box\.txt( +0\.40 /  0\.40){4}  \w+, box 1, 0\.3\d to 0\.4\d g\n")

    def test_are_found_beside_worlds_and_change_nothing_of_them(self):
        slide = self.write("slide.txt", "0 1 6 0 0\n")
        files = ["--layouts", *BUNDLED, "--accelerations", slide]
        self.assert_exit(self.run_here("screen", *files, "-o", "plain.h5"), 0)
        done = self.run_here("screen", *files, "--margins", "-o", "both.h5")
        plain, both = datasets(self.folder / "plain.h5"), datasets(self.folder / "both.h5")
        self.assertEqual({name for name in both if name not in plain},
                         {f"/margins/{name}" for name in ("margin", "critical_box", "margin_within_limits",
                                                          "critical_box_within_limits", "trials", "cpu_seconds")})
        np.testing.assert_array_equal(plain["/worlds/state_hash"], both["/worlds/state_hash"])
        self.assertRegex(done.stdout, r"\n  layout +front +rear +left +right  weakest\n  ")
        self.assertRegex(done.stdout, r"\n  BR15_077_wall\.txt +0\.\d\d / [ \d.+]+0\.\d\d /  0\.\d\d +1\.50\+ / 1\.50\+ +0\.\d\d /  0\.\d\d  rear, box \d+\n")
        self.assertNotIn("weakest", self.run_here("summary", "plain.h5").stdout)
        self.assertRegex(self.run_here("summary", "both.h5").stdout, r"rear, box \d+\n")

    def test_stand_beside_what_a_norm_needs(self):
        done = self.run_here("margins", "--layouts", *BUNDLED, "--norm", "road", "--accuracy", "screening", "-o", "road.h5")
        table = done.stdout[done.stdout.index("margins:"):].splitlines()
        self.assertEqual(table[2].split(), "needed by road 0.80 0.50 0.50 0.50".split())
        needed = list(map(float, table[2].split()[3:]))
        within = [list(map(float, re.findall(r"/ +([\d.]+)", row))) for row in table[3:3 + len(BUNDLED)]]
        shares = [min(limit / need for limit, need in zip(row, needed)) for row in within]
        self.assertEqual(shares, sorted(shares))  # of what is needed, the least first
        self.assertRegex(done.stdout, r"\n  seed_example\.txt +0\.50 /  0\.50 +0\.37 /  0\.37 +1\.50\+ / 1\.50\+ +0\.27 /  0\.27"
                                      r"  right, box 3; needs 0\.5 g\n")
        self.assertIn("\n".join(table[:6]), self.run_here("summary", "road.h5").stdout)
        worlds = datasets(self.folder / "road.h5")["/worlds/acceleration"]
        self.assertEqual(len(worlds), 4 * len(BUNDLED))

    def test_are_written_as_tables_and_json(self):
        data = self.margins(layouts=BUNDLED)
        self.run_here("summary", "margins.h5", "--csv", "tables")
        with open(self.folder / "tables/margins.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([row["direction"] for row in rows], list(DIRECTIONS) * 3)
        for name in ("margin", "margin_within_limits"):
            np.testing.assert_array_equal([float(row[f"{name}_g"]) for row in rows], data[f"/margins/{name}"].ravel())
        done = self.run_here("margins", "--layouts", *BUNDLED, "--json", "-o", "again.h5")
        lines = [json.loads(line) for line in done.stdout.splitlines() if "margins_g" in line]
        self.assertEqual([line["layout"] for line in lines], [path.name for path in BUNDLED])
        self.assertEqual([list(line["margins_g"].values()) for line in lines], data["/margins/margin"].tolist())
        again = self.run_here("margins", "--layouts", *BUNDLED, "--json", "--resume", "-o", "again.h5")
        self.assertEqual(sorted(again.stdout.splitlines()), sorted(done.stdout.splitlines()))

    def test_what_cannot_be_used_has_none(self):
        bad = self.write("bad.txt", "1 1\n0 0 0 80 60\n")
        falling = self.write("falling.txt", layout_text([(200, 100, 60, 280, 160, 120)]))
        done = self.run_here("margins", "--layouts", SEED_LAYOUT, bad, falling, "-o", "margins.h5")
        self.assert_exit(done, 1)
        margins = datasets(self.folder / "margins.h5")["/margins/margin"]
        self.assertTrue(np.isnan(margins[1]).all())
        np.testing.assert_allclose(margins[2], -1, atol=0.05)
        self.assertIn("unstable, box 1", done.stdout)

    def test_engines_that_cannot_find_them_say_so(self):
        for arguments in (["margins"], ["screen", "--accelerations", self.write("rest.txt", "0 1 0 0 0\n"), "--margins"]):
            done = self.run_here(*arguments, "--layouts", SEED_LAYOUT, "--engine", "native-plain")
            self.assert_exit(done, 2)
            self.assertEqual(done.stderr, "this engine cannot find margins, since its worlds cannot go back in time: "
                                          "native-plain; leave margins out, or take the engine native\n")


if __name__ == "__main__":
    unittest.main()
