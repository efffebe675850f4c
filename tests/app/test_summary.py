"""`holdfast summary`: other thresholds, CSV, a new file; never a change of the results."""
import hashlib
import shutil
import unittest

import h5py
import numpy as np
import pandas as pd

from cli import CONFIG, SOURCE, CliTest, datasets, same_bits


NOT_COUNTED = 2**32 - 1  # in place of a count of boxes, of a world that was not simulated
VERDICTS = ["stayed", "moved", "fell", "unstable", "failed", "", "not_needed"]  # as they are numbered in the file


class Summary(CliTest):
    def setUp(self):
        super().setUp()
        self.write_inputs()
        bad = self.write('bad, "indeed".txt', "1\n0 0 0 0 1 1 1\n")
        self.layouts.append(bad)
        self.results, _ = self.screen(expect=1)
        self.hash = self.sha256()

    def tearDown(self):
        self.assertEqual(self.sha256(), self.hash, "the results file has changed")
        super().tearDown()

    def sha256(self):
        return hashlib.sha256(self.results.read_bytes()).hexdigest()

    def summary(self, *arguments, expect=0):
        done = self.run_here("summary", "results.h5", *arguments)
        self.assert_exit(done, expect)
        return done

    def recount(self, drop, move, tilt):
        """(fallen, moved, tilted) boxes of every world, from the peaks of the boxes."""
        data = datasets(self.results)
        flags = [data[f"/boxes/peak_{name}"].astype(float) > limit
                 for name, limit in (("drop", drop), ("displacement", move), ("tilt", tilt))]
        worlds = len(data["/worlds/layout"])
        return [np.bincount(data["/boxes/world"].astype(int), flag, worlds).astype(int).tolist() for flag in flags]

    def test_other_thresholds_count_otherwise(self):
        counts = []
        for drop, move, tilt in ((0.05, 0.1, 10), (0.0001, 0.01, 0.5), (0.7, 0.9, 60), (50, 50, 179)):
            with self.subTest(drop=drop, move=move, tilt=tilt):
                output = f"at{drop}.h5"
                done = self.summary("--drop-threshold", drop, "--move-threshold", move, "--tilt-threshold", tilt, "-o",
                                    output)
                self.assertIn(f"thresholds: drop {drop} m, move {move} m, tilt {tilt} degrees", done.stdout)
                data = datasets(self.folder / output, ["/summary/worlds"])
                found = [data[f"/summary/worlds/{name}_boxes"].tolist() for name in ("fallen", "moved", "tilted")]
                self.assertEqual([column[6:] for column in found], [[NOT_COUNTED] * 2] * 3)
                found = [column[:6] for column in found]
                self.assertEqual(found, [column[:6] for column in self.recount(drop, move, tilt)])
                counts.append(np.sum(found))
        self.assertEqual(counts[3], 0)
        self.assertEqual(len(set(counts)), 4)

    def test_own_thresholds_give_the_same_tables(self):
        self.summary("-o", "again.h5")
        expected, found = (datasets(self.folder / name, ["/summary"]) for name in ("results.h5", "again.h5"))
        self.assertEqual(sorted(expected), sorted(found))
        for name in expected:
            self.assertTrue(same_bits(expected[name], found[name]), name)
        with h5py.File(self.folder / "again.h5") as file:
            self.assertEqual(file.attrs["format"], "holdfast summary")
            self.assertEqual(file["summary"].attrs["drop_threshold"], 0.05)

    def test_prints_what_the_run_printed(self):
        _, done = self.screen(output="other.h5", expect=1)
        table = done.stdout.split("\nresults:")[0]
        self.assertEqual(self.summary().stdout.split("\n", 1)[1].strip(), table.strip())

    def test_tables_of_another_run_are_told_apart(self):
        self.write("tables/margins.csv", "layout\n")
        done = self.summary("--csv", "tables")
        self.assertEqual(done.stderr, "warning: tables/margins.csv: is of another run, and stays as it is\n")

    def test_csv_is_what_the_file_holds(self):
        self.summary("--csv", "tables")
        worlds, boxes = (pd.read_csv(self.folder / f"tables/{name}.csv") for name in ("worlds", "boxes"))
        data = datasets(self.results)
        names = {kind: [name.decode() for name in data[f"/inputs/{kind}s/name"][data[f"/worlds/{kind}"]]]
                 for kind in ("layout", "acceleration")}
        for table, path, of_world in ((worlds, "worlds", np.arange(8)), (boxes, "boxes", data["/boxes/world"])):
            self.assertEqual(list(table["world"]), list(of_world))
            for kind, values in names.items():
                self.assertEqual(list(table[kind]), [values[w] for w in of_world])
            checked = 0
            for column in table:
                base = column.removesuffix("_m").removesuffix("_J").removesuffix("_deg").removesuffix("_s")
                if f"/summary/{path}/{base}" in data:
                    expected = data[f"/summary/{path}/{base}"]
                    if column == "verdict":
                        self.assertEqual(list(table[column]), [VERDICTS[i] for i in expected])
                        continue
                    if path == "worlds":
                        missing = expected == NOT_COUNTED if expected.dtype.kind == "u" else np.isnan(expected)
                        self.assertEqual(missing.tolist(), [False] * 6 + [True] * 2, column)
                        self.assertEqual(table[column].isna().tolist(), missing.tolist(), column)
                        np.testing.assert_allclose(table[column][:6].to_numpy(expected.dtype), expected[:6], 1e-14, 0,
                                                   err_msg=column)
                        checked += 1
                        continue
                    # By default pandas may miss the last bit of a double.
                    np.testing.assert_allclose(table[column].to_numpy(expected.dtype), expected, 1e-14, 0, err_msg=column)
                    checked += 1
            self.assertGreater(checked, 5)
        for i, axis in enumerate("xyz"):
            np.testing.assert_array_equal(boxes[f"end_displacement_{axis}_m"].to_numpy(np.float32),
                                          data["/boxes/end_displacement"][:, i])
        for name, unit in (("peak_displacement", "m"), ("peak_drop", "m"), ("peak_tilt", "deg")):
            np.testing.assert_array_equal(boxes[f"{name}_{unit}"].to_numpy(np.float32), data[f"/boxes/{name}"])
        for column, name in (("max_residual", "max_residual"), ("residual_scale", "residual_scale"),
                             ("max_penetration_m", "max_penetration")):
            np.testing.assert_allclose(worlds[column], data[f"/worlds/{name}"], 1e-13, 0, err_msg=column)
        np.testing.assert_array_equal(boxes["mass_kg"].to_numpy(np.float32), data["/boxes/mass"])
        self.assertEqual(list(worlds["status"]), ["ok"] * 6 + ["bad_layout"] * 2)
        self.assertEqual(worlds["status_text"][6], data["/worlds/status_text"][6].decode())

    def make_old(self, version):
        """The results file as an earlier version wrote it."""
        with h5py.File(self.results, "r+") as file:
            for name in ("peak_speed", "peak_drop", "peak_tilt", "first_beyond", "settling_peak_displacement",
                         "settling_peak_drop", "settling_peak_tilt"):
                del file[f"boxes/{name}"]
            for name in ("status_time", "caveats", *(["residual_scale"] if version == 1 else [])):
                del file[f"worlds/{name}"]
            file.attrs.modify("format_version", np.uint64(version))
        self.hash = self.sha256()

    def test_files_of_versions_1_and_2_are_judged_at_the_end_and_say_so(self):
        for version in (2, 1):
            with h5py.File(self.results) as file:
                displacement = file["boxes/end_displacement"][:].astype(float)
                world = file["boxes/world"][:].astype(int)
            if version == 2:
                self.make_old(2)
            else:
                with h5py.File(self.results, "r+") as file:
                    del file["worlds/residual_scale"]
                    file.attrs.modify("format_version", np.uint64(1))
                self.hash = self.sha256()
            for drop in (0.05, 0.3):
                done = self.summary("--csv", f"old{version}", "--drop-threshold", drop)
                self.assertIn("judged by where boxes are at the end: the file is of an earlier version", done.stdout)
                worlds = pd.read_csv(self.folder / f"old{version}/worlds.csv")
                fallen = np.bincount(world, -displacement[:, 2] > drop, len(worlds)).astype(int)
                self.assertEqual(worlds["fallen_boxes"][:6].tolist(), fallen[:6].tolist())
                self.assertEqual((worlds["verdict"] == "fell").tolist(), (fallen > 0).tolist())
                self.assertTrue(worlds["status_time_s"].isna().all())
                boxes = pd.read_csv(self.folder / f"old{version}/boxes.csv")
                for name in ("peak_speed_m_s", "peak_drop_m", "first_beyond_s"):
                    self.assertTrue(boxes[name].isna().all(), name)
        self.assertEqual(set(worlds["residual_scale"]), {1.0})

    def test_peaks_judged_again_are_what_a_fresh_run_finds(self):
        for drop, move, tilt in ((0.01, 0.02, 2), (0.05, 0.1, 10), (0.1, 0.3, 45), (0.4, 0.1, 180), (0.05, 1, 5)):
            with self.subTest(drop=drop, move=move, tilt=tilt):
                self.summary("--drop-threshold", drop, "--move-threshold", move, "--tilt-threshold", tilt, "-o",
                             f"again{move}{tilt}.h5")
                self.config.write_text(CONFIG + f"MoveThreshold = {move}\nTiltThreshold = {tilt}\n"
                                       f"[Simulation Settings]\nDropThreshold = {drop}\n")
                fresh, _ = self.screen(output=f"fresh{move}{tilt}.h5", expect=1)
                again, found = (datasets(self.folder / f"{name}{move}{tilt}.h5") for name in ("again", "fresh"))
                # A world that was accelerated is unstable by tighter limits; one that was not stays what it is.
                verdicts = again["/summary/worlds/verdict"].tolist()
                self.assertEqual(verdicts, found["/summary/worlds/verdict"].tolist())
                stable = [w for w, verdict in enumerate(verdicts[:6]) if verdict != 3]
                for name in ("fallen_boxes", "moved_boxes", "tilted_boxes", "peak_displacement"):
                    self.assertEqual(again[f"/summary/worlds/{name}"][stable].tolist(),
                                     found[f"/summary/worlds/{name}"][stable].tolist(), name)

    def test_the_verdicts_are_those_that_the_table_counts(self):
        self.summary("--csv", "tables")
        worlds = pd.read_csv(self.folder / "tables/worlds.csv")
        counted = {line.split()[0]: [int(word) for word in line.split()[1:6]]
                   for line in self.summary().stdout.splitlines() if line.startswith(("shove.txt", "rest.txt"))}
        found = {name: [int((group["verdict"] == verdict).sum()) for verdict in VERDICTS[:5]]
                 for name, group in worlds.groupby("acceleration")}
        self.assertEqual(found, counted)
        self.assertGreater(len(set(worlds["verdict"])), 2)

    def test_a_file_from_before_verdicts_is_summarised(self):
        now = self.summary("--csv", "now").stdout
        shutil.copy(self.results, self.folder / "old.h5")
        with h5py.File(self.folder / "old.h5", "r+") as file:
            for name in list(file["summary/worlds"]):  # what is derived is derived again
                del file["summary/worlds"][name]
        done = self.run_here("summary", "old.h5", "--csv", "old", "-o", "old_summary.h5")
        self.assert_exit(done, 0)
        self.assertEqual(done.stdout, now)
        for name in ("worlds.csv", "boxes.csv"):
            self.assertEqual((self.folder / "old" / name).read_bytes(), (self.folder / "now" / name).read_bytes())
        found = datasets(self.folder / "old_summary.h5")["/summary/worlds/verdict"]
        self.assertEqual(found.tolist(), datasets(self.results)["/summary/worlds/verdict"].tolist())

    def test_a_new_file_only(self):
        precious = self.write("precious.h5", "mine")
        for output in ("precious.h5", "results.h5"):
            done = self.summary("-o", output, expect=2)
            self.assertEqual(done.stdout, "")
            self.assertIn(f"{output}: exists already", done.stderr)
        self.assertEqual(precious.read_text(), "mine")

    def test_files_that_are_no_results(self):
        whole = self.results.read_bytes()
        self.write("truncated.h5", whole[:len(whole) // 2])
        self.write("stub.h5", whole[:100])
        self.write("empty.h5", b"")
        self.write("text.h5", "Nothing of the kind.\n")
        with h5py.File(self.folder / "foreign.h5", "w") as file:
            file["values"] = np.arange(3)
        self.summary("-o", "tables.h5")
        for name in ("truncated.h5", "stub.h5", "empty.h5", "text.h5", "foreign.h5", "tables.h5", "missing.h5", "."):
            with self.subTest(name=name):
                self.assert_refused(self.run_here("summary", name), name)


class NamesOfLoads(CliTest):
    """Names of boxes, materials and containers, where loads have them."""

    def setUp(self):
        super().setUp()
        self.write("named.csv", "name,material,container length (m),container width (m),container height (m),"
                                "x (m),y (m),z (m),length (m),width (m),height (m),weight (kg)\n"
                                "=1+1,3,6,2.4,2.5,2,0,0,1,1,1,100\n\"Pump, left\",crate,6,2.4,2.5,2,1,0,1,1,1,90\n4,crate,6,2.4,2.5,2,0,1,1,1,1,80\n")
        self.write("left.txt", "0 2 0 -9 0\n")
        self.assert_exit(self.run_here("screen", "--quiet", "--layouts", "named.csv", SOURCE / "configs/loads/trailer.csv",
                                       SOURCE / "configs/layouts/seed_example.txt", "--accelerations", "left.txt", "--margins", "--damage"), 0)

    def tables(self, file="results.h5"):
        done = self.run_here("summary", file, "--csv", "tables")
        self.assert_exit(done, 0)
        return done.stdout, *(pd.read_csv(self.folder / f"tables/{name}.csv", dtype=str, keep_default_na=False) for name in ("worlds", "boxes"))

    def test_tables_have_them(self):
        text, worlds, boxes = self.tables()
        self.assertEqual(list(boxes.columns[:7]), ["world", "layout", "acceleration", "id", "name", "material", "mass_kg"])
        self.assertEqual(list(worlds["container"]), ["6 x 2.4 x 2.5 m", "trailer-curtain", ""])
        named = boxes[boxes["layout"] == "named.csv"]
        self.assertEqual(list(named["name"]), ["'=1+1", "Pump, left", "4"])
        self.assertEqual(list(named["material"]), ["3", "crate", "crate"])
        self.assertEqual(list(named["mass_kg"]), ["100", "90", "80"])
        self.assertEqual(set(boxes[boxes["layout"] == "seed_example.txt"]["name"]), {""})
        critical = [int(box) for box in worlds["critical_box"]]
        names = {layout: list(of["name"]) for layout, of in boxes.groupby("layout")}
        expected = [names[layout][box - 1] if box else "" for layout, box in zip(worlds["layout"], critical)]
        self.assertEqual(list(worlds["critical_box_name"]), expected)
        self.assertRegex(text, rf"trailer.csv under left.txt: .*; box {critical[1]} \({expected[1]}\) first")
        self.assertRegex(text, r"trailer.csv +\d.*, box \d+ \(\w+ \d\)\n")
        self.assertNotRegex(text, r"seed_example.*\(")

    def test_a_file_from_before_loads_said_more_has_none(self):
        with h5py.File(self.folder / "results.h5", "r+") as file:
            for name in set(file["inputs/layouts"]) - {"name", "sha256", "header", "box_begin", "box_count", "corner_min", "corner_max", "material"}:
                del file[f"inputs/layouts/{name}"]
        text, worlds, boxes = self.tables()
        self.assertEqual({*worlds["container"], *worlds["critical_box_name"], *boxes["name"]}, {""})
        self.assertEqual(set(boxes["material"]), {"3", "-1", "1"})
        self.assertRegex(text, r"trailer.csv under left.txt: .*; box \d+ first")


if __name__ == "__main__":
    unittest.main()
