"""Loads as people have them: tables, JSON, units, axes, containers, from the file to the results."""
import copy
import json
import pathlib
import re
import unittest

import h5py
import jsonschema
import numpy as np

from cli import CliTest, SOURCE, run

FORMATS = SOURCE / "tests/io/loads/formats"
TRAILER = SOURCE / "configs/loads/trailer.csv"
SCHEMA = jsonschema.Draft202012Validator(json.loads((SOURCE / "configs/loads/load.schema.json").read_text(encoding="utf-8")))
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

    def test_check_says_what_a_file_is_taken_for(self):
        for file, form in ((TRAILER, "comma-separated table"), (FORMATS / "spreadsheet_semicolon.csv", "semicolon-separated table"),
                           (FORMATS / "order_plan.json", "JSON of another program"), (FORMATS / "inches.txt", "text")):
            self.assertIn(f": ok: layout ({form}), ", run("check", file, *OPTIONS.get(file.name, [])).stdout)
        lines = self.folder / "lines.jsonl"
        run("convert", TRAILER, "-o", lines)
        self.assertEqual(run("check", lines).stdout.splitlines()[0], f"{lines}: ok: layout (JSON, one load per line), 20 boxes, 12690 kg, container trailer-curtain")
        self.write("sheet.txt", "Artikel Ort Maße\nKiste 0 0 0 80 60 50 4\n")
        self.assertIn("bad: layout (text, since no line names the places and sizes of boxes), ", self.run_here("check", "sheet.txt").stdout)

    def test_a_file_whose_height_is_another_axis_is_noticed_where_all_boxes_fit(self):
        """Two rows of three boxes across and two layers, with y upwards, in a container that is as high as it is wide."""
        rows = [f"{100 * i},{70 * layer},{60 * row + 20},100,70,60" for i in range(3) for row in range(2) for layer in range(2)]
        self.write("up.csv", "x,y,z,dx,dy,dz\n" + "\n".join(rows) + "\n")
        self.write("up.txt", "12\n" + "".join(f"{x} {y} {z} {x + a} {y + b} {z + c} 1\n" for x, y, z, a, b, c in (
            map(int, row.split(",")) for row in rows)))
        mended = 'all boxes stand with --axes "x -z y"'
        for name in ("up.csv", "up.txt"):
            checked = self.run_here("check", name)
            self.assert_exit(checked, 0)
            self.assertEqual(checked.stderr.count(mended), 1, checked.stderr)
            screened = self.run_here("screen", "--layouts", name, "--norm", "road", "-o", f"{name}.h5", "--quiet")
            self.assertEqual(screened.stderr.count(mended), 1, screened.stderr)
            self.assertEqual(self.run_here("check", name, "--axes", "x -z y").stderr, "")
        for folder in ("bench/layouts", "bench/layouts_unstable", "configs/layouts"):
            self.assertNotIn("another axis", run("check", SOURCE / folder).stderr)

    def test_accelerations_that_may_be_in_g_are_told(self):
        self.write("box.txt", "1\n0 0 0 80 60 50 1\n")
        self.write("brake.txt", "0 0.5 0.8 0 0\n")
        self.write("brake_g.txt", "unit g\n0 0.5 0.8 0 0\n")
        self.assertIn("if they are in g: a first line 'unit g'", self.run_here("check", "brake.txt").stderr)
        done = self.run_here("screen", "--layouts", "box.txt", "--accelerations", "brake.txt", "brake_g.txt", "-o", "g.h5", "--quiet")
        self.assertEqual(done.stderr.count("unit g"), 1, done.stderr)
        with h5py.File(self.folder / "g.h5") as found:
            np.testing.assert_array_equal(found["inputs/accelerations/value"][:, 0], [0.8, 0.8 * 9.81])
        self.assertEqual(run("check", SOURCE / "configs/accelerations").stderr, "")

    def test_json_that_is_written_is_that_of_the_schema(self):
        self.assertEqual(set(SCHEMA.schema["$defs"]["containerType"]["enum"]),
                         set(re.findall(r"^([a-z0-9-]+)  ", run("containers").stdout, re.MULTILINE)))
        for file in (TRAILER, *(path for path in FORMATS.iterdir() if path.is_file())):
            lines = self.folder / "loads.jsonl"
            done = run("convert", file, "-o", lines, "--overwrite", *OPTIONS.get(file.name, []))
            self.assertEqual(done.returncode, 0, done.stderr)
            head, *loads = map(json.loads, lines.read_text(encoding="utf-8").splitlines())
            self.assertGreater(len(loads), 0)
            for instance in (head, *loads, {**head, "unit": "m", "container": "40hc", "loads": loads}):
                SCHEMA.validate(instance)

    def test_what_the_reader_refuses_the_schema_refuses_too(self):
        box = {"corner_min": [0, 0, 0], "corner_max": [1, 1, 1], "name": "Pump", "material": "wood", "mass": 80.5, "mat": 0.6,
               "centre_of_mass": [0, 0, 0.1], "fixed": False, "order": 2, "bearing_limit": 300}
        good = {"holdfast": 1, "unit": "m", "container": {"type": "40hc", "size": [6, 2.4, 2.4], "open_sides": ["rear"], "drop_sides": {"left": 0.6},
                                                          "bed_height": 0.9},
                "loads": [{"name": "a", "unit": "m", "container": "trailer-box", "boxes": [box, [2, 0, 0, 3, 1, 1, 3]]}]}

        def refused(changed):
            path = self.write("loads.json", json.dumps(changed))
            return run("check", path).returncode != 0, not SCHEMA.is_valid(changed)

        self.assertEqual(refused(good), (False, False))
        wrong_in_box = [("colour", "red"), ("name", 3), ("material", -1), ("material", 1.5), ("material", ""), ("material", None),
                        ("mass", "heavy"), ("mass", 0), ("mass", 1e7), ("mat", -0.1), ("mat", [0.6]), ("bearing_limit", -1), ("fixed", 1),
                        ("order", 1.5), ("order", "first"), ("corner_min", [0, 0]), ("corner_min", [0, 0, "0"]), ("corner_max", 1),
                        ("corner_max", {"x": 1, "y": 1, "z": 1}), ("corner_max", [1, 1, 1e7]), ("corner_max", [1, 1, 1, 1]),
                        ("centre_of_mass", 0.1), ("centre_of_mass", [0, 0, None])]
        changes = [(("loads", 0, "boxes", 0, key), value) for key, value in wrong_in_box]
        changes += [(("loads", 0, "boxes", 1), value) for value in ([2, 0, 0, 3, 1, 1], [2, 0, 0, 3, 1, 1, 1, 1], [2, 0, 0, 3, 1, "1", 1],
                                                                    [2, 0, 0, 3, 1, 1, "wood"], [2, 0, 0, 3, 1, 1, -1], [2, 0, 0, 1e7, 1, 1, 1], 3,
                                                                    "box", {"corner_min": [2, 0, 0]})]
        changes += [(("loads", 0, key), value) for key, value in (("boxes", []), ("boxes", {}), ("boxs", []), ("name", 7), ("unit", "yd"),
                                                                  ("container", "barn"), ("container", 40), ("container", {"tpye": "40hc"}))]
        changes += [(("container", key), value) for key, value in (
            ("size", [6, 2.4]), ("size", [6, 2.4, 0]), ("size", "large"), ("open_sides", "rear"), ("open_sides", ["floor"]),
            ("drop_sides", {"roof": 1}), ("drop_sides", {"left": 0}), ("drop_sides", ["left"]), ("bed_height", -1), ("type", "barn"))]
        changes += [(("holdfast",), 2), (("holdfast",), "1"), (("loads",), {}), (("loads",), [3]), (("laods",), []), (("unit",), 1)]
        for path, value in changes:
            with self.subTest(path=path, value=value):
                changed = copy.deepcopy(good)
                inner = changed
                for part in path[:-1]:
                    inner = inner[part]
                inner[path[-1]] = value
                self.assertEqual(refused(changed), (True, True))
        for path in (("loads", 0, "boxes"), ("loads", 0, "boxes", 0, "corner_max")):
            changed = copy.deepcopy(good)
            inner = changed
            for part in path[:-1]:
                inner = inner[part]
            del inner[path[-1]]
            self.assertEqual(refused(changed), (True, True))

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

    def test_a_table_is_not_written_of_sides_that_it_cannot_tell(self):
        box = '"boxes": [[0, 0, 0, 1, 1, 1, 1]]'
        for container, works in (('"type": "trailer-box"', True), ('"type": "trailer-box", "bed_height": 0.8', True),
                                 ('"type": "trailer-box", "open_sides": ["right"]', False),
                                 ('"type": "trailer-box", "drop_sides": {"left": 0.6}', False),
                                 ('"type": "trailer-curtain"', True), ('"type": "trailer-curtain", "bed_height": 0.8', False),
                                 ('"size": [6, 2, 2], "open_sides": ["rear"]', False)):
            load = self.folder / "sides.json"
            load.write_text(f'{{"holdfast": 1, "loads": [{{{box}, "container": {{{container}}}}}]}}', encoding="utf-8")
            done = run("convert", load, "-o", self.folder / "sides.csv", "--overwrite")
            self.assertEqual(done.returncode, 0 if works else 2, container + done.stderr)
            if not works:
                self.assertIn("a table has no place for open sides", done.stderr)

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

    def test_a_resumed_or_merged_run_names_boxes_as_a_new_one_does(self):
        table = self.write("named.csv", "load,name,x,y,z,length,width,height\n" + "".join(
            f"L{i},{name},{80 * k},0,0,80,60,{150 + i}\n" for i in range(4) for k, name in enumerate(("", "Pump", "Motor ä"))))
        shove = self.write("shove.txt", "0 1 6 -9 0\n")
        arguments = ["screen", "--layouts", table, "--accelerations", shove, "--json", "--quiet"]
        new = run(*arguments, "-o", self.folder / "new.h5")
        names = [json.loads(line).get("critical_box_name") for line in new.stdout.splitlines()]
        self.assertEqual(len(names), 4)
        self.assertTrue({"Pump", "Motor ä"} & set(names), names)
        for part in ("1/2", "2/2"):
            run(*arguments, "-o", self.folder / "merged.h5", "--part", part)
        self.assertEqual(run("merge", self.folder / "merged.h5", "--quiet").returncode, 0)
        for results in ("new.h5", "merged.h5"):
            again = run(*arguments, "-o", self.folder / results, "--resume")
            self.assertEqual([json.loads(line).get("critical_box_name") for line in again.stdout.splitlines()], names)

    def test_a_box_stands_on_a_drop_side_and_falls_beyond_it_as_check_says(self):
        rest = self.write("rest.txt", "0 1 0 0 0\n")
        for low, high, verdict in ((-0.08, 0, "stayed"), (-0.5, -0.06, "unstable")):
            load = {"container": {"size": [6, 2.4, 2.4], "drop_sides": {"left": 0.6}},
                    "boxes": [{"corner_min": [1, low, 0.6], "corner_max": [2, high, 0.8]}]}
            file = self.write("load.json", json.dumps({"holdfast": 1, "loads": [load]}))
            checked = run("check", file)
            self.assertEqual(checked.returncode, 0, checked.stderr)
            self.assertEqual("wholly beyond the floor" in checked.stderr, verdict != "stayed", checked.stderr)
            done = run("screen", "--layouts", file, "--accelerations", rest, "--json", "--quiet", "--overwrite",
                       "-o", self.folder / "side.h5")
            self.assertEqual(json.loads(done.stdout)["verdict"], verdict)

    def test_a_spreadsheet_file_is_told_to_be_saved_as_text(self):
        path = self.folder / "load.xlsx"
        path.write_bytes(b"PK\x03\x04 and so on")
        done = run("check", path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is a spreadsheet file (.xlsx or .ods); text: save or export it as CSV (UTF-8)", done.stderr)

    def test_encodings_of_spreadsheets_are_read(self):
        table = "Größe;x;y;z;Länge;Breite;Höhe;Gewicht\nKühlgerät;0;0;0;80;60;98,5;41\n"
        for encoding, note in (("utf-8", ""), ("utf-8-sig", ""), ("utf-16", ""), ("utf-16-be", ""),
                               ("windows-1252", "is not UTF-8, and taken as Windows-1252; save it as CSV (UTF-8) if letters of names are wrong")):
            path = self.folder / f"{encoding}.csv"
            path.write_bytes(table.encode(encoding))
            done = run("check", path)
            self.assertEqual(done.stdout, f"{path}: ok: layout (semicolon-separated table), 1 box, 41 kg, "
                                          "container 5.87 x 2.33 x 2.2 m; not used: Größe\n", encoding)
            self.assertEqual(done.stderr, f"warning: {path}: {note}\n" if note else "", encoding)
            run("screen", "--layouts", path, "--norm", "road", "--no-series", "--quiet", "--overwrite", "-o", self.folder / "r.h5")
            with h5py.File(self.folder / "r.h5") as file:
                self.assertEqual(file["worlds/status"][:].tolist(), [0] * 4)

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
