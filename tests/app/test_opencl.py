"""Bullet's OpenCL pipeline from outside: what the program says of devices, and what it does without one."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py

from cli import HOLDFAST, SOURCE, layout_text

WITHOUT = {**os.environ, "OCL_ICD_VENDORS": "/nonexistent"}


def holdfast(*words, env=None):
    return subprocess.run([HOLDFAST, *words], capture_output=True, text=True, env=env, check=False)


def line_of_engine(text):
    return next(line for line in text.splitlines() if line.startswith("bullet-opencl"))


class WithoutDevice(unittest.TestCase):
    def test_engines_says_why(self):
        done = holdfast("engines", "--devices", env=WITHOUT)
        self.assertEqual(done.returncode, 0)
        self.assertIn("missing: ", line_of_engine(done.stdout))
        self.assertRegex(done.stdout, "no OpenCL device; install a driver|cannot be loaded|is not there")

    def test_engines_asks_for_no_device_unless_told(self):
        asked, with_drivers, without = holdfast("engines", "--devices", env=WITHOUT), holdfast("engines"), holdfast("engines", env=WITHOUT)
        self.assertEqual((without.returncode, without.stderr), (0, ""))
        self.assertEqual(without.stdout, with_drivers.stdout)
        if "plug-in" not in without.stdout:
            self.assertIn("\n                 `holdfast engines --devices` looks for devices\n", without.stdout)
            self.assertNotIn("missing", without.stdout)
            self.assertIn("missing", asked.stdout)

    def test_validate_names_it(self):
        done = holdfast("validate", "--engine", "bullet-opencl", "--case", "slide_path", env=WITHOUT)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "no OpenCL device|cannot be loaded|is not there")


class WithDevice(unittest.TestCase):
    def setUp(self):
        self.done = holdfast("engines", "--devices")
        if "missing" in line_of_engine(self.done.stdout):
            print("skipped:", line_of_engine(self.done.stdout), file=sys.stderr)
            self.skipTest("no OpenCL device")

    def test_engines_lists_devices_and_nothing_leaks(self):
        self.assertRegex(self.done.stdout, r"\n +(CPU|GPU|accelerator) .+compute units, \d+ MiB")
        self.assertEqual(self.done.stderr, "")

    def test_nothing_is_left_in_a_folder_named_cache(self):
        # Where there is one, Bullet leaves the binaries of its kernels there.
        with tempfile.TemporaryDirectory() as folder:
            cache = pathlib.Path(folder, "cache")
            cache.mkdir()
            done = subprocess.run([HOLDFAST, "engines", "--devices"], capture_output=True, cwd=folder, check=False)
            self.assertEqual((done.returncode, done.stderr, list(cache.iterdir())), (0, b"", []))

    def test_a_real_load_under_two_accelerations_agrees_with_bullet(self):
        found = {}
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder, "config.ini")
            config.write_text("[Physics Engine]\nSimulationStepsPerSecond = 120\n")
            for engine in ("bullet", "bullet-opencl"):
                results = pathlib.Path(folder, engine + ".h5")
                done = holdfast("screen", "--quiet", "-c", str(config), "--engine", engine, "-o", str(results), "--layouts",
                                str(SOURCE / "configs/layouts/unstable_BR2_007_bpjs.txt"), "--accelerations",
                                str(SOURCE / "configs/accelerations/road_brake_0g8.txt"),
                                str(SOURCE / "configs/accelerations/road_corner_left_0g5.txt"))
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
                with h5py.File(results) as file:
                    self.assertTrue((file["worlds/status"][:] == 0).all())
                    found[engine] = {name: file["summary/worlds"][name][:] for name in ("fallen_boxes", "peak_displacement")}
        self.assertEqual(list(found["bullet-opencl"]["fallen_boxes"]), list(found["bullet"]["fallen_boxes"]))
        for ours, bullets in zip(found["bullet-opencl"]["peak_displacement"], found["bullet"]["peak_displacement"]):
            self.assertAlmostEqual(ours, bullets, delta=0.05)

    def test_worlds_that_are_decided_early_are_those_of_whole_runs(self):
        # On its floor a box holds 1 m/s² and slides under 7 m/s²; one at the front wall slides only away from it.
        accelerations = {"weak.txt": "0 0.5 1 0 0\n", "brake.txt": "0 0.8 7 0 0\n", "start.txt": "0 0.8 -7 0 0\n"}
        layouts = {"free.txt": [(200, 50, 0, 280, 110, 40)], "front.txt": [(0, 50, 0, 80, 110, 40)],
                   "two.txt": [(200, 50, 0, 280, 110, 40), (200, 50, 40, 280, 110, 80)]}
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "config.ini").write_text("[Physics Engine]\nSimulationStepsPerSecond = 120\n")
            for name, text in {**accelerations, **{name: layout_text(boxes) for name, boxes in layouts.items()}}.items():
                pathlib.Path(folder, name).write_text(text)

            def worlds(*options):
                done = subprocess.run([HOLDFAST, "screen", "--quiet", "--json", "--overwrite", "-c", "config.ini", "--engine",
                                       "bullet-opencl", "-o", "results.h5", "--layouts", *layouts, "--accelerations",
                                       *accelerations, *options], cwd=folder, capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                return [{**json.loads(line), "cpu_seconds": 0} for line in done.stdout.splitlines()]

            whole, until, early = worlds(), worlds("--first-failure"), worlds("--stop-when", "moved")
        verdicts = [[world["verdict"] for world in run] for run in (whole, until, early)]
        self.assertEqual(verdicts[0], ["stayed", "moved", "moved", "stayed", "stayed", "moved", "stayed", "moved", "moved"])
        self.assertEqual(verdicts[1], ["stayed", "moved", "not_needed", "stayed", "stayed", "moved", "stayed", "moved", "not_needed"])
        self.assertEqual(verdicts[2], verdicts[0])
        for all_of_it, one, other in zip(whole, until, early):
            if one["verdict"] != "not_needed":
                self.assertEqual(one, all_of_it)
            if other["stop_reason"] != "decided":
                self.assertEqual(other, all_of_it)
            else:
                self.assertLess(other["end_time_s"], all_of_it["end_time_s"])
                self.assertGreater(other["peak_displacement_m"], 0.1)


if __name__ == "__main__":
    unittest.main()
