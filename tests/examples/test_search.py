"""examples/search, the search in C++, for a few generations."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from loading import ACCELERATIONS, INSTANCES, LoadingTest, output_of

PROGRAM = os.environ["LOADING_SEARCH"]
HOLDFAST = os.environ["HOLDFAST"]


def search(problem, *options):
    """Output of a search of so few loadings that it takes a second or two: rows of the table, and the two lines below."""
    lines = output_of(PROGRAM, INSTANCES, problem, *ACCELERATIONS, "--population", 10, "--generations", 6, *options)
    return [line.split() for line in lines[1:-2]], lines[-2:]


class SearchTest(LoadingTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="holdfast_search_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check_found(self, problem, last_line):
        """The layouts written are loadings of the instance, and what is said of them is true."""
        said = [word.rstrip(";") for word in last_line.split() if word[0].isdigit()]
        for name, fill in zip(("fullest.txt", "fullest_that_holds.txt"), said, strict=True):
            path = self.folder / name
            self.assertEqual(f"{self.check_geometry(path, support=0.75):.4f}", fill)
            self.check_types(path, problem)
        self.check_holds(self.folder / "fullest_that_holds.txt")

    def test_check_in_the_loop_finds_a_loading_that_holds(self):
        rows, (_, found) = search(1, "--seed", 3, "--out", self.folder)
        self.check_found(1, found)
        holding = [float(row[-1]) for row in rows]
        self.assertEqual(holding, sorted(holding))  # it never gets worse

    def test_check_afterwards_finds_a_loading_that_holds(self):
        rows, (_, found) = search(1, "--out", self.folder, "--check", "after")
        self.check_found(1, found)
        self.assertEqual({row[3] for row in rows[:-1]}, {"0"})  # nothing is checked before the end

    def test_threads_do_not_change_a_search(self):
        for when in ("loop", "after"):
            one, two = (search(1, "--check", when, "--threads", threads, "--seed", 3) for threads in (1, 2))
            self.assertEqual([row[1:] for row in one[0]], [row[1:] for row in two[0]])  # without the seconds
            self.assertEqual(one[1][1], two[1][1])

    def test_seed_changes_a_search(self):
        self.assertNotEqual(search(1, "--seed", 4)[1][1], search(1, "--seed", 5)[1][1])

    def test_masses_of_a_problem_are_those_of_the_loading(self):
        # In the form of OR-Library's wtpack files, after Ratcliff and Bischoff (1998).
        types = {1: "108 0 76 0 30 1 40 123.4", 2: "110 0 43 0 25 1 33 40.5", 3: "92 1 81 1 55 1 39 61"}
        path = self.folder / "wtpack.txt"
        path.write_text("587 233 220\n1 1.5\n50 1 50 1 50 1 12 9 0.2 0.1 0.1\n587 233 220\n3 28.5\n" +
                        "".join(f"{each} 0.19527 0.18970 0.14661\n" for each in types.values()))
        words = (*ACCELERATIONS, "--population", 10, "--generations", 6, "--out", self.folder)
        output_of(PROGRAM, path, 2, *words)
        found = self.folder / "fullest.txt"
        rows = [line.split() for line in found.read_text().splitlines()[1:]]
        masses = {kind: float(words.split()[7]) for kind, words in types.items()}
        for row in rows:
            self.assertEqual(float(row[7]), masses[int(row[6])])
        total = sum(float(row[7]) for row in rows)
        said, = output_of(HOLDFAST, "check", found)
        self.assertIn(f"{len(rows)} boxes, {total:g} kg", said)
        result = subprocess.run([PROGRAM, path, "3", *map(str, ACCELERATIONS)], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (1, f"{path}: no problem 3\n"))

    def test_mistakes_are_named(self):
        for words, message in (
                ([INSTANCES, 16, *ACCELERATIONS], f"{INSTANCES}: no problem 16; there are 1 to 15"),
                ([INSTANCES, 1], "a file of instances, a problem and at least one acceleration are needed"),
                ([INSTANCES, 1, *ACCELERATIONS, "--seed", "-1"], "--seed: '-1' is no number from 0"),
                ([INSTANCES, 1, *ACCELERATIONS, "--check", "never"], "--check is 'loop' or 'after', not 'never'"),
                ([INSTANCES, 1, INSTANCES], "15")):
            result = subprocess.run([str(word) for word in [PROGRAM, *words]], capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, 1)
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
