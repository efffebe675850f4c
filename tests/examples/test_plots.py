"""examples/plot_margins.py and examples/plot_walls.py, on results files of their own."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HOLDFAST = os.environ["HOLDFAST"]
# A slender column that tips, a flat box that slides, and a box beside the front wall.
LAYOUTS = {"column": "250 100 0 280 130 120 1", "flat": "250 100 0 330 180 30 1", "wall": "0 50 0 100 150 60 1"}


class PlotTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="holdfast_plots_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "layouts").mkdir()
        for name, box in LAYOUTS.items():
            (cls.folder / f"layouts/{name}.txt").write_text(f"1 1\n{box}\n")
        (cls.folder / "broken.txt").write_text("no layout\n")
        cls.screen("asked.h5", "--margins", "--walls", "en283")
        cls.screen("plain.h5")
        cls.screen("newtons.h5", "--wall-forces")

    @classmethod
    def screen(cls, name, *options):
        subprocess.run([HOLDFAST, "screen", "--layouts", "layouts", "broken.txt", "--norm", "road", "--accuracy", "screening",
                        "--quiet", "--no-series", "-o", name, *options], cwd=cls.folder, check=False,
                       stderr=subprocess.DEVNULL)

    def run_example(self, example, *arguments):
        return subprocess.run([sys.executable, SOURCE / "examples" / example, *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True, check=False)

    def check_picture(self, example, *arguments):
        """What the example prints, beside a picture that it has written."""
        (self.folder / "picture.svg").unlink(missing_ok=True)
        done = self.run_example(example, *arguments, "-o", "picture.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        picture = (self.folder / "picture.svg").read_text()
        self.assertTrue(picture.startswith("<?xml"))
        return done.stdout

    def texts(self, text):
        """How often a text stands in the picture, which has each as a comment beside its glyphs."""
        return (self.folder / "picture.svg").read_text().count(f"<!-- {text} -->")

    def test_axes_have_round_numbers_and_a_range(self):
        sys.path.insert(0, str(SOURCE / "examples"))
        from layout_bars import round_ticks
        self.assertEqual(round_ticks(37.8), [0, 20, 40])
        self.assertEqual(round_ticks(1.5), [0, 0.5, 1, 1.5])
        self.assertEqual(round_ticks(0), [0, 0.5, 1])

    def test_margins(self):
        said = self.check_picture("plot_margins.py", "asked.h5")
        with h5py.File(self.folder / "asked.h5") as file:
            margins = file["margins/margin"][:]
        stand = int((margins + 1e-6 >= [0.8, 0.5, 0.5, 0.5]).all(axis=1).sum())
        self.assertEqual(said, f"picture.svg: 3 of 3 layouts; {stand} stand{'s' if stand == 1 else ''} what is asked in every direction\n")
        self.assertEqual(self.texts("1.50+"), 4)
        said = self.check_picture("plot_margins.py", "asked.h5", "--needed", 0.1, 0.1, 0.1, 0.1, "--most", 2)
        self.assertEqual(said, "picture.svg: 2 of 3 layouts; 3 stand what is asked in every direction\n")

    def test_walls(self):
        said = self.check_picture("plot_walls.py", "asked.h5")
        with h5py.File(self.folder / "asked.h5") as file:
            beyond = (file["walls/lasting_force"][:, 1:5] > file["walls/limit"][:, 1:5]).any(axis=1)
            count = len(np.unique(file["worlds/layout"][:][beyond]))
        self.assertEqual(said, f"picture.svg: 3 of 3 layouts; {count} press{'es' if count == 1 else ''} a wall beyond en283\n")
        self.assertEqual((self.texts("0"), self.texts("100"), self.texts("200") + self.texts("200+")), (4, 4, 4))
        self.assertEqual(self.check_picture("plot_walls.py", "newtons.h5"), "picture.svg: 3 of 3 layouts\n")

    def test_a_file_without_is_refused_in_a_line(self):
        for example, what in (("plot_margins.py", "margins"), ("plot_walls.py", "wall forces")):
            done = self.run_example(example, "plain.h5")
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, rf"^plain\.h5 holds no {what}: .*\n$")


if __name__ == "__main__":
    unittest.main()
