"""Loads: boxes with names, masses and containers, from memory, files, data frames and JSON, with the bits of arrays."""
import csv
import json
import pathlib
import pickle
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import h5py
import numpy as np
import openpyxl
import pandas

import holdfast
from holdfast import Box, Container, Load
from samples import BOX, REST, SLIDE, SOURCE, STACK, in_another_process, main, screened

FORMATS = SOURCE / "tests/io/loads/formats"

#: How each file is read; what it says of its options is in words.
OPTIONS = {
    "inches": ("inches.txt", {"unit": "in"}),
    "nested_crates": ("nested_crates.csv", {}),
    "order_plan": ("order_plan.json", {}),
    "packer_yup": ("packer_yup.json", {"axes": "x -z y", "unit": "m"}),
    "planner_export": ("planner_export.csv", {"format": "planner"}),
    "solver_bins": ("solver_bins.csv", {}),
    "spreadsheet_semicolon": ("spreadsheet_semicolon.csv", {}),
}


class MemoryTest(unittest.TestCase):
    def test_a_load_gives_the_bits_of_the_array_with_the_same_boxes(self):
        for unit, factor in (("m", 1.0), ("cm", 100.0)):
            with holdfast.Screen([SLIDE, REST], accuracy="screening", unit=unit, keep_boxes=True) as screen:
                layouts = [np.hstack([BOX[:, :6] * factor, BOX[:, 6:]]),
                           np.hstack([STACK[:, :6] * factor, STACK[:, 6:]])]
                loads = [Load(BOX), Load(STACK)]
                expected = screen.evaluate(layouts)
                np.testing.assert_array_equal(screen.evaluate(loads).state_hash, expected.state_hash)
                mixed = screen.evaluate([loads[0], layouts[1]])
                np.testing.assert_array_equal(mixed.state_hash, expected.state_hash)
                np.testing.assert_array_equal(screen.holds([layouts[0], loads[1]]), expected.holds.all(axis=1))
                np.testing.assert_array_equal(screen.margins(loads).margin, screen.margins(layouts).margin)
                np.testing.assert_array_equal(screen.indicators(loads).fill, screen.indicators(layouts).fill)
                streamed = dict(screen.stream([loads[0], layouts[1]]))
                np.testing.assert_array_equal([streamed[i].state_hash for i in range(2)], expected.state_hash)
                self.assertEqual(screen.replay(loads[1]).verdict.state_hash, expected.state_hash[1, 0])

    def test_arrays_are_read_where_they_are(self):
        with holdfast.Screen([REST], accuracy="screening") as screen:
            box = BOX.copy()
            before = sys.getrefcount(box)
            screen.evaluate([box, Load(BOX)])
            self.assertEqual(sys.getrefcount(box), before)

    def test_masses_from_memory_are_those_of_a_file(self):
        masses = [412.3, 0.1 + 0.2]
        with tempfile.TemporaryDirectory() as folder, holdfast.Screen([SLIDE], accuracy="screening") as screen:
            path = pathlib.Path(folder) / "masses.csv"
            with open(path, "w", encoding="utf-8", newline="") as file:
                writer = csv.writer(file)
                writer.writerow(["x1 (m)", "y1 (m)", "z1 (m)", "x2 (m)", "y2 (m)", "z2 (m)", "material", "mass (kg)"])
                writer.writerows([[*map(repr, row[:6].tolist()), 1, repr(mass)] for row, mass in zip(STACK, masses)])
            (read,) = Load.read(path)
            made = Load([{"corner_min": row[:3], "corner_max": row[3:6], "mass": mass} for row, mass in zip(STACK, masses)])
            self.assertEqual([box.mass for box in read.boxes], masses)
            verdicts = screen.evaluate([read, made, STACK])
            self.assertEqual(verdicts.state_hash[0, 0], verdicts.state_hash[1, 0])
            self.assertNotEqual(verdicts.state_hash[0, 0], verdicts.state_hash[2, 0])
            (world,) = screened([path], [self.slide_file(folder)], "--accuracy", "screening")
            self.assertEqual(world["state_hash"], f"{verdicts.state_hash[0, 0]:016x}")

    def slide_file(self, folder):
        path = pathlib.Path(folder) / "slide.txt"
        path.write_text("0 1 7 0 0\n")
        return path

    def test_a_recorded_load_has_the_hash_of_its_file(self):
        load = Load([Box((2, 1, 0), (2.5, 1.5, 0.5), name="Pumpe ä", mass=80.25, material="pallet", centre_of_mass=(0, 0, 0.1))],
                    Container("trailer-curtain", drop_sides={"rear": 0.6}), "Tour 7")
        with tempfile.TemporaryDirectory() as folder, holdfast.Screen([SLIDE], accuracy="screening") as screen:
            path = pathlib.Path(folder) / "tour.json"
            path.write_text(load.to_json(), encoding="utf-8")
            for name, loads in (("memory", [load]), ("file", Load.read(path))):
                self.assertTrue(screen.record(loads, pathlib.Path(folder) / f"{name}.h5"))
            hashes = []
            for name in ("memory", "file"):
                with h5py.File(pathlib.Path(folder) / f"{name}.h5") as file:
                    hashes.append(file["inputs/layouts/sha256"].asstr()[0])
            self.assertEqual(*hashes)

    def test_names_are_where_boxes_are(self):
        load = Load([{"corner_min": row[:3], "corner_max": row[3:6], "name": name} for row, name in zip(STACK, ("Base", "Top"))],
                    name="Tour 7")
        with holdfast.Screen([SLIDE, REST], accuracy="screening") as screen:
            verdicts = screen.evaluate([BOX, load])
            self.assertEqual(verdicts.layout_names, ("layout 0", "Tour 7"))
            self.assertIn(verdicts.critical_box_name[1, 0], ("Base", "Top"))
            self.assertEqual(verdicts.critical_box_name[:, 1].tolist(), ["", ""])
            self.assertEqual((verdicts.box_names(0), verdicts.box_names(1)), ((), ("Base", "Top")))
            self.assertEqual(verdicts[1].critical_box_name[0], verdicts.critical_box_name[1, 0])
            frame = verdicts.frame()
            self.assertEqual(frame["critical_box_name"].tolist(), verdicts.critical_box_name.ravel().tolist())
            self.assertIn("Tour 7", verdicts._repr_html_())
            margins = screen.margins([BOX, load])
            self.assertIn(margins.critical_box_name[1, 0], ("Base", "Top"))
            self.assertIn("critical_box_within_limits_name", margins.frame().columns)
            self.assertNotIn("critical_box_name", screen.evaluate([BOX]).frame().columns)
            streamed = {index: one for index, one in screen.stream([BOX, load, BOX])}
            self.assertEqual(streamed[1].critical_box_name[0], verdicts.critical_box_name[1, 0])
            self.assertEqual(screen.evaluate([load], names=["mine"]).layout_names, ("mine",))

    def test_what_is_wrong_is_told_with_its_box(self):
        with holdfast.Screen([REST]) as screen:
            bad = Load([Box((0, 0, 0), (1, 1, 1)), Box((1, 0, 0), (2, 1, 1), name="Pump", mass=-1.0)], name="Tour 7")
            with self.assertRaises(holdfast.Error) as caught:
                screen.evaluate([BOX, bad])
            self.assertIn("Tour 7: the mass of box 2 (Pump) is not possible: -1", str(caught.exception))
            self.assertEqual((caught.exception.layout, caught.exception.box, caught.exception.column), (1, 1, None))
            with self.assertRaisesRegex(holdfast.Error, "no type of container: barn"):
                screen.evaluate([Load(BOX, "barn")])
            with self.assertRaisesRegex(TypeError, "into a list"):
                screen.evaluate(Load(BOX))
        for wrong in (lambda: Load("text"), lambda: Load([{"corner_min": (0, 0, 0)}]), lambda: Box((0, 0), (1, 1, 1)),
                      lambda: Box((0, 0, float("nan")), (1, 1, 1)), lambda: Box((0, 0, 0), (1, 1, 1), mass="heavy"),
                      lambda: Load([[0, 0, 0, 1, 1, 1, 1.5]]), lambda: Load([{"corner_min": (0, 0, 0), "corner_max": (1, 1, 1), "mas": 1}]),
                      lambda: Load(BOX, {"sise": (1, 1, 1)}), lambda: Load(BOX, 40), lambda: Box((0, 0, 0), (1, 1, 1), order=1.5)):
            with self.assertRaises(holdfast.Error):
                wrong()
        with self.assertRaises(holdfast.Error) as caught:
            Load([[0, 0, 0, 1, 1, 1, 1], [0, 0, 0, 1, 1, "x", 1]])
        self.assertEqual(caught.exception.box, 1)

    def test_loads_are_values(self):
        load = Load([Box((0, 0, 0), (1, 1, 1), order=np.int64(3), fixed=np.bool_(True))], "40hc", "a")
        with holdfast.Screen([REST]) as screen:
            screen.evaluate([load])
        copy = pickle.loads(pickle.dumps(load))
        self.assertEqual(copy, load)
        self.assertEqual(hash(copy), hash(load))
        self.assertEqual(Load.from_dict(json.loads(json.dumps(load.to_dict()))), load)
        self.assertEqual(load.to_dict()["container"], "40hc")
        self.assertEqual(repr(load), "<holdfast.Load 'a', 1 box, container 40hc>")
        with self.assertRaises(AttributeError):
            load.name = "b"

    def test_containers(self):
        sizes = {one.name: one.size for one in holdfast.containers()}
        self.assertEqual(sizes["20"], (5.898, 2.352, 2.393))
        long = [[10.0, 0.0, 0.0, 11.0, 1.0, 1.0, 1]]
        with holdfast.Screen([REST], errors="mark") as screen:
            self.assertEqual(screen.evaluate([Load(long, "40 HC"), long]).status.ravel().tolist(), [0, 1])


class FileTest(unittest.TestCase):
    def test_every_known_file_is_read_by_a_fresh_process(self):
        described = {path.stem for path in (FORMATS / "expected").glob("*.json")}
        self.assertEqual(described, set(OPTIONS))
        script = ("import json, warnings, holdfast\nwarnings.simplefilter('ignore')\n"
                  f"for stem, (name, options) in {OPTIONS!r}.items():\n"
                  f"    loads = holdfast.Load.read({str(FORMATS)!r} + '/' + name, **options)\n"
                  "    print(json.dumps({'stem': stem, 'loads': [load.to_dict() for load in loads]}))\n")
        done = in_another_process(script)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([one["stem"] for one in lines], list(OPTIONS))
        for one in lines:
            expected = json.loads((FORMATS / "expected" / f"{one['stem']}.json").read_text())["loads"]
            with self.subTest(file=one["stem"]):
                self.assertEqual([load["name"] for load in one["loads"]], [load["name"] for load in expected])
                for load, wanted in zip(one["loads"], expected):
                    container = load.get("container", {"size": [5.87, 2.33, 2.2]})
                    if isinstance(wanted["container"], list):
                        np.testing.assert_allclose(container["size"], wanted["container"])
                    self.assertEqual(len(load["boxes"]), len(wanted["boxes"]))
                    for box, given in zip(load["boxes"], wanted["boxes"]):
                        # Overlaps may have been trimmed by half of the tolerance of files.
                        tolerance = 5e-4 if one["stem"] == "inches" else 2e-6
                        for corner in ("corner_min", "corner_max"):
                            np.testing.assert_allclose(box[corner], given[corner], atol=tolerance)
                        for key in ("name", "material", "order"):
                            if key in given:
                                self.assertEqual(box[key], given[key])
                        if "mass" in given:
                            self.assertAlmostEqual(box["mass"], given["mass"], 9)

    def test_notes_are_warnings_and_mistakes_are_errors(self):
        path = FORMATS / "planner_export.csv"
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            loads = Load.read(path, axes="-z x y")
        self.assertEqual(len(loads), 2)
        self.assertEqual(loads[0].container.type, "40hc")
        self.assertTrue(any(issubclass(one.category, holdfast.LoadWarning) and "not placed" in str(one.message) for one in caught))
        self.assertEqual({pathlib.Path(one.filename).name for one in caught}, {"test_loads.py"})
        with self.assertRaises(holdfast.Error) as error:
            Load.read(path)
        self.assertEqual({problem.layout for problem in error.exception.problems}, {0, 1})
        self.assertEqual({problem.file for problem in error.exception.problems}, {str(path)})
        for wrong in ({"axes": "x x y"}, {"unit": "yd"}, {"format": "none"}, {"container": "barn"}, {"config": "[Loads]\nUnits = m\n"}):
            with self.assertRaises(holdfast.Error):
                Load.read(path, **wrong)
        with self.assertRaises(holdfast.Error):
            Load.read(FORMATS / "none.csv")

    def test_a_load_is_checked_in_the_container_that_it_will_have(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "long.csv"
            path.write_text("x,y,z,length,width,height\n1000,0,0,100,100,100\n")
            with self.assertRaises(holdfast.Error):
                Load.read(path)
            config = "[Container]\nType = 40hc\n"
            (by_config,) = Load.read(path, config=config)
            (by_option,) = Load.read(path, container="40hc")
        self.assertIsNone(by_config.container)
        self.assertEqual(by_option.container.type, "40hc")
        with holdfast.Screen([REST], config=config) as screen:
            hashes = screen.evaluate([by_config, by_option]).state_hash
        self.assertEqual(hashes[0, 0], hashes[1, 0])

    def test_data_frames_have_the_words_of_tables(self):
        rows = [["Pump; left", "crate", 0, 0, 0, 120, 80, 98.5, 412.5], ["Motor", "crate", 120, 0, 0, 120, 80, 105, 530],
                ["Spares", "carton", 0, 0, 98.5, 60, 40, 40, 18.25], ["Spares", "carton", 60, 0, 98.5, 60, 40, 40, 18.25]]
        frame = pandas.DataFrame(rows, columns=["Name", "Material", "x", "y", "z", "Length", "Width", "Height", "Weight (kg)"])
        (made,) = Load.from_dataframe(frame, "spreadsheet_semicolon.csv")
        (read,) = Load.read(FORMATS / "spreadsheet_semicolon.csv")
        self.assertEqual(made, read)
        frame["load"] = ["a", "b", "a", "a"]
        frame["mat"] = [0.6, None, np.nan, 0.6]
        loads = Load.from_dataframe(frame, columns="Name = name")
        self.assertEqual([(load.name, len(load)) for load in loads], [("table#a", 3), ("table#b", 1)])
        self.assertEqual([box.mat for box in loads[0].boxes], [0.6, None, 0.6])
        frame["mat"] = [0.6, -1.0, np.nan, 0.6]
        with self.assertRaises(holdfast.Error) as error:
            Load.from_dataframe(frame)
        self.assertEqual((error.exception.problems[0].file, error.exception.problems[0].line), ("table", 3))
        with self.assertRaises(holdfast.Error):
            Load.from_dataframe(pandas.DataFrame({"x": [1]}))

    def test_spreadsheets_are_read_where_a_package_is_there(self):
        book = openpyxl.Workbook()
        book.active.title = "Notes"
        sheet = book.create_sheet("Tour 7")
        for row in (["Loading list", None, None], [], ["Name", "x", "y", "z", "length", "width", "height", "weight", "fixed"],
                    ["Pump\nleft", 0, 0.0, 0, 80, 60, 100.5, 12.25, True], [17, 80, 0, 0, 80, 60, 100.5, None, None]):
            sheet.append(row)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "tour.xlsx"
            book.save(path)
            (load,) = Load.read(path, sheet="Tour 7")
            (same,) = Load.read(path, sheet=1)
            for sheet in (0, 2, "Tour 8"):
                with self.assertRaises(holdfast.Error):
                    Load.read(path, sheet=sheet)
            book.move_sheet("Tour 7", -1)
            book.save(path)
            with self.assertWarnsRegex(holdfast.LoadWarning, "2 sheets, and only the first one, 'Tour 7', is read; .*'Notes'"):
                (first,) = Load.read(path)
            book.remove(book["Notes"])
            book.save(path)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                self.assertEqual(Load.read(path), [first])
            path.write_bytes(b"PK\x03\x04 and so on")
            with self.assertRaisesRegex(holdfast.Error, "cannot be read"):
                Load.read(path)
        self.assertEqual(load.boxes, (Box((0, 0, 0), (0.8, 0.6, 1.005), name="Pump left", mass=12.25, fixed=True),
                                      Box((0.8, 0, 0), (1.6, 0.6, 1.005), name="17")))
        self.assertEqual(same, load)
        self.assertEqual(first, load)
        with mock.patch.dict(sys.modules, {"openpyxl": None, "odf": None}):
            for name, needed in (("tour.xlsx", "openpyxl"), ("tour.ods", "odfpy")):
                with self.assertRaises(holdfast.Error) as error:
                    Load.read(name)
                self.assertIn("or save the sheet as CSV", error.exception.accepted)
                self.assertIn(needed, str(error.exception))

    def test_objects_of_json(self):
        text = {"name": "Tour 7", "unit": "cm", "container": {"size": [600, 240, 240], "open_sides": ["rear"], "drop_sides": {"left": 60},
                                                             "bed_height": 90},
                "boxes": [[0, 0, 0, 80, 60, 100, 3], {"corner_min": [80, 0, 0], "corner_max": [160, 60, 100], "name": "Pump",
                                                      "centre_of_mass": [0, 0, -10], "bearing_limit": 300}]}
        load = Load.from_dict(text)
        self.assertEqual(load.container, Container("", (6, 2.4, 2.4), ("rear",), {"left": 0.6}, 0.9))
        self.assertEqual(load.boxes[0], Box((0, 0, 0), (0.8, 0.6, 1.0), material=3))
        self.assertEqual(load.boxes[1].centre_of_mass, (0, 0, -0.1))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "tour.json"
            path.write_text(load.to_json(), encoding="utf-8")
            (read,) = Load.read(path)
        self.assertEqual((read.boxes, read.container), (load.boxes, load.container))
        self.assertTrue(read.name.endswith("Tour 7"))
        for wrong in ({}, {"boxes": []}, {"boxes": [BOX[0].tolist()], "nam": "a"}, {"boxes": [BOX[0].tolist()], "unit": "yd"}):
            with self.assertRaises(holdfast.Error):
                Load.from_dict(wrong)


if __name__ == "__main__":
    main()
