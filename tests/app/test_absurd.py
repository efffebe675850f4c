"""Absurd values and names: an answer in bounded time and memory, and nothing outside the output folder."""
import json
import os
import resource
import unittest

import h5py
import pandas as pd

from cli import CONFIG, SANITIZED, SEED, THOROUGH, CliTest, datasets, layout_text

LONG = 60_000_000 if THOROUGH else 6_000_000  # letters of a line
MOST_MEMORY = 900 << 20  # byte: several times what the largest input that is read takes


class Sizes(CliTest):
    def check(self, *arguments):
        def limit():
            resource.setrlimit(resource.RLIMIT_DATA, (MOST_MEMORY, MOST_MEMORY))

        # A sanitizer reserves terabytes of addresses that it never uses.
        limited = {} if SANITIZED else {"preexec_fn": limit}
        return self.run_here(*arguments, **limited)

    def write_inputs(self):
        super().write_inputs()
        self.layouts = self.layouts[:1]

    def assert_bad_layout(self, path, *words):
        """The layout is marked and reported; the good one beside it is simulated."""
        done = self.check("screen", "-c", self.config, "--layouts", path, *self.layouts, "--accelerations", "rest.txt",
                          "-o", "results.h5", "--overwrite")
        self.assert_exit(done, 1)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(datasets(self.folder / "results.h5")["/worlds/status"].tolist(), [1, 0])

    def test_a_line_of_a_gigabyte(self):
        self.write_inputs()
        path = self.write("line.txt", "1 1\n")
        os.truncate(path, 1 << 30)
        self.assert_bad_layout(path, "line.txt: is too large for an input file")

    def test_a_line_of_many_megabytes(self):
        self.write_inputs()
        self.assert_bad_layout(self.write("words.txt", "1 1\n" + "7 " * (30_000_000 if THOROUGH else 3_000_000)), "words.txt")
        self.assert_bad_layout(self.write("word.txt", "1 1\n0 0 0 " + "7" * LONG + " 5 5 1\n"), "word.txt:2:7: x2")
        self.assert_bad_layout(self.write("header.txt", "1" * LONG + "\n0 0 0 5 5 5 1\n"), "the header is too long")

    def test_ten_million_boxes(self):
        self.write_inputs()
        path = self.write("boxes.txt", "1 1\n" + "0 0 0 5 5 5 1\n" * 9_000_000)
        self.assert_bad_layout(path, "boxes.txt:20002: too many boxes; at most 20000 boxes")

    def test_as_many_boxes_as_there_may_be_all_in_one_place(self):
        self.write_inputs()
        path = self.write("boxes.txt", "1 1\n" + "0 0 0 5 5 5 1\n" * 20_000)
        self.assert_bad_layout(path, "boxes.txt:3: box 2 overlaps box 1")

    def test_a_folder_of_a_million_wrong_lines(self):
        self.write_inputs()
        done = self.check("check", self.write("wrong.txt", "1 1\n" + "0 0 0 5 5 x 1\n" * 1_000_000))
        self.assert_exit(done, 2)
        self.assertLess(len(done.stderr.splitlines()), 30)
        self.assertIn("further errors", done.stderr)


class Values(CliTest):
    def test_numbers_at_the_end_of_their_range(self):
        """What is beyond all use is refused; whatever is accepted, a run ends and every world is reported."""
        self.write_inputs()
        self.layouts = [self.write(f"{name}.txt", f"1 1\n{line} 1\n") for name, line in (
            ("huge", "0 0 0 1e308 50 50"), ("minus_zero", "-0 -0 -0 50 50 50"), ("tiny", "0 0 0 1e-300 1e-300 1e-300"),
            ("flat", "0 0 0 100 100 1e-12"), ("far", "1e307 0 0 1.1e307 50 50"), ("good", "0 0 0 50 50 50"))]
        self.accelerations = [self.write(f"a_{i}.txt", f"{line}\n") for i, line in enumerate((
            "0 0.1 1e308 -1e308 1e308", "-0 0.1 -0 -0 -0", "0 1e-9 5e-324 0 0", "1e308 1 0 0 0", "0 1e300 1 0 0",
            "0 0.1 nan 0 0"))]
        for open_sides in ("", "OpenSides = rear, roof, front\n"):
            with self.subTest(open_sides=open_sides):
                self.config = self.write("config.ini", CONFIG + "[Container]\n" + open_sides)
                path, done = self.screen("--overwrite", expect=1)
                data = datasets(path)
                self.assertEqual(len(data["/worlds/status"]), 36)
                good = data["/worlds/status"].reshape(6, 6)[5]
                self.assertEqual([int(value) for value in good], [2, 0, 0, 2, 2, 2])
                self.assertEqual(data["/worlds/status"].reshape(6, 6)[1, 1], 0)
                self.assertIn("times of at most 1e6 s", done.stderr)

    def test_settings_at_the_end_of_their_range(self):
        self.write_inputs()
        self.layouts = self.layouts[:1]
        accepted = 0
        for section, key in (("Physics Engine", "DensityValue"), ("Physics Engine", "SimulationStepsPerSecond"),
                             ("Simulation Settings", "TimeoutInSeconds"), ("Simulation Settings", "BoxFriction"),
                             ("Simulation Settings", "DropThreshold"), ("Screening", "SettleSeconds"),
                             ("Export Settings", "ResultsIntervallInSeconds"), ("Container", "Length"),
                             ("Material 1", "Mass"), ("Contact", "Restitution")):
            for value in ("1e308", "5e-324", "1e-12", "-0", "nan", "-1", "1e999"):
                with self.subTest(key=key, value=value):
                    base = CONFIG.replace("SimulationStepsPerSecond = 60\n", "") if key.startswith("Simulation") else CONFIG
                    self.config = self.write("config.ini", f"{base}[{section}]\n{key} = {value}\n")
                    done = self.run_here("screen", "-c", self.config, "--layouts", *self.layouts, "--accelerations",
                                         "rest.txt", "-o", "results.h5", "--overwrite", "--quiet")
                    self.assertIn(done.returncode, (0, 1, 2), done.stderr)
                    self.assert_exit(done, done.returncode)
                    accepted += done.returncode != 2
                    if value in ("1e308", "nan", "-1", "1e999"):
                        self.assertIn(f"{key} has a wrong value: {value}; a number from ", done.stderr)
        self.assertGreater(accepted, 10)

    def test_more_samples_than_memory(self):
        self.write_inputs()
        self.config = self.write("config.ini", CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 1e-6\n")
        self.layouts = self.layouts[:1]
        _, done = self.screen(expect=1)
        self.assertIn("rest.txt: would give a world too many samples: 6000000; at most 200000", done.stderr)


class Names(CliTest):
    def test_any_name_of_a_file(self):
        self.write_inputs()
        names = ["two words.txt", "über-größe.txt", "日本.txt", "line\nbreak.txt", "tab\tquote\".txt", "-dash.txt",
                 "$(touch hacked).txt", "a,b;c.txt", "%s%n.txt"]
        self.layouts = [self.write(f"in/{name}", layout_text(SEED)) for name in names]
        strange = os.fsencode(self.folder / "in") + b"/latin-\xe9.txt"
        with open(strange, "wb") as file:
            file.write(layout_text(SEED).encode())
        self.layouts += [strange.decode("utf-8", "surrogateescape"), self.folder / "in/../seed.txt"]
        bad = self.write("in/bad\nname.txt", "1 1\n0 0 0 5 5 x 1\n")
        self.layouts.append(bad)
        before = {path for path in self.folder.rglob("*") if path.is_file()}
        output = "out put/ré\nsults.h5"
        (self.folder / "out put").mkdir()
        path, done = self.screen("--json", "--text", "out put/text", output=output, expect=1)
        self.assertIn("bad?name.txt:2:11: z2 of box 1 is not a number: x", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 3, done.stderr)

        expected = [*names, "latin-\ufffd.txt", "seed.txt", "bad\nname.txt"]
        with h5py.File(path) as file:
            self.assertEqual(list(file["inputs/layouts/name"].asstr()[:]), expected)
        reported = [json.loads(line)["layout"] for line in done.stdout.splitlines()]
        self.assertEqual(reported, [name for name in expected for _ in self.accelerations])
        self.assert_exit(self.run_here("summary", output, "--csv", "out put/tables"), 0)
        table = pd.read_csv(self.folder / "out put/tables/worlds.csv")
        # No text of a CSV is a formula.
        self.assertEqual(list(table["layout"]), ["'" + name if name[0] in "=+-@" else name for name in reported])

        # Nothing was written anywhere but where it was asked for.
        after = {path for path in self.folder.rglob("*") if path.is_file()}
        for new in after - before:
            self.assertEqual(new.relative_to(self.folder).parts[0], "out put", new)
        self.assertEqual(len(list((self.folder / "out put/text").iterdir())), 2 * len(reported) + 1)

    def test_a_name_in_the_results_leads_nowhere(self):
        """A results file from elsewhere names its layouts `../x`: the text files stay in their folder all the same."""
        self.write_inputs()
        self.layouts = self.layouts[:1]
        path, _ = self.screen(output="in/../results.h5")
        with h5py.File(path, "r+") as file:
            file["inputs/layouts/name"][...] = b"../x/y.b"[:file["inputs/layouts/name"].dtype.itemsize]
        before = {path for path in self.folder.rglob("*") if path.is_file()}
        _, done = self.screen("--resume", "--text", "text")
        self.assertIn("complete already", done.stderr)
        new = {path for path in self.folder.rglob("*") if path.is_file()} - before
        self.assertEqual({file.parent for file in new}, {self.folder / "text"})


if __name__ == "__main__":
    unittest.main()
