"""tools/same_results.py: one program twice is the same, and what has changed is found and named."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

from cli import HOLDFAST, PATIENCE, SOURCE, CliTest


def guard(*arguments, **options):
    return subprocess.run([sys.executable, SOURCE / "tools/same_results.py", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          encoding="utf-8", timeout=PATIENCE, check=False, **options)


class SameResults(CliTest):
    @classmethod
    def setUpClass(cls):
        cls.before = pathlib.Path(tempfile.mkdtemp(prefix="holdfast-"))
        cls.addClassCleanup(shutil.rmtree, cls.before)
        listed = guard("list", HOLDFAST, "--only", "axes", "--only", "refusal*", "--output", cls.before)
        assert listed.returncode == 0, listed.stderr

    def guard(self, *arguments, code=0):
        done = guard(*arguments, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def copy(self):
        """The runs of a copy of the listing, to be changed."""
        shutil.copytree(self.before, self.folder / "after")
        return self.folder / "after/runs"

    def differences(self):
        return self.guard("compare", self.before, "after", code=1).stdout.splitlines()

    def test_a_program_is_the_same_as_its_listing_with_other_threads(self):
        said = self.guard("compare", self.before, HOLDFAST, "--threads", 2).stdout
        self.assertRegex(said, r"^same: 2 results files, \d+ datasets, 6 worlds' state hashes\n$")

    def test_lines_alone_name_what_differs(self):
        lines = (self.before / "listing.txt").read_text()
        place = "axes\tresults.h5\t/worlds/steps\tdataset, <u8"
        self.assertIn(place, lines)
        self.write("lines.txt", lines.replace(place, place.replace("<u8", "<u4")))
        self.assertRegex(self.guard("compare", "lines.txt", self.before, code=1).stdout,
                         r"^dataset /worlds/steps of results.h5 of run axes: dataset, <u4.* \| dataset, <u8.*\n$")

    def test_changed_results_are_named(self):
        with h5py.File(self.copy() / "axes/results.h5", "r+") as file:
            file["worlds/steps"][3] = file["worlds/steps"][3] + 1
            file["worlds/cpu_seconds"][0] = 1000
            file["worlds"].attrs["colour"] = 3
            file.attrs.modify("engine", "none")
            file.attrs.modify("host", "another")
            del file["summary/boxes/tilted"]
        with h5py.File(self.before / "runs/axes/results.h5") as file:
            steps = int(file["worlds/steps"][3])
        place = "of results.h5 of run axes"
        expected = {f"dataset /summary/boxes/tilted {place}: only on the left", f"attribute /worlds@colour {place}: only on the right",
                    f"attribute /@engine {place}: native, none", f"dataset /worlds/steps {place}: differs at entry 3: {steps}, {steps + 1}",
                    f"group /summary/boxes {place}: group of 6 | group of 5"}
        self.assertEqual({line for line in self.differences() if not line.startswith("size")}, expected)

    def test_changed_texts_are_named(self):
        runs = self.copy()
        (runs / "refusals/commands.txt").unlink()
        page = runs / "refusals/2_screen.err.txt"
        page.write_text(page.read_text().replace("road", "load", 1))
        table = runs / "axes/tables/worlds.csv"
        table.write_text(table.read_text().replace("sleeping", "timeout", 1))
        gone, of_table, of_page = self.differences()
        self.assertEqual(gone, "commands.txt of run refusals: only on the left")
        self.assertRegex(of_table, r"^tables/worlds.csv of run axes: line 2: .*sleeping.* \| .*timeout")
        self.assertRegex(of_page, r"^2_screen.err.txt of run refusals: line 1: unknown norm: .*road.* \| .*load")

    def test_what_cannot_be_used_is_said_in_a_line(self):
        for arguments in (("list", "none"), ("compare", "none", self.before), ("list", HOLDFAST, "--only", "none")):
            done = self.guard(*arguments, code=1)
            self.assertEqual((done.stdout, len(done.stderr.splitlines())), ("", 1), done.stderr)


if __name__ == "__main__":
    unittest.main()
