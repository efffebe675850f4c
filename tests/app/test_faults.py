"""Faults from outside: kills at random moments, a second run, a full or read-only disk.

There are more random kills where tests are thorough.
"""
import random
import shutil
import signal
import subprocess
import time
import unittest

import h5py

from cli import CONFIG, HOLDFAST, PATIENCE, SEED, THOROUGH, CliTest, SmallDisk, layout_text, start, wait_for

KILLS = 20 if THOROUGH else 2
LONG_ENOUGH = 1.0  # s of an undisturbed run: several parts, and moments between them


class ManyWorlds(CliTest):
    """A run of many short worlds, so that many parts are finished in little time."""

    def write_many(self, layouts, seconds):
        self.write("config.ini", CONFIG)
        self.write("left.txt", f"0 {seconds:.2f} 6 2 0\n")
        self.write("right.txt", f"0 {seconds:.2f} -6 2 0\n")
        for i in range(layouts):
            self.write(f"layouts/{i:04}.txt", layout_text([(i % 400, 0, 0, i % 400 + 50, 50, 50 + i % 7),
                                                           (i % 400, 60, 0, i % 400 + 50, 99 + i % 11, 50)]))

    @staticmethod
    def arguments(*more):
        return ("screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", "left.txt", "right.txt", *more)

    def safe_worlds(self, output="results.h5"):
        """Worlds in finished parts, every one of which must be readable."""
        count = 0
        for path in sorted(self.folder.glob(f"{output}.parts/part-*.h5")):
            with h5py.File(path) as part:
                for name in ("worlds/layout", "boxes/mass", "series/displacement"):
                    part[name][...]
                count += len(part["worlds/layout"])
        return count


class Kills(ManyWorlds):
    def test_killed_at_random_moments_and_resumed(self):
        seconds, elapsed = 0.5, 0.0
        while elapsed < LONG_ENOUGH:
            self.write_many(1000, seconds)
            begin = time.monotonic()
            self.assert_exit(self.run_here(*self.arguments("-o", "whole.h5", "--overwrite", "--quiet")), 0)
            elapsed = time.monotonic() - begin
            seconds *= max(1.5, LONG_ENOUGH / elapsed)
        whole, results = self.folder / "whole.h5", self.folder / "results.h5"
        moments = random.Random(2024)
        killed, on_the_way, safe = 0, 0, 0
        while killed < KILLS:
            process = start(*self.arguments("--quiet", "--resume" if safe else "--overwrite"), cwd=self.folder)
            time.sleep(moments.uniform(0.0, 1.1 * elapsed))
            process.kill()
            said = process.communicate()[1]
            self.assertIn(process.returncode, (0, -signal.SIGKILL), said)
            killed += process.returncode != 0
            if results.exists():  # it came to its end; a kill may still have left parts behind
                self.assert_exit(self.run_here(*self.arguments("--resume", "--quiet")), 0)
                self.assert_same_results(whole, results)
                safe = 0
            else:
                now = self.safe_worlds()
                self.assertGreaterEqual(now, safe, "nothing that was safe is lost")
                on_the_way += now > 0
                safe = now
        self.assert_exit(self.run_here(*self.arguments("--quiet", "--resume" if safe else "--overwrite")), 0)
        self.assert_same_results(whole, results)
        self.assertFalse((self.folder / "results.h5.parts").exists())
        self.assertFalse((self.folder / "results.h5.tmp").exists())
        print(f"{killed} kills of a run of {elapsed:.1f} s, {on_the_way} of them between the first part and the end")



class Streams(ManyWorlds):
    """What is said of a run is worth less than its results."""

    def test_a_reader_that_pauses_keeps_nothing_from_being_safe(self):
        self.write_many(1000, 0.5)
        process = start(*self.arguments("-o", "results.h5", "--json"), cwd=self.folder, stderr=subprocess.DEVNULL)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        wait_for(lambda: self.safe_worlds() > 0, process)
        process.terminate()
        # Not communicate(), which would read.
        self.assertEqual(process.wait(PATIENCE), 143)

    def test_streams_that_cannot_be_written(self):
        self.write_many(1, 0.5)
        for stdout, stderr, code in (("/dev/null", "/dev/full", 0), ("/dev/full", "/dev/null", 1)):
            with self.subTest(stdout=stdout, stderr=stderr), open(stdout, "w") as out, open(stderr, "w") as err:
                done = subprocess.run([HOLDFAST, *self.arguments("-o", "results.h5", "--json", "--overwrite")],
                                      stdout=out, stderr=err, cwd=self.folder, timeout=PATIENCE, check=False)
                self.assertEqual(done.returncode, code)
        closed = subprocess.run(f"'{HOLDFAST}' {' '.join(self.arguments('-o', 'closed.h5', '--json'))} >&- 2>&-",
                                shell=True, cwd=self.folder, timeout=PATIENCE, check=False)
        self.assertEqual(closed.returncode, 1, "as for a full device")
        self.assert_exit(self.run_here("summary", "closed.h5"), 0)


class TwoRuns(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 5\n")
        self.write("short.txt", "0 0.1 1 0 0\n")
        self.write("zzz_endless.txt", "0 100000 1 0 0\n")
        self.write("seed.txt", layout_text(SEED))

    @staticmethod
    def arguments(*more):
        return ("screen", "-c", "config.ini", "--layouts", "seed.txt", "--accelerations", "short.txt",
                "zzz_endless.txt", "--quiet", *more)

    def test_a_second_run_into_the_same_output_is_refused(self):
        process = start(*self.arguments(), cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        part = self.folder / "results.h5.parts/part-000001.h5"
        wait_for(part.exists, process)
        before = part.read_bytes()
        for more in ((), ("--resume",), ("--overwrite",), ("-o", "./results.h5")):
            with self.subTest(more=more):
                done = self.run_here(*self.arguments(*more))
                self.assert_refused(done, "results.h5: is being written by another run")
                self.assertIsNone(process.poll())
                self.assertEqual(part.read_bytes(), before)
        done = self.run_here("summary", part)
        self.assert_exit(done, 0)

        # The lock goes with its process, however that ends.
        process.kill()
        process.wait()
        process = start(*self.arguments("--resume"), cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        time.sleep(0.5)
        self.assertIsNone(process.poll())
        process.terminate()
        self.assertEqual(process.wait(PATIENCE), 143)
        self.assertEqual(part.read_bytes(), before)

    def test_two_outputs_in_one_folder_are_fine(self):
        process = start(*self.arguments("-o", "one.h5"), cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        wait_for((self.folder / "one.h5.parts/part-000001.h5").exists, process)
        done = self.run_here("screen", "-c", "config.ini", "--layouts", "seed.txt", "--accelerations", "short.txt",
                             "-o", "two.h5")
        self.assert_exit(done, 0)
        self.assertIsNone(process.poll())


class LostParts(ManyWorlds):
    def test_a_folder_of_parts_that_is_gone_is_not_called_safe(self):
        self.write_many(1, 0.1)
        self.write("long.txt", "0 12000 1 0 0\n")
        process = start("screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", "left.txt", "long.txt",
                        "--no-series", "--json", cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.assertIn("left.txt", process.stdout.readline())
        shutil.rmtree(self.folder / "results.h5.parts")  # before the open part is closed, which takes it two seconds
        self.assertEqual(process.wait(PATIENCE), 1)
        said = process.stderr.read()
        self.assertIn("results.h5.parts is gone, and with it all worlds; the same command without --resume starts anew", said)
        self.assertNotIn("safe", said)


class FullDisk(SmallDisk, ManyWorlds):
    def test_a_full_disk_is_told_and_the_run_goes_on_when_there_is_room(self):
        self.write_many(700, 0.5)
        self.assert_exit(self.run_here(*self.arguments("-o", "whole.h5", "--quiet")), 0)
        whole = (self.folder / "whole.h5").stat().st_size
        self.remount(f"size={whole // 2}")
        done = self.run_here(*self.arguments("-o", "disk/results.h5"))
        self.assert_exit(done, 1)
        self.assertIn("No space left on device", done.stderr)
        safe = self.safe_worlds("disk/results.h5")
        self.assertTrue(0 < safe < 1400, safe)
        self.assertIn(f"{safe} of 1400 worlds are safe in disk/results.h5.parts; --resume continues from there", done.stderr)
        self.assertFalse(list(self.disk.glob("**/*.tmp")))

        # Room for the parts, and not for the file that they become.
        self.remount(f"size={whole * 2}")
        done = self.run_here(*self.arguments("-o", "disk/results.h5", "--resume"))
        self.assert_exit(done, 1)
        self.assertIn("No space left on device", done.stderr)
        self.assertIn("--resume", done.stderr)
        self.assertFalse((self.disk / "results.h5").exists())

        self.remount("size=64m")
        self.assert_exit(self.run_here(*self.arguments("-o", "disk/results.h5", "--resume", "--quiet")), 0)
        self.assert_same_results(self.folder / "whole.h5", self.disk / "results.h5")
        self.assertEqual([path.name for path in self.disk.iterdir()], ["results.h5"])

    def test_a_read_only_place_is_told_at_once(self):
        self.write_many(1, 0.1)
        self.remount("ro")
        done = self.run_here(*self.arguments("-o", "disk/results.h5"))
        self.assert_refused(done, "disk/results.h5.parts: cannot be created", "Read-only file system")


if __name__ == "__main__":
    unittest.main()
