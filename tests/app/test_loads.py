"""Loads as people have them: tables, JSON, units, axes, containers, from the file to the results."""
import json
import pathlib
import unittest

import h5py
import numpy as np

from cli import CliTest, SOURCE, run

FORMATS = SOURCE / "tests/io/loads/formats"
TRAILER = SOURCE / "configs/loads/trailer.csv"
# What the command line has to say beside the file.
OPTIONS = {"inches.txt": ["--unit", "in"], "packer_yup.json": ["--format", "y-up"], "planner_export.csv": ["--axes", "-z x y"]}


class Loads(CliTest):
    def test_every_kind_of_file_is_checked_and_screened_with_at_most_one_option(self):
        for description in sorted((FORMATS / "expected").glob("*.json")):
            expected = json.loads(description.read_text(encoding="utf-8"))["loads"]
            file = next(path for path in FORMATS.iterdir() if path.stem == description.stem)
            options = OPTIONS.get(file.name, [])
            with self.subTest(file.name):
                self.assertLessEqual(len(options), 2)
                checked = run("check", file, *options)
                self.assertEqual(checked.returncode, 0, checked.stderr)
                results = self.folder / f"{file.stem}.h5"
                screened = run("screen", "--layouts", file, "--norm", "road", "-o", results, "--quiet", *options)
                self.assertEqual(screened.returncode, 0, screened.stderr)
                with h5py.File(results) as found:
                    inputs = found["inputs/layouts"]
                    self.assertEqual(list(inputs["name"].asstr()), [load["name"] for load in expected])
                    boxes = [box for load in expected for box in load["boxes"]]
                    names = list(inputs["box_name"].asstr())
                    for box, name, mass in zip(boxes, names, inputs["mass"][:], strict=True):
                        self.assertIn(box.get("name", name), name)
                        if "mass" in box:
                            self.assertAlmostEqual(mass, box["mass"], places=9)
                    sizes = inputs["container_size"][:]
                    for load, size in zip(expected, sizes):
                        if load["container"] not in ("the run's", [5.87, 2.33, 2.2]):
                            np.testing.assert_allclose(size, load["container"])

    def test_the_masses_of_a_file_are_those_of_the_worlds(self):
        results = self.folder / "trailer.h5"
        done = run("screen", "--layouts", TRAILER, "--norm", "road", "-o", results)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(results) as found:
            np.testing.assert_allclose(found["boxes/mass"][:20], found["inputs/layouts/mass"][:], rtol=1e-7)
            self.assertEqual(found["inputs/layouts/container_type"].asstr()[0], "trailer-curtain")
            self.assertEqual(found["inputs/layouts/open_sides"].asstr()[0], "left right")
            np.testing.assert_array_equal(np.isfinite(found["inputs/layouts/mat"][:]).nonzero()[0], [6, 7, 10, 11, 14, 15])
        margins = run("margins", "--layouts", TRAILER, "--norm", "road", "-o", self.folder / "margins.h5")
        self.assertEqual(margins.returncode, 0, margins.stderr)

    def test_a_container_of_the_command_line_holds_before_that_of_the_load(self):
        results = self.folder / "box.h5"
        done = run("screen", "--layouts", TRAILER, "--container", "40hc", "--norm", "road", "-o", results, "--quiet")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("40hc", run("containers").stdout)
        with h5py.File(results) as found:  # 2.44 m of pallets do not fit
            self.assertIn("outside the container", found["worlds/status_text"].asstr()[0])
        wrong = run("check", TRAILER, "--container", "40hx")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("holdfast containers", wrong.stderr)

    def test_a_load_is_the_same_after_it_is_converted_there_and_back(self):
        for file in (TRAILER, FORMATS / "planner_export.csv"):
            options = OPTIONS.get(file.name, [])
            for kind in ("json", "csv"):
                there, back = self.folder / f"{file.stem}.{kind}", self.folder / f"{file.stem}_back.json"
                for source, target, with_options in ((file, there, options), (there, back, [])):
                    done = run("convert", source, "-o", target, "--overwrite", *with_options)
                    self.assertEqual(done.returncode, 0, done.stderr)
                direct = self.folder / "direct.json"
                run("convert", file, "-o", direct, "--overwrite", *options)
                self.assertEqual(direct.read_text(encoding="utf-8"), back.read_text(encoding="utf-8"))
        self.assertEqual(run("convert", TRAILER, "-o", there).returncode, 2)  # it is there already
        refused = run("convert", TRAILER, "-o", self.folder / "trailer.txt")
        self.assertIn(".json or .csv", refused.stderr)

    def test_loads_of_one_file_are_divided_among_shards_and_resumed(self):
        table = self.folder / "many.csv"
        rows = [f"L{i},{80 * (i % 3)},0,0,80,60,{50 + i}" for i in range(12)]
        table.write_text("load,x,y,z,length,width,height\n" + "\n".join(rows) + "\n", encoding="utf-8")
        whole = self.folder / "whole.h5"
        self.assertEqual(run("screen", "--layouts", table, "--norm", "road", "-o", whole, "--quiet").returncode, 0)
        merged = self.folder / "merged.h5"
        for part in ("1/2", "2/2"):
            done = run("screen", "--layouts", table, "--norm", "road", "-o", merged, "--quiet", "--part", part)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run("merge", merged, "--quiet").returncode, 0)
        with h5py.File(whole) as one, h5py.File(merged) as two:
            for name in ("inputs/layouts/name", "inputs/layouts/sha256", "worlds/state_hash"):
                np.testing.assert_array_equal(one[name][:], two[name][:])
        again = run("screen", "--layouts", table, "--norm", "road", "-o", whole, "--resume", "--quiet")
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_a_spreadsheet_file_is_told_to_be_saved_as_text(self):
        path = self.folder / "load.xlsx"
        path.write_bytes(b"PK\x03\x04 and so on")
        done = run("check", path)
        self.assertEqual(done.returncode, 2)
        path = self.folder / "load16.csv"
        path.write_bytes("x,y,z\n1,2,3\n".encode("utf-16"))
        done = run("screen", "--layouts", path, "--norm", "road", "-o", self.folder / "none.h5")
        self.assertIn("UTF-16", done.stderr)

    def test_names_of_hostile_length_and_signs_stay_names(self):
        table = self.folder / "names.csv"
        evil = "<b>&\"" + "ä" * 100
        table.write_text(f'load,name,x,y,z,length,width,height\n../../up,"{evil.replace(chr(34), chr(34) * 2)}",0,0,0,80,60,50\n', encoding="utf-8")
        results = self.folder / "names.h5"
        done = run("screen", "--layouts", table, "--norm", "road", "-o", results, "--text", self.folder / "texts", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(results) as found:
            name = found["inputs/layouts/box_name"].asstr()[0]
            self.assertLessEqual(len(name.encode()), 120)
            self.assertTrue(evil.startswith(name))
        self.assertFalse((self.folder.parent / "up").exists())
        written = [path for path in (self.folder / "texts").rglob("*") if path.is_file()]
        self.assertTrue(written)


if __name__ == "__main__":
    unittest.main()
