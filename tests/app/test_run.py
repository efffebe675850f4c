"""`holdfast run`: a configuration alone, a single pair or a batch folder, with the text files of StableCargo."""
import unittest

import h5py
import numpy as np

from cli import AT_ONCE, CONFIG, FLOATING, REST, SEED, SHOVE, TOWER, CliTest, datasets, layout_text

PLACES = """\
[Export Settings]
SavePath = out/deep
[Simulation Settings]
BatchSimulation = {batch}
BatchPath = cases/
"""


def numbers(path):
    """The lines of numbers of a text file, without comments."""
    return [[float(field) for field in line.split()] for line in path.read_text().splitlines()
            if not line.startswith("#")]


class Run(CliTest):
    def run_config(self, text, expect=0, *arguments):
        self.write("config.ini", text)
        done = self.run_here("run", "config.ini", *arguments)
        self.assert_exit(done, expect)
        return done

    def check_texts(self, folder, batch_name):
        """All text files of the run are there, and say what the results file says; number of worlds."""
        data = datasets(folder / "results.h5")
        layouts, accelerations = ([name.decode() for name in data[f"/inputs/{kind}/name"]]
                                  for kind in ("layouts", "accelerations"))
        fallen, energy = data["/summary/worlds/fallen_at_end"], data["/summary/worlds/end_kinetic_energy"]
        batch, names = [], {"results.h5", f"[BATCH-RESUMED]${batch_name}"}
        for w in range(len(fallen)):
            layout, acceleration = layouts[data["/worlds/layout"][w]], accelerations[data["/worlds/acceleration"][w]]
            pair = f"${layout.removesuffix('.txt')}${acceleration.removesuffix('.txt')}"
            names |= {f"[SOLUTION]{pair}", f"[SOLUTION_RESUMED]{pair}"}
            self.check_solution(folder / f"[SOLUTION]{pair}", data, w)
            self.check_resumed(folder / f"[SOLUTION_RESUMED]{pair}", data, w)
            batch.append((layout, acceleration, str(fallen[w]), float(energy[w])))
        self.assertEqual({path.name for path in folder.iterdir()}, names)
        lines = (folder / f"[BATCH-RESUMED]${batch_name}").read_text().splitlines()
        rows = [line.split("\t") for line in lines if not line.startswith("#")]
        self.assertEqual([(*row[:3], float(row[3])) for row in rows], batch)
        return len(fallen)

    def check_solution(self, path, data, w):
        boxes, samples, row, first, box = (int(data[f"/worlds/{name}"][w]) for name in (
            "box_count", "sample_count", "row_begin", "sample_begin", "box_begin"))
        rows = slice(row, row + boxes * samples)
        expected = np.column_stack([
            np.tile(data["/boxes/id"][box:box + boxes], samples),
            *(data[f"/series/{name}"][rows].astype(float) for name in ("displacement", "force", "angular_velocity",
                                                                      "linear_acceleration")),
            np.repeat(data["/series/time"][first:first + samples], boxes)])
        found = np.array(numbers(path))
        self.assertEqual(found.shape, (boxes * samples, 14))
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-30)

    def check_resumed(self, path, data, w):
        lines = numbers(path)
        box, boxes = int(data["/worlds/box_begin"][w]), int(data["/worlds/box_count"][w])
        self.assertEqual(lines[0], [data["/summary/worlds/fallen_at_end"][w]])
        self.assertEqual(lines[-1], [data["/summary/worlds/end_kinetic_energy"][w]])
        part = slice(box, box + boxes)
        expected = np.column_stack([data["/boxes/id"][part], data["/boxes/end_displacement"][part],
                                    data["/boxes/end_kinetic_energy"][part]])
        np.testing.assert_allclose(np.array(lines[1:-1]), expected, rtol=1e-6, atol=1e-30)

    def test_a_single_pair(self):
        self.write("tower.txt", layout_text(TOWER))
        self.write("shove.txt", SHOVE)
        pair = CONFIG + "Layout = tower.txt\nAcceleration = shove.txt\n"
        done = self.run_config(pair + "[Export Settings]\nSavePath = out/deep\n")
        self.assertIn("results: out/deep/results.h5", done.stdout)
        self.assertEqual(self.check_texts(self.folder / "out/deep", "batch"), 1)

    def test_a_batch_folder(self):
        for name, text in (("seed.txt", layout_text(SEED)), ("tower.txt", layout_text(TOWER)),
                           ("floating.txt", layout_text(FLOATING)), ("shove.txt", SHOVE), ("rest.txt", REST)):
            self.write(f"cases/{name}", text)
        self.run_config(CONFIG + AT_ONCE + PLACES.format(batch="true"))
        out = self.folder / "out/deep"
        self.assertEqual(self.check_texts(out, "cases"), 6)
        with h5py.File(out / "results.h5") as file:
            self.assertEqual(list(file["inputs/layouts/name"].asstr()), ["floating.txt", "seed.txt", "tower.txt"])
            self.assertEqual(list(file["inputs/accelerations/name"].asstr()), ["rest.txt", "shove.txt"])
        # The same worlds as by `screen`, whose text files are the same too.
        done = self.run_here("screen", "-c", "config.ini", "--layouts", "cases", "--accelerations", "cases", "-o",
                             "results.h5", "--text", "text")
        self.assert_exit(done, 0)
        self.assert_same_results(self.folder / "results.h5", out / "results.h5")
        for path in (self.folder / "text").glob("?SOLUTION*"):
            self.assertEqual(path.read_bytes(), (out / path.name).read_bytes())

    def test_a_bad_layout_of_a_batch(self):
        self.write("cases/bad.txt", "1 2\n0 0 0 80 60 100 1\n0 0 0 80 60 100 1\n")
        self.write("cases/seed.txt", layout_text(SEED))
        self.write("cases/rest.txt", REST)
        done = self.run_config(CONFIG + PLACES.format(batch="true"), 1)
        self.assertIn("cases/bad.txt:3: box 2 overlaps box 1", done.stderr)
        out = self.folder / "out/deep"
        self.assertIn("status bad_layout", (out / "[SOLUTION_RESUMED]$bad$rest").read_text())
        self.assertEqual(len(numbers(out / "[SOLUTION]$seed$rest")), 3 * 11)

    def test_a_second_run_needs_a_word(self):
        self.write("tower.txt", layout_text(TOWER))
        self.write("shove.txt", SHOVE)
        pair = CONFIG + "Layout = tower.txt\nAcceleration = shove.txt\n"
        self.run_config(pair)
        self.assertIn("--overwrite", self.run_config(pair, 2).stderr)
        self.run_config(pair, 0, "--overwrite", "--engine", "bullet", "--quiet")
        with h5py.File(self.folder / "results.h5") as file:
            self.assertEqual(file.attrs["engine"], "bullet")
        self.write("tower.txt", layout_text(TOWER[:1]))
        self.run_config(pair, 0, "--overwrite", "--engine", "native", "--accuracy", "screening", "--quiet")
        with h5py.File(self.folder / "results.h5") as file:
            self.assertEqual(file.attrs["engine"], "native")
            self.assertEqual(file["inputs/settings"].attrs["Native/Accuracy"], "screening")

    def test_what_is_missing_is_reported(self):
        self.write("empty/notes.txt", "Nothing to load.\n")
        self.write("layouts/seed.txt", layout_text(SEED))
        for text, words in (
                (CONFIG, ("config.ini: names nothing to run", "Layout", "BatchPath")),
                (CONFIG + "Layout = seed.txt\n", ("names nothing to run",)),
                (CONFIG + "Layout = nope.txt\nAcceleration = nope.txt\n", ("nope.txt",)),
                (CONFIG + "[Simulation Settings]\nBatchSimulation = true\n", ("BatchPath",)),
                (CONFIG + PLACES.format(batch="true"), ("cases/: no such folder",)),
                (CONFIG + PLACES.format(batch="true").replace("cases/", "empty"), ("empty: the folder has no",)),
                (CONFIG + PLACES.format(batch="true").replace("cases/", "layouts"), ("layouts: the folder has no acc",))):
            with self.subTest(text=text):
                done = self.run_config(text, 2)
                for word in words:
                    self.assertIn(word, done.stderr)
                self.assertEqual(done.stdout, "")
                self.assertFalse((self.folder / "out").exists())
                self.assertFalse((self.folder / "results.h5").exists())

    def test_a_folder_that_cannot_be_made(self):
        self.write("tower.txt", layout_text(TOWER))
        self.write("shove.txt", SHOVE)
        done = self.run_config(CONFIG + "Layout = tower.txt\nAcceleration = shove.txt\n"
                               "[Export Settings]\nSavePath = tower.txt/out\n", 2)
        self.assert_refused(done, "config.ini: SavePath cannot be created: tower.txt/out")


if __name__ == "__main__":
    unittest.main()
