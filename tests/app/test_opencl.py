"""Bullet's OpenCL pipeline from outside: what the program says of devices, and what it does without one."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py

from cli import HOLDFAST, SOURCE

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
        self.assertRegex(done.stdout, "no OpenCL device; install a driver|cannot be loaded")

    def test_engines_asks_for_no_device_unless_told(self):
        asked, with_drivers, without = holdfast("engines", "--devices", env=WITHOUT), holdfast("engines"), holdfast("engines", env=WITHOUT)
        self.assertEqual((without.returncode, without.stderr), (0, ""))
        self.assertEqual(without.stdout, with_drivers.stdout)
        if "cannot be loaded" not in without.stdout:
            self.assertIn("\n                 `holdfast engines --devices` looks for devices\n", without.stdout)
            self.assertNotIn("missing", without.stdout)
            self.assertIn("missing", asked.stdout)

    def test_validate_names_it(self):
        done = holdfast("validate", "--engine", "bullet-opencl", "--case", "slide_path", env=WITHOUT)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "no OpenCL device|cannot be loaded")


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
                    found[engine] = {name: file["summary/worlds"][name][:] for name in ("fallen_boxes", "max_displacement")}
        self.assertEqual(list(found["bullet-opencl"]["fallen_boxes"]), list(found["bullet"]["fallen_boxes"]))
        for ours, bullets in zip(found["bullet-opencl"]["max_displacement"], found["bullet"]["max_displacement"]):
            self.assertAlmostEqual(ours, bullets, delta=0.05)


if __name__ == "__main__":
    unittest.main()
