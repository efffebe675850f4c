"""examples/cluster/dask_screen.py: the verdicts of worker processes are those of this one."""
import pathlib
import subprocess
import sys
import unittest

import holdfast

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LAYOUTS = SOURCE / "configs/layouts"


class DaskExample(unittest.TestCase):
    def test_workers_give_the_same_verdicts(self):
        done = subprocess.run([sys.executable, SOURCE / "examples/cluster/dask_screen.py", LAYOUTS, "--workers", "2", "--block", "4"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        paths = sorted(LAYOUTS.glob("*.txt"))
        with holdfast.Screen(norm="road", accuracy="screening") as screen:
            verdicts = screen.evaluate([screen.read_layout(str(path)) for path in paths])
        holds = (verdicts.verdict == holdfast.Verdict.STAYED).all(axis=1)
        self.assertTrue(0 < holds.sum() < len(paths))
        expected = [f"{'holds' if good else 'fails'}  {path.name}" for path, good in zip(paths, holds)]
        self.assertEqual(done.stdout.splitlines(), [*expected, f"{holds.sum()} of {len(paths)} layouts hold"])


if __name__ == "__main__":
    unittest.main()
