"""`holdfast screen`: what the results file holds, that it is the same however it was computed, and what is printed."""
import json
import re
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from cli import CONFIG, REST, SEED, SOURCE, CliTest, datasets, layout_text, same_bits, schedulers

DROP, MOVE, TILT = 0.05, 0.10, 10.0  # the defaults, m and degrees


def documented_datasets(everything=True):
    """(path, type, length, units) of every dataset that docs/reference/results_file.md names; or of those that every file has."""
    group, found = "", []
    for line in (SOURCE / "docs/reference/results_file.md").read_text().splitlines():
        if line.startswith("#"):
            group = line[4:] if line.startswith("### /") else ""
        if line.startswith("Only in files of runs with") and not everything:
            group = ""
        row = re.match(r"\| `(\w+)` \| (\w+) \| ([A-Z])(?: × (\d+))? \| (\S+) \|", line)
        if group and row:
            name, kind, axis, columns, units = row.groups()
            found.append((f"{group}/{name}", kind, axis, int(columns or 1), units))
    return found


def asking_options():
    """The options that ask for every analysis which docs/reference/results_file.md names: --load-shift for LoadShift."""
    page = (SOURCE / "docs/reference/results_file.md").read_text()
    keys = {key for line in re.findall(r"Only in files of runs with (.*), see", page) for key in re.findall(r"`(\w+)`", line)}
    options = ["--" + re.sub(r"(?<=.)([A-Z])", r"-\1", key).lower() for key in keys - {"Walls", "Replicas"}]
    return [*sorted(options), "--replicas", 32]


class Contents(CliTest):
    """One run, looked at from all sides."""

    def setUp(self):
        super().setUp()
        self.write_inputs()
        self.path, self.done = self.screen("--threads", 2)
        self.file = h5py.File(self.path)
        self.addCleanup(self.file.close)

    def column(self, path):
        return self.file[path][:]

    def worlds(self):
        """(index, samples of time, displacement[sample, box, 3], orientation, slice of its boxes) of every world."""
        names = ("row_begin", "sample_begin", "sample_count", "box_begin", "box_count")
        for w, row in enumerate(zip(*(self.column(f"worlds/{name}").astype(int) for name in names))):
            row_begin, sample_begin, samples, box_begin, boxes = row
            rows = slice(row_begin, row_begin + samples * boxes)
            yield (w, self.column("series/time")[sample_begin:sample_begin + samples],
                   self.column("series/displacement")[rows].reshape(samples, boxes, 3),
                   self.column("series/orientation")[rows].reshape(samples, boxes, 4),
                   slice(box_begin, box_begin + boxes))

    def test_is_as_documented(self):
        documented = documented_datasets()
        self.assertGreater(len(documented), 60)
        path, _ = self.screen("--engine", "native", *asking_options(), output="everything.h5")
        file = h5py.File(path)
        self.addCleanup(file.close)
        lengths = {}
        kinds = {"text": "S", "uint": "u", "int": "i", "float": "f"}
        for name, kind, axis, columns, units in documented:
            dataset = file[name]
            self.assertEqual(dataset.attrs["units"], units, name)
            self.assertGreater(len(dataset.attrs["description"]), 3, name)
            self.assertEqual(dataset.dtype.kind, kinds[kind.rstrip("0123456789")], name)
            if kind != "text":
                self.assertEqual(8 * dataset.dtype.itemsize, int(re.sub(r"\D", "", kind)), name)
            self.assertEqual(dataset.shape[1:], (columns,) if columns > 1 else (), name)
            self.assertEqual(lengths.setdefault(axis, len(dataset)), len(dataset), name)
        self.assertEqual(set(datasets(path)), {name for name, *_ in documented} | {"/inputs/config"})
        self.assertEqual({axis: lengths[axis] for axis in "WNLBAG"}, {"W": 6, "N": 20, "L": 3, "B": 10, "A": 2, "G": 4})

    def test_has_what_was_asked_for_and_no_more(self):
        self.assertEqual(set(datasets(self.path)), {name for name, *_ in documented_datasets(False)} | {"/inputs/config"})

    def test_attributes_tell_what_ran(self):
        self.assertEqual(self.file.attrs["format"], "holdfast results")
        self.assertEqual(self.file.attrs["engine"], "bullet-stock")
        self.assertEqual(self.file.attrs["complete"], 1)
        self.assertIn("screen -c", self.file.attrs["command_line"])
        self.assertEqual(self.file["inputs/config"].asstr()[()], CONFIG)
        self.assertEqual(float(self.file["inputs/settings"].attrs["Simulation Settings/DropThreshold"]), DROP)
        self.assertEqual(list(self.file["inputs/layouts/name"].asstr()), ["seed.txt", "tower.txt", "floating.txt"])
        self.assertEqual(list(self.file["inputs/accelerations/name"].asstr()), ["shove.txt", "rest.txt"])

    def test_worlds_lie_end_to_end(self):
        boxes, samples = (self.column(f"worlds/{name}").astype(int) for name in ("box_count", "sample_count"))
        for begin, count, whole in (("box_begin", boxes, "boxes/world"), ("sample_begin", samples, "series/time"),
                                    ("row_begin", boxes * samples, "series/kinetic_energy")):
            ends = np.cumsum(count)
            self.assertEqual(list(self.column(f"worlds/{begin}")), [0, *ends[:-1]])
            self.assertEqual(len(self.file[whole]), ends[-1])
        self.assertEqual(list(self.column("boxes/world")), list(np.repeat(np.arange(6), boxes)))
        self.assertEqual(list(self.column("boxes/id")), [i for count in boxes for i in range(1, count + 1)])
        self.assertEqual(list(self.column("worlds/layout")), [0, 0, 1, 1, 2, 2])
        self.assertEqual(list(self.column("worlds/acceleration")), [0, 1] * 3)

    def test_samples_come_at_every_interval_and_the_end(self):
        for w, time, *_ in self.worlds():
            end = self.column("worlds/end_time")[w]
            unstable = self.column("summary/worlds/verdict")[w] == 3
            begin = -2 if unstable else 0
            expected = begin + 0.1 * np.arange(int((end - begin) / 0.1 + 1e-6) + 1)
            if end - expected[-1] > 1e-6:
                expected = [*expected, end]
            np.testing.assert_allclose(time, expected, atol=1e-9)
            if unstable:
                self.assertLessEqual(end, 0)
            else:
                self.assertGreater(end, (1.02, 1.0)[w % 2] - 1e-9)

    def test_verdicts_agree_with_the_series(self):
        summary = {name: self.column(f"summary/worlds/{name}") for name in self.file["summary/worlds"]}
        for w, time, displacement, orientation, boxes in self.worlds():
            end = displacement[-1].astype(float)
            far = np.linalg.norm(displacement.astype(float), axis=2)
            tilt = np.degrees(2 * np.arccos(np.clip(np.abs(orientation[..., 0].astype(float)), 0, 1)))
            drop = -displacement[..., 2].astype(float)
            # Peaks are over all steps, samples over some of them.
            for name, samples, limit in (("fallen", drop, DROP), ("moved", far, MOVE), ("tilted", tilt, TILT)):
                self.assertGreaterEqual(summary[f"{name}_boxes"][w], np.sum(samples.max(axis=0) > limit), name)
            for name, samples in (("displacement", far), ("drop", drop), ("tilt", tilt)):
                peaks = self.column(f"boxes/peak_{name}")[boxes]
                self.assertTrue((peaks >= samples.max(axis=0) - 0.2).all() if name == "tilt" else
                                (peaks >= samples.max(axis=0) - 1e-6).all(), name)
                self.assertEqual(summary[f"peak_{name}"][w], peaks.max())
            self.assertEqual(summary["fallen_at_end"][w], np.sum(drop[-1] > DROP))
            self.assertAlmostEqual(summary["end_displacement"][w], far[-1].max(), 5)
            np.testing.assert_array_equal(self.column("boxes/end_displacement")[boxes], displacement[-1])
            np.testing.assert_allclose(self.column("boxes/end_tilt")[boxes], tilt[-1], atol=0.2)  # from the settled pose
            beyond = (far > MOVE) | (drop > DROP) | (tilt > TILT)
            first = np.array([time[row.argmax()] if row.any() else np.inf for row in beyond.T])
            told = self.column("summary/boxes/first_beyond")[boxes]
            self.assertTrue((np.where(np.isnan(told), np.inf, told) <= first + 1 / 60).all())  # the end of the step
            critical = summary["critical_box"][w]
            if not np.isnan(told).all():
                self.assertEqual(told[critical - 1], np.nanmin(told))
        self.assertGreater(summary["fallen_boxes"].sum(), 0)
        self.assertGreaterEqual(summary["moved_boxes"].sum(), summary["fallen_boxes"].sum())

    def test_fallen_count_and_energy_add_up(self):
        energy = self.column("series/kinetic_energy").astype(float)
        total = self.column("series/total_kinetic_energy")
        fallen = self.column("series/fallen_count")
        for w, time, displacement, *_ in self.worlds():
            row, first = (int(self.column(f"worlds/{name}")[w]) for name in ("row_begin", "sample_begin"))
            samples = slice(first, first + len(time))
            boxes = displacement.shape[1]
            expected = energy[row:row + len(time) * boxes].reshape(-1, boxes).sum(axis=1)
            np.testing.assert_allclose(total[samples], expected, rtol=1e-5, atol=1e-6)
            np.testing.assert_array_equal(fallen[samples], (-displacement[:, :, 2] > DROP).sum(axis=1))

    def test_force_is_minus_mass_times_acceleration(self):
        mass, force = self.column("boxes/mass"), self.column("series/force")
        np.testing.assert_allclose(mass[:3], 250 * 0.80 * 0.59 * 1.06, rtol=1e-6)
        acceleration = self.column("series/container_acceleration")
        for w, time, displacement, _, boxes in self.worlds():
            row, first = (int(self.column(f"worlds/{name}")[w]) for name in ("row_begin", "sample_begin"))
            shape = displacement.shape
            expected = -mass[boxes][None, :, None] * acceleration[first:first + len(time)][:, None, :]
            np.testing.assert_allclose(force[row:row + shape[0] * shape[1]].reshape(shape), expected, rtol=1e-5)

    def test_nothing_leaves_the_container(self):
        position = np.abs(self.column("series/displacement"))
        self.assertLess(position.max(), 5.87)
        self.assertTrue(np.isfinite(position).all())
        for w, _, displacement, _, boxes in self.worlds():
            centre = self.column("boxes/initial_position")[boxes] + displacement
            self.assertTrue((centre > -0.01).all() and (centre < [5.88, 2.34, 2.21]).all(), f"world {w}")

    def test_h5dump_reads_it(self):
        if shutil.which("h5dump") is None:
            self.skipTest("no h5dump")
        header = subprocess.run(["h5dump", "-H", self.path], capture_output=True, text=True, check=True)
        self.assertIn('DATASET "displacement"', header.stdout)
        self.assertEqual(header.stderr, "")

    def test_table_names_the_outcome(self):
        words = self.done.stdout.split()
        for word in ("stayed", "fell", "unstable", "shove.txt", "rest.txt", "results.h5"):
            self.assertIn(word, words)
        self.assertIn("3 layouts x 2 accelerations = 6 worlds, engine bullet-stock", self.done.stderr)


class SameResults(CliTest):
    def setUp(self):
        super().setUp()
        self.write_inputs()

    def test_schedulers_and_threads_do_not_matter(self):
        self.layouts += [self.write(f"tower{i}.txt", layout_text([(100, 90, 35 * k, 130 + i, 120, 35 * (k + 1))
                                                                  for k in range(4)])) for i in range(6)]
        first, _ = self.screen("--scheduler", "serial", output="first.h5")
        for scheduler in schedulers():
            for threads in (1, 2, 3):
                with self.subTest(scheduler=scheduler, threads=threads):
                    other, _ = self.screen("--scheduler", scheduler, "--threads", threads, "--overwrite")
                    self.assert_same_results(first, other)

    def test_a_world_does_not_depend_on_the_others(self):
        together, _ = self.screen(output="together.h5")
        self.layouts, self.accelerations = self.layouts[1:2], self.accelerations[:1]
        alone, _ = self.screen(output="alone.h5")
        hashes = datasets(together)["/worlds/state_hash"], datasets(alone)["/worlds/state_hash"]
        self.assertEqual(hashes[0][2], hashes[1][0])

    def test_no_series_gives_the_same_summary(self):
        whole, _ = self.screen(output="whole.h5")
        short, _ = self.screen("--no-series", output="short.h5")
        expected, found = datasets(whole), datasets(short)
        for name in expected:
            if name.startswith("/series/"):
                self.assertEqual(len(found[name]), 0, name)
            elif name.startswith(("/summary/", "/boxes/")):
                self.assertTrue(same_bits(expected[name], found[name]), name)
        self.assertFalse(found["/worlds/sample_count"].any())

    def test_floating_boxes_are_unstable_whatever_the_acceleration(self):
        self.layouts = self.layouts[2:]
        for pose in ("layout", "settled"):
            with self.subTest(pose=pose):
                self.config.write_text(CONFIG + f"SettleSeconds = 1\nReferencePose = {pose}\n")
                path, done = self.screen("--overwrite")
                data = datasets(path)
                self.assertEqual(list(data["/summary/worlds/unstable_boxes"]), [1, 1])
                self.assertEqual(list(data["/summary/worlds/fallen_boxes"]), [1, 1])
                self.assertEqual(list(data["/summary/boxes/unstable"]), [0, 1, 0, 1])
                self.assertTrue((data["/worlds/end_time"] <= 0).all())
                self.assertTrue((data["/summary/boxes/first_beyond"][1::2] < 0).all())
                # 60 cm down onto the floor, and no farther than rounding and a contact's slack.
                np.testing.assert_allclose(data["/boxes/settling_displacement"][1], [0, 0, -0.6], atol=0.02)
                self.assertLess(np.abs(data["/series/displacement"]).max(), 0.65)
                self.assertEqual(data["/series/time"].min(), -1)
                for name in ("shove", "rest"):
                    self.assertRegex(done.stdout, rf"{name}\.txt +0 +0 +0 +1 +0 ")
                self.assertIn("unstable: beyond a limit while settling, before any acceleration", done.stdout)
                self.assertIn("floating.txt: 1 of 2 boxes", done.stdout)


class NativeEngine(CliTest):
    """The default engine, which takes at once what does not change anything."""

    def setUp(self):
        super().setUp()
        self.write_inputs()
        self.config.write_text("[Export Settings]\nResultsIntervallInSeconds = 0.05\n")
        self.layouts[1:] = [self.write("box.txt", layout_text([(200, 50, 0, 280, 110, 40)]))]

    def test_is_the_default_and_skips_what_rests(self):
        path, done = self.screen()
        self.assertIn("engine native, accuracy standard, scheduler", done.stderr)
        self.assertRegex(done.stdout, r"\nsteps skipped, since nothing moved in them: \d+\.\d % of \d+\n")
        with h5py.File(path) as file:
            self.assertEqual(file.attrs["engine"], "native")
            self.assertEqual(file["inputs/settings"].attrs["Native/Accuracy"], "standard")
            steps, skipped = file["worlds/steps"][:], file["worlds/steps_skipped"][:]
            self.assertTrue((skipped[1::2] == steps[1::2]).all(), "nothing happens under rest.txt")
            self.assertTrue((skipped[::2] < steps[::2]).all(), "and something does under shove.txt")
            self.assertEqual(list(file["summary/worlds/peak_displacement"][1::2]), [0, 0])

    def test_accuracy_is_an_option(self):
        reference = self.write("reference.ini", "[Native]\nAccuracy = reference\n")
        by_option, done = self.screen("--accuracy", "reference", output="option.h5")
        self.assertIn("engine native, accuracy reference, ", done.stderr)
        self.config = reference
        by_key, _ = self.screen(output="key.h5")
        overridden, done = self.screen("--accuracy", "screening", output="overridden.h5")
        self.assertIn("engine native, accuracy screening, ", done.stderr)
        hashes = [list(datasets(path)["/worlds/state_hash"]) for path in (by_option, by_key, overridden)]
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])

    def test_another_accuracy_is_another_run(self):
        self.screen("--accuracy", "screening")
        self.assert_refused(self.screen("--resume", expect=2)[1], "results.h5: is of a run with other settings: by holdfast ",
                            "--overwrite starts anew")
        self.screen("--accuracy", "screening", "--resume")

    def test_schedulers_and_threads_do_not_matter(self):
        first, _ = self.screen("--scheduler", "serial", output="first.h5")
        for scheduler in schedulers():
            with self.subTest(scheduler=scheduler):
                other, _ = self.screen("--scheduler", scheduler, "--threads", 3, "--overwrite")
                self.assert_same_results(first, other)


class Output(CliTest):
    def setUp(self):
        super().setUp()
        self.write_inputs()

    def test_json_is_a_line_a_world_in_order(self):
        path, done = self.screen("--json", "--threads", 3)
        worlds = [json.loads(line) for line in done.stdout.splitlines()]
        data = datasets(path)
        self.assertEqual([world["world"] for world in worlds], list(range(6)))
        for w, world in enumerate(worlds):
            self.assertEqual(world["verdict"],
                             ("stayed", "moved", "fell", "unstable", "failed", "", "not_needed")[data["/summary/worlds/verdict"][w]])
            for name in ("fallen_boxes", "moved_boxes", "tilted_boxes", "unstable_boxes"):
                self.assertEqual(world[name], data[f"/summary/worlds/{name}"][w], name)
            for name, column in (("end_displacement_m", "end_displacement"), ("peak_displacement_m", "peak_displacement"),
                                 ("end_kinetic_energy_J", "end_kinetic_energy"),
                                 ("peak_kinetic_energy_J", "peak_kinetic_energy")):
                self.assertAlmostEqual(world[name], float(data[f"/summary/worlds/{column}"][w]), 6, name)
            for name, column in (("max_residual", "max_residual"), ("residual_scale", "residual_scale"),
                                 ("max_penetration_m", "max_penetration")):
                self.assertEqual(world[name], data[f"/worlds/{column}"][w], name)
            self.assertEqual(world["layout"], self.layouts[w // 2].name)
            self.assertEqual(world["acceleration"], self.accelerations[w % 2].name)
            self.assertEqual(int(world["state_hash"], 16), data["/worlds/state_hash"][w])
            self.assertEqual(world["steps"], data["/worlds/steps"][w])
            self.assertEqual(world["status"], "ok")
            self.assertIn(world["stop_reason"], ("sleeping", "decided"))

    def test_quiet_prints_nothing(self):
        _, done = self.screen("--quiet")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_quiet_json_prints_json_alone(self):
        _, done = self.screen("--quiet", "--json")
        self.assertEqual((len(done.stdout.splitlines()), done.stderr), (6, ""))

    def test_lists_on_standard_input(self):
        expected, _ = self.screen(output="expected.h5")
        layouts, accelerations = self.layouts, self.accelerations
        self.layouts = ["-"]
        path, _ = self.screen(output="a.h5", input="".join(f"{name}\n" for name in layouts))
        self.assert_same_results(expected, path)
        self.layouts, self.accelerations = layouts, ["-"]
        path, _ = self.screen(output="b.h5", input="\n".join(map(str, accelerations)))
        self.assert_same_results(expected, path)

    def test_two_lists_on_standard_input_are_refused(self):
        done = self.run_here("screen", "--layouts", "-", "--accelerations", "-", input="seed.txt\n")
        self.assert_refused(done, "standard input", "not both")

    def test_an_empty_list_is_refused(self):
        done = self.run_here("screen", "--layouts", "-", "--accelerations", "rest.txt", input="\n")
        self.assert_refused(done, "standard input is empty")

    def test_folders_are_read_in_order_of_their_names(self):
        for name in ("b.txt", "a.txt", "B.txt"):
            self.write(f"layouts/{name}", layout_text([(0, 0, 0, 50, 50, 50)]))
        self.write("layouts/notes.md", "Nothing here.\n")
        self.layouts, self.accelerations = ["layouts"], self.accelerations[1:]
        path, done = self.screen()
        self.assertEqual(list(datasets(path)["/inputs/layouts/name"]), [b"B.txt", b"a.txt", b"b.txt"])
        self.assertIn("warning: layouts/notes.md: left out", done.stderr)

    def test_results_are_replaced_on_demand_only(self):
        path, _ = self.screen()
        before = path.read_bytes()
        done = self.screen(expect=2)[1]
        self.assert_refused(done, "results.h5: exists already", "--overwrite")
        self.assertEqual(path.read_bytes(), before)
        self.layouts = self.layouts[:1]
        self.screen("--overwrite")
        self.assertEqual(len(datasets(path)["/worlds/layout"]), 2)
        self.assertFalse(path.with_name("results.h5.parts").exists())

    def test_overwrite_spares_what_is_no_results_file(self):
        precious = self.write("precious.txt", "mine\n")
        done = self.screen("--overwrite", output="precious.txt", expect=2)[1]
        self.assert_refused(done, "precious.txt", "not a results file")
        self.assertEqual(precious.read_text(), "mine\n")

    def test_inputs_of_the_same_name_are_reported(self):
        self.layouts += [self.write("again/seed.txt", layout_text(SEED)), self.write("once/more/seed.txt", layout_text(SEED))]
        _, done = self.screen()
        self.assertIn(f"warning: {self.layouts[3]}: has the same name in the results as: {self.layouts[0]}; "
                      "one of 2 such files\n", done.stderr)
        self.assertEqual(done.stderr.count("warning: "), 1)
        del self.layouts[3:]
        self.accelerations.append(self.write("again/rest.txt", REST))
        _, done = self.screen("--overwrite")
        self.assertIn(f"warning: {self.accelerations[2]}: has the same name in the results as: {self.accelerations[1]}\n",
                      done.stderr)

    def test_text_files_that_cannot_be_are_told_before(self):
        self.layouts.append(self.write(f"{'l' * 240}.txt", layout_text(SEED)))
        for folder, words in (("text", ("text: cannot have a text file with such a long name: [SOLUTION_RESUMED]$lll", "at most 255 bytes")),
                              ("seed.txt/text", ("seed.txt/text: cannot be created",))):
            with self.subTest(folder=folder):
                _, done = self.screen("--text", folder, expect=2)
                self.assert_refused(done, *words)
                self.assertFalse(list(self.folder.glob("results*")))

    def test_names_need_not_be_ascii(self):
        self.layouts = [self.write("Lädung, 1 \"x\".txt", layout_text([(0, 0, 0, 50, 50, 50)]))]
        path, done = self.screen("--json")
        self.assertEqual(json.loads(done.stdout.splitlines()[0])["layout"], self.layouts[0].name)
        with h5py.File(path) as file:
            self.assertEqual(file["inputs/layouts/name"].asstr()[0], self.layouts[0].name)

    def test_slight_faults_of_a_layout_are_said(self):
        self.layouts = [self.write("slight.txt", "1 2\n0 0 0 50 50 50 1\n49.995 0 0 99 50 50 1\n")]
        _, done = self.screen()
        self.assertIn("warning: ", done.stderr)
        self.assertIn("overlap", done.stderr)


if __name__ == "__main__":
    unittest.main()
