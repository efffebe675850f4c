"""`holdfast-mpi`: the same file as `holdfast screen`, by any number of ranks, whichever of them are killed.

There are more random kills where tests are thorough.
"""
import os
import random
import signal
import subprocess
import time
import unittest

from cli import CONFIG, PATIENCE, THOROUGH, SmallDisk, some
from test_shards import ShardTest

KILLS = 20 if THOROUGH else 1
PROGRAM = os.environ["HOLDFAST_MPI"]
# A rank per core is not asked for, nor is another user than root.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}


class MpiTest(ShardTest):
    def command(self, ranks, *arguments):
        return ["mpirun", "-n", str(ranks), PROGRAM, *map(str, arguments)]

    def running_ranks(self):
        """Processes of the ranks of this test."""
        def is_rank(pid):
            try:
                return os.readlink(f"/proc/{pid}/exe") == os.path.realpath(PROGRAM) and os.readlink(f"/proc/{pid}/cwd") == str(self.folder)
            except OSError:  # it has ended
                return False

        return [int(pid) for pid in os.listdir("/proc") if pid.isdigit() and is_rank(pid)]

    def run_ranks(self, ranks, *arguments):
        return subprocess.run(self.command(ranks, *arguments), cwd=self.folder, env=ENVIRONMENT, capture_output=True,
                              text=True, timeout=PATIENCE, stdin=subprocess.DEVNULL, check=False)


class Ranks(MpiTest):
    def test_any_number_of_ranks_writes_the_file_of_one_process(self):
        whole = self.screen(output="whole.h5")
        for ranks in some((1, 3, 2, 7), 2):
            with self.subTest(ranks=ranks):
                done = self.run_ranks(ranks, *self.arguments, "--threads", 1, "-o", "results.h5", "--overwrite")
                self.assertEqual(done.returncode, 1, done.stderr)  # one layout is bad
                self.assert_same_file(whole, self.folder / "results.h5")
                self.assertFalse((self.folder / "results.h5.shards").exists())

    def test_what_is_there_is_kept_and_what_is_wrong_is_said_once(self):
        (self.folder / "results.h5.shards").mkdir()
        done = self.run_ranks(3, *self.arguments)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("results.h5.shards: contains shards of an interrupted run"), 1, done.stderr)
        (self.folder / "results.h5.shards").rmdir()
        self.write("results.h5", "mine\n")
        done = self.run_ranks(2, *self.arguments)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("exists already"), 1)
        done = self.run_ranks(2, *self.arguments, "--overwrite")
        self.assertEqual(done.returncode, 2)
        self.assertEqual((self.folder / "results.h5").read_text(), "mine\n")
        self.assertIn("leave out --part", self.run_ranks(2, *self.arguments, "-o", "other.h5", "--part", "1/2").stderr)
        done = self.run_ranks(2, "validate")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("is no command of holdfast-mpi"), 1)


class KilledRanks(MpiTest):
    layouts = 900 if THOROUGH else 300

    def test_killed_ranks_cost_what_they_had_open(self):
        self.write("config.ini", CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 5\n")
        self.write("push.txt", "0 20 0 1 0\n")
        self.arguments = ["screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", "push.txt", "rest.txt",
                          "--quiet", "--threads", 1]
        whole = self.screen(output="whole.h5")
        draw = random.Random(5)
        killed = 0
        while killed < KILLS:
            process = subprocess.Popen(self.command(3, *self.arguments, "-o", "results.h5", "--resume"), cwd=self.folder,
                                       env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(draw.uniform(0.6, 1.4))
            ranks = self.running_ranks()
            if ranks:
                os.kill(draw.choice(ranks), signal.SIGKILL)
            process.wait(PATIENCE)
            killed += process.returncode not in (0, 1)
            if (self.folder / "results.h5").exists():  # it came to its end
                self.assert_same_file(whole, self.folder / "results.h5")
                (self.folder / "results.h5").unlink()
        done = self.run_ranks(2, *self.arguments, "-o", "results.h5", "--resume")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assert_same_file(whole, self.folder / "results.h5")
        print(f"{killed} kills of ranks")


class FullDisk(SmallDisk, MpiTest):
    def test_ranks_end_and_go_on_when_there_is_room(self):
        whole = self.screen(output="whole.h5")
        # Too little for any of the five shards: each rank tries one.
        self.remount(f"size={whole.stat().st_size // 10}")
        done = self.run_ranks(2, *self.arguments, "--threads", 1, "-o", "disk/results.h5")
        self.assertEqual(done.returncode, 1)
        self.assertIn(done.stderr.count("No space left on device"), (1, 2), done.stderr)
        self.assertIn("are in disk/results.h5.shards; the same command with --resume continues", done.stderr)
        self.assertFalse((self.disk / "results.h5").exists())
        self.remount("size=64m")
        done = self.run_ranks(3, *self.arguments, "--threads", 1, "-o", "disk/results.h5", "--resume")
        self.assertEqual(done.returncode, 1, done.stderr)  # one layout is bad
        self.assert_same_file(whole, self.disk / "results.h5")
        self.assertEqual([path.name for path in self.disk.iterdir()], ["results.h5"])


if __name__ == "__main__":
    unittest.main()
