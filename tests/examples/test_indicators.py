"""examples/indicators.py on layouts in which an indicator decides: towers of rising height."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HOLDFAST = os.environ["HOLDFAST"]


class IndicatorsExample(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="holdfast_indicators_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "layouts").mkdir()
        for height in range(1, 7):
            boxes = [f"250 100 {30 * i} 290 140 {30 * (i + 1)} 1" for i in range(height)]
            (self.folder / f"layouts/tower{height}.txt").write_text("\n".join([f"1 {height}", *boxes, ""]))
        (self.folder / "push.txt").write_text("0 1 0 4 0\n")

    def screen(self, *options):
        subprocess.run([HOLDFAST, "screen", "--layouts", "layouts", "--accelerations", "push.txt", "--accuracy",
                        "screening", "--quiet", "--no-series", "-o", "results.h5", "--overwrite", *options], cwd=self.folder,
                       check=True)

    def run_example(self):
        return subprocess.run([sys.executable, SOURCE / "examples/indicators.py", "results.h5", "-o", "picture.svg"],
                              cwd=self.folder, capture_output=True, text=True, check=False)

    def test_a_high_centre_goes_with_falling(self):
        self.screen("--indicators", "--margins")
        done = self.run_example()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("over 6 layouts", done.stdout)
        height = next(line for line in done.stdout.splitlines() if line.startswith("height of centre")).split()
        # Taller towers fail and their margin is smaller; fill says the same, and the offset across nothing.
        self.assertGreater(float(height[-3]), 0.6)
        self.assertLess(float(height[-1]), -0.8)
        across = next(line for line in done.stdout.splitlines() if line.startswith("off centre across")).split()
        self.assertEqual(across[-1], "NaN")
        self.assertRegex(done.stdout, r"\nfull +0\.\d+ +21\n")
        self.assertTrue((self.folder / "picture.svg").read_text().startswith("<?xml"))

    def test_a_file_without_indicators_is_refused_in_a_line(self):
        self.screen()
        done = self.run_example()
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^results\.h5 holds no indicators: .*\n$")


if __name__ == "__main__":
    unittest.main()
