"""examples/search_deap.py, the search in Python with DEAP, for a few generations."""
import pathlib
import sys
import tempfile
import unittest

from loading import ACCELERATIONS, INSTANCES, SOURCE, LoadingTest, output_of


class DeapSearchTest(LoadingTest):
    def test_it_finds_a_loading_that_holds_with_any_number_of_threads(self):
        found = []
        with tempfile.TemporaryDirectory(prefix="holdfast_deap_") as folder:
            for threads in (1, 2):
                path = pathlib.Path(folder) / f"{threads}.txt"
                lines = output_of(sys.executable, SOURCE / "examples/search_deap.py", INSTANCES, 1, *ACCELERATIONS,
                                  "--generations", 3, "--population", 12, "--threads", threads, "-o", path)
                fill = self.check_geometry(path, support=1.0)
                self.check_types(path, 1)
                self.assertTrue(lines[-1].endswith(f"fullest that holds: {fill:.4f}"), lines[-1])
                found.append((lines[:-1], path.read_text(encoding="ascii")))
            self.check_holds(path)
        self.assertEqual(*found)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
