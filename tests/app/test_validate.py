"""`holdfast validate` from outside: choice of cases, JSON, report, bounds. The quick suite itself is a test of its own."""
import json
import pathlib
import signal
import subprocess
import tempfile
import unittest

import pandas as pd

from cli import HOLDFAST, SOURCE, run, start

MEMBERS = {"case", "engine", "setting", "metric", "value", "expected", "error", "tolerance", "pass", "cpu_seconds"}


class Validate(unittest.TestCase):
    def test_json_lists_the_measurements_of_the_choice(self):
        done = run("validate", "--quick", "--suite", "slide", "--engine", "bullet", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = json.loads(done.stdout)
        self.assertGreater(len(rows), 10)
        for row in rows:
            self.assertLessEqual(MEMBERS, row.keys())
            self.assertEqual((row["engine"], row["suite"]), ("bullet", "slide"))
            self.assertEqual(row["pass"], row["error"] is not None and row["error"] <= row["tolerance"])

    def test_one_case_is_printed_with_its_numbers(self):
        done = run("validate", "--quick", "--case", "slide_path", "--engine", "bullet")
        self.assertEqual(done.returncode, 0, done.stderr)
        # The first-order path of Bullet: longer by h/t.
        self.assertIn("slide_path, displacement (m): -1.23136, expected -1.22625", done.stdout)

    def test_the_result_does_not_depend_on_threads(self):
        def measured(threads):
            done = run("validate", "--quick", "--suite", "slide,tip", "--threads", threads, "--json")
            return [{key: value for key, value in row.items() if key != "cpu_seconds"} for row in json.loads(done.stdout)]

        self.assertEqual(measured(1), measured(2))

    def test_loads_are_compared_with_native_at_reference(self):
        with tempfile.TemporaryDirectory() as folder:
            layout = pathlib.Path(folder, "two.txt")
            layout.write_text("1 2\n0 0 0 60 80 50 1\n60 0 0 120 80 50 1\n")
            done = run("validate", "--engine", "native", "--suite", "load", "--layouts", layout, "--json")
            rows = json.loads(done.stdout)
            self.assertEqual({row["case"] for row in rows}, {"second_reference", "real_loads"})
            self.assertEqual({row["setting"] for row in rows}, {"960 Hz, 200 it", "standard", "screening"})
            # Two boxes on the floor slide as they must at every accuracy.
            for row in rows:
                if "displacement error" in row["metric"]:
                    self.assertLess(row["error"], 1e-3, row)

    def test_report_stands_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run("validate", "--quick", "--suite", "slide,tip", "-o", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            page = pathlib.Path(folder, "index.html").read_text()
            self.assertIn("slide_path", page)
            self.assertIn("<svg", page)
            for link in ("src=", "href=\"http", "@import"):
                self.assertNotIn(link, page)
            table = pd.read_csv(pathlib.Path(folder, "measurements.csv"))
            self.assertEqual(len(table), len(json.loads(pathlib.Path(folder, "measurements.json").read_text())))

    def test_report_says_where_a_device_is_worse(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            done = run("validate", "--quick", "--case", "slide_path", "--engine", "bullet", "-o", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("On a device", (folder / "index.html").read_text())
            # Bullet's own numbers as those of a device, one of them three times as large.
            rows = pd.read_csv(folder / "measurements.csv")
            rows = rows[rows["setting"] == "240 Hz, 50 it"]
            device = rows.assign(engine="bullet-opencl", setting="240 Hz, 20 it")
            self.assertEqual(device["metric"].iloc[0], "displacement (m)")
            device.loc[device.index[0], "error"] *= 3
            pd.concat([rows, device]).to_csv(folder / "measurements.csv", index=False)
            script = SOURCE / "tools/validation_report.py"
            subprocess.run(["/usr/bin/python3", script, folder], check=True)
            page = (folder / "index.html").read_text()
            section = page[page.index("On a device"):page.index("<h2>Thresholds")]
            self.assertIn("<summary>1 of them</summary>", section)
            self.assertIn("displacement (m)", section)
            self.assertNotIn("velocity (m/s)", section)

    def test_an_error_above_its_bound_fails_and_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            bounds = pathlib.Path(folder, "bounds.tsv")
            choice = ("validate", "--quick", "--case", "slide_path", "--engine", "bullet")
            self.assertEqual(run(*choice, "--record-bounds", bounds).returncode, 0)
            self.assertEqual(run(*choice, "--bounds", bounds).returncode, 0)
            lines = bounds.read_text().splitlines()
            bounds.write_text("\n".join(line.rsplit("\t", 1)[0] + "\t1e-9" if "displacement" in line else line
                                        for line in lines) + "\n")
            done = run(*choice, "--bounds", bounds)
            self.assertEqual(done.returncode, 1)
            self.assertIn("slide_path, displacement (m): error 0.00417, bound 1e-09", done.stderr)

    def test_bounds_are_recorded_over_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            layout = pathlib.Path(folder, "layout.txt")
            layout.write_text("1 1\n0 0 0 80 60 100 1\n")
            for path, words in ((layout, "is a file of another kind"), (folder, "is a folder"), ("/dev/null", "is not a regular file"),
                                (pathlib.Path(folder, "none/bounds.tsv"), "cannot be written")):
                with self.subTest(path=path):
                    done = run("validate", "--case", "slide_path", "--engine", "bullet", "--record-bounds", path)
                    self.assertEqual((done.returncode, done.stdout), (2, ""))
                    self.assertRegex(done.stderr, rf"\A{path}: {words}[^\n]*\n\Z")
            self.assertEqual(layout.read_text(), "1 1\n0 0 0 80 60 100 1\n")

    def test_a_full_standard_output_is_noticed(self):
        with open("/dev/full", "w") as full:
            # More than the stream's buffer takes.
            done = subprocess.run([HOLDFAST, "validate", "--quick", "--suite", "slide", "--engine", "bullet", "--json"],
                                  stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard output: cannot be written", done.stderr)

    def test_unknown_names_are_said_with_what_was_meant(self):
        for arguments, said in ((("--suite", "slid"), "did you mean 'slide'"), (("--case", "slide_pat"), "slide_path"),
                                (("--engine", "bulet"), "did you mean 'bullet'")):
            done = run("validate", "--quick", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)

    def test_interrupted_keeps_nothing_and_says_so(self):
        process = start("validate", "--suite", "hard", "--threads", "1")
        try:
            process.wait(timeout=1.5)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn("stopped", said)


if __name__ == "__main__":
    unittest.main()
