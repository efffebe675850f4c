"""`--norm` and `[Screening] Norm`: the accelerations of a norm in `screen`, `run` and `serve`; `holdfast norms`."""
import json
import unittest

import h5py
import numpy as np

from cli import REST, SEED, SEED_LAYOUT, SHOVE, SOURCE, CliTest, datasets, layout_text

ROAD = ["road-front-0g8", "road-rear-0g5", "road-left-0g5", "road-right-0g5"]
FILES = ["road_brake_0g8", "road_rearward_0g5", "road_corner_right_0g5", "road_corner_left_0g5"]
NUMBERS = "norm road: front 0.8 g, rear 0.5 g, left 0.5 g, right 0.5 g; source: EN 12195-1"


def names(path):
    with h5py.File(path) as file:
        return list(file["inputs/accelerations/name"].asstr())


class Screen(CliTest):
    def screen_seed(self, *arguments, output="results.h5", expect=0):
        done = self.run_here("screen", "--accuracy", "screening", "--layouts", SEED_LAYOUT, *arguments, "-o", output)
        self.assert_exit(done, expect)
        return done

    def test_the_road_has_the_bits_of_its_files(self):
        done = self.screen_seed("--norm", "road")
        self.assertIn(NUMBERS, done.stderr)
        self.assertIn("road-front-0g8", done.stdout)
        files = [SOURCE / f"configs/accelerations/{name}.txt" for name in FILES]
        self.screen_seed("--accelerations", *files, output="files.h5")
        self.assertEqual(names(self.folder / "results.h5"), ROAD)
        by_norm, by_files = (datasets(self.folder / name, ("/worlds", "/series", "/boxes"))
                             for name in ("results.h5", "files.h5"))
        np.testing.assert_array_equal(by_norm["/worlds/state_hash"], by_files["/worlds/state_hash"])
        np.testing.assert_array_equal(by_norm["/series/displacement"], by_files["/series/displacement"])
        self.assertNotIn("norm", self.screen_seed("--norm", "road", "--quiet", "--overwrite").stderr)

    def test_results_say_the_norm_and_a_resumed_run_has_the_same_one(self):
        self.screen_seed("--norm", "eumos-40509:0.50")
        with h5py.File(self.folder / "results.h5") as file:
            self.assertEqual(file["inputs/settings"].attrs["Screening/Norm"], "eumos-40509:0.5")
            self.assertEqual(len(set(file["inputs/accelerations/sha256"].asstr())), 4)
            self.assertEqual(list(file["inputs/accelerations/segment_count"]), [8] * 4)
        self.assertIn("complete already", self.screen_seed("--norm", "eumos-40509:0.5", "--resume").stderr)
        refused = self.screen_seed("--norm", "eumos-40509:0.6", "--resume", expect=2)
        self.assertIn("accelerations", refused.stderr)

    def test_files_come_after_the_norm(self):
        self.write("shove.txt", SHOVE)
        self.write("config.ini", "[Screening]\nNorm = sea-a\n")
        self.screen_seed("--norm", "road", "--accelerations", "shove.txt", "-c", "config.ini", "--text", "text")
        self.assertEqual(names(self.folder / "results.h5"), [*ROAD, "shove.txt"])
        self.assertTrue((self.folder / "text/[SOLUTION]$seed_example$road-front-0g8").exists())
        self.screen_seed("-c", "config.ini", "--overwrite")
        self.assertEqual(names(self.folder / "results.h5")[0], "sea-a-front-0g3")

    def test_a_wrong_norm_is_refused_in_one_line(self):
        for arguments, words in ((("--norm", "raod"), ("unknown norm: raod", "did you mean road?", "rail-en12195")),
                                 (("--norm", "eumos-40509"), ("such as eumos-40509:0.5",)),
                                 ((), ("--accelerations is required", "--norm"))):
            with self.subTest(arguments=arguments):
                done = self.screen_seed(*arguments, expect=2)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)


class Run(CliTest):
    def test_a_norm_takes_the_place_of_acceleration_files(self):
        self.write("seed.txt", layout_text(SEED))
        self.write("config.ini", "[Native]\nAccuracy = screening\n[Screening]\nLayout = seed.txt\nNorm = road\n")
        self.assert_exit(self.run_here("run", "config.ini"), 0)
        self.assertEqual(names(self.folder / "results.h5"), ROAD)

    def test_a_batch_needs_no_acceleration_file_and_may_have_some(self):
        self.write("cases/seed.txt", layout_text(SEED))
        self.write("config.ini", "[Native]\nAccuracy = screening\n[Simulation Settings]\nBatchSimulation = true\n"
                                 "BatchPath = cases\n")
        self.assert_exit(self.run_here("run", "config.ini", "--norm", "road"), 0)
        self.assertEqual(names(self.folder / "results.h5"), ROAD)
        self.write("cases/rest.txt", REST)
        self.assert_exit(self.run_here("run", "config.ini", "--norm", "road", "--overwrite"), 0)
        self.assertEqual(names(self.folder / "results.h5"), [*ROAD, "rest.txt"])


class Serve(CliTest):
    def answers(self, *arguments, lines):
        text = "".join(json.dumps(line) + "\n" for line in lines)
        done = self.run_here("serve", "--ordered", "--accuracy", "screening", *arguments, input=text)
        self.assert_exit(done, 0)
        return done, [json.loads(answer) for answer in done.stdout.splitlines()]

    def test_a_line_may_choose_among_norm_and_files(self):
        self.write("rest.txt", REST)
        self.write("config.ini", "[Screening]\nNorm = road\n")
        boxes = [[1.0, 1.0, 0.0, 1.5, 1.5, 0.5, 1]]
        chosen = ["rest.txt", "road-rear-0g5"]
        for given in (("--norm", "road"), ("-c", "config.ini")):
            done, answers = self.answers(*given, "--accelerations", "rest.txt",
                                         lines=[{"boxes": boxes}, {"boxes": boxes, "accelerations": chosen}])
            self.assertIn(NUMBERS, done.stderr)
            self.assertEqual([world["acceleration"] for world in answers[0]["verdicts"]], [*ROAD, "rest.txt"])
            self.assertEqual([world["acceleration"] for world in answers[1]["verdicts"]], chosen)

    def test_it_needs_one_of_both(self):
        done = self.run_here("serve")
        self.assert_exit(done, 2)
        self.assertIn("--norm", done.stderr)


class List(CliTest):
    def test_fits_a_screen_and_has_the_numbers(self):
        done = self.run_here("norms")
        self.assert_exit(done, 0)
        self.assertIn("front 0.8 g, rear 0.5 g", done.stdout)
        self.assertLess(len(done.stdout.splitlines()), 45)
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 115)


class Friction(CliTest):
    def screen(self, text):
        self.write("seed.txt", layout_text(SEED))
        self.write("rest.txt", REST)
        self.write("config.ini", text)
        return self.run_here("screen", "-c", "config.ini", "--layouts", "seed.txt", "--accelerations", "rest.txt",
                             "--overwrite")

    def test_a_pair_by_name_is_its_coefficient(self):
        self.assert_exit(self.screen("[Contact]\nFrictionModel = pairs\nBoxFloor = timber-steel-wet\n"), 0)
        with h5py.File(self.folder / "results.h5") as file:
            self.assertEqual(file["inputs/settings"].attrs["Contact/BoxFloor"], "0.3")

    def test_a_name_in_the_wrong_place_says_the_right_one(self):
        for key in ("BoxFriction", "ContainerFriction"):
            done = self.screen(f"[Simulation Settings]\n{key} = cardboard-pallet\n")
            self.assert_exit(done, 2)
            self.assertIn(f"config.ini:2:{len(key) + 4}: {key} has a wrong value: cardboard-pallet", done.stderr)
            self.assertIn("FrictionModel = pairs", done.stderr)


if __name__ == "__main__":
    unittest.main()
