"""Bullet's OpenCL pipeline from outside: what the program says of devices, and what it does without one."""
import os
import subprocess
import sys
import unittest

from cli import HOLDFAST

WITHOUT = {**os.environ, "OCL_ICD_VENDORS": "/nonexistent"}


def holdfast(*words, env=None):
    return subprocess.run([HOLDFAST, *words], capture_output=True, text=True, env=env, check=False)


def line_of_engine(text):
    return next(line for line in text.splitlines() if line.startswith("bullet-opencl"))


class WithoutDevice(unittest.TestCase):
    def test_engines_says_why(self):
        done = holdfast("engines", env=WITHOUT)
        self.assertEqual(done.returncode, 0)
        self.assertIn("missing: ", line_of_engine(done.stdout))
        self.assertRegex(done.stdout, "no OpenCL device; a driver is needed|cannot be loaded")

    def test_validate_names_it(self):
        done = holdfast("validate", "--engine", "bullet-opencl", "--case", "slide_path", env=WITHOUT)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "no OpenCL device|cannot be loaded")


class WithDevice(unittest.TestCase):
    def setUp(self):
        self.done = holdfast("engines")
        if "missing" in line_of_engine(self.done.stdout):
            print("skipped:", line_of_engine(self.done.stdout), file=sys.stderr)
            self.skipTest("no OpenCL device")

    def test_engines_lists_devices_and_nothing_leaks(self):
        self.assertRegex(self.done.stdout, r"\n +(CPU|GPU|accelerator) .+compute units, \d+ MiB")
        self.assertEqual(self.done.stderr, "")


if __name__ == "__main__":
    unittest.main()
