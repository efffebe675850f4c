"""Runs that are killed, stopped or out of disk, and go on with `--resume`."""
import json
import pathlib
import re
import resource
import shutil
import signal
import tempfile
import time
import unittest

import h5py

from cli import CONFIG, PATIENCE, SEED, CliTest, layout_text, run, schedulers, start, wait_for

LONG_ENOUGH = 3.5  # s, so that a part is finished, which takes 2 s, well before the run is
ENDLESS = "0 100000 1 0 0\n"
SPARSE = CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 5\n"


class LongRun(CliTest):
    """A run of some seconds, killed once: every test starts from a copy of what the kill left."""

    @classmethod
    def setUpClass(cls):
        cls.common = pathlib.Path(tempfile.mkdtemp(prefix="holdfast-"))
        cls.addClassCleanup(shutil.rmtree, cls.common)
        inputs = cls.common / "inputs"
        (inputs / "layouts").mkdir(parents=True)
        (inputs / "config.ini").write_text(SPARSE)
        (inputs / "short.txt").write_text("0 0.5 0 1 0\n")
        for i in range(24):
            boxes = [(x + i, y, z, X + i, Y, Z) for x, y, z, X, Y, Z in SEED]
            (inputs / f"layouts/layout{i:02}.txt").write_text(layout_text(boxes))
        simulated, elapsed = 100.0, 0.0
        while elapsed < LONG_ENOUGH:
            simulated *= 1.3 * LONG_ENOUGH / elapsed if elapsed else 1.0
            (inputs / "long.txt").write_text(f"0 {simulated:.0f} 1 0 0\n")
            begin = time.monotonic()
            whole = run(*cls.arguments(), "--threads", 1, "-o", "../whole.h5", "--overwrite", cwd=inputs)
            elapsed = time.monotonic() - begin
            assert whole.returncode == 0, whole.stderr
        process = start(*cls.arguments(), "--threads", 1, cwd=inputs)
        try:
            wait_for((inputs / "results.h5.parts/part-000001.h5").exists, process)
        finally:
            process.kill()
            process.communicate()
        with h5py.File(inputs / "results.h5.parts/part-000001.h5") as part:
            cls.safe_worlds = len(part["worlds/layout"])

    @staticmethod
    def arguments():
        return ("screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", "long.txt", "short.txt")

    def setUp(self):
        super().setUp()
        shutil.copytree(self.common / "inputs", self.folder, dirs_exist_ok=True)

    def parts(self):
        return sorted(path.name for path in self.folder.glob("results.h5.parts/part-*"))

    def test_a_killed_run_is_resumed(self):
        self.assertFalse((self.folder / "results.h5").exists())
        self.assertGreater(self.safe_worlds, 0)
        done = self.run_here(*self.arguments(), "--resume", "--threads", 1)
        self.assert_exit(done, 0)
        self.assertIn(f"{self.safe_worlds} finished before", done.stderr)
        self.assert_same_results(self.common / "whole.h5", self.folder / "results.h5")
        self.assertFalse((self.folder / "results.h5.parts").exists())

        done = self.run_here(*self.arguments(), "--resume")
        self.assert_exit(done, 0)
        self.assertIn("complete already", done.stderr)
        self.write("short.txt", "0 0.5 0 2 0\n")
        self.assert_refused(self.run_here(*self.arguments(), "--resume"), "results.h5", "is of a run with other accelerations")

    def test_json_tells_of_all_worlds(self):
        def reported(done):
            self.assert_exit(done, 0)
            worlds = [json.loads(line) for line in done.stdout.splitlines()]
            for world in worlds:
                self.assertGreater(world.pop("cpu_seconds"), 0)
            return worlds

        resumed = reported(self.run_here(*self.arguments(), "--resume", "--json"))
        self.assertEqual([world["world"] for world in resumed], list(range(48)))
        again = reported(self.run_here(*self.arguments(), "--resume", "--json"))
        self.assertEqual(again, resumed)
        anew = reported(self.run_here(*self.arguments(), "--overwrite", "--json"))
        self.assertEqual(anew, resumed)

    def test_with_other_threads_and_scheduler(self):
        done = self.run_here(*self.arguments(), "--resume", "--threads", 3, "--scheduler", schedulers()[-2], "--quiet")
        self.assert_exit(done, 0)
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        self.assert_same_results(self.common / "whole.h5", self.folder / "results.h5")

    def test_changed_inputs_are_refused(self):
        for name, old, new, said in (("layouts/layout00.txt", "106", "105", "layout00.txt: this layout has changed"),
                                     ("layouts/layout23.txt", "106", "105", "layout23.txt: this layout has changed"),
                                     ("long.txt", " 1 0 0", " 2 0 0", "is of a run with other accelerations"),
                                     ("config.ini", "= 60", "= 61", "is of a run with other settings")):
            with self.subTest(changed=name):
                text = (self.folder / name).read_text()
                self.write(name, text.replace(old, new))
                self.assert_refused(self.run_here(*self.arguments(), "--resume"), said)
                self.write(name, text)
        with self.subTest(changed="removed, and not yet come to"):
            self.assertLess(self.safe_worlds, 2 * 23)
            (self.folder / "layouts/layout23.txt").rename(self.folder / "away.txt")
            (self.folder / "layouts/layout23.txt").symlink_to("layout22.txt")
            self.assert_refused(self.run_here(*self.arguments(), "--resume"), "layout23.txt: this layout has changed")
            (self.folder / "away.txt").rename(self.folder / "layouts/layout23.txt")
        with self.subTest(changed="option"):
            self.assert_refused(self.run_here(*self.arguments(), "--resume", "--no-series"), "is of a run with other series")
        self.assertIn("part-000001.h5", self.parts())

    def test_parts_of_an_earlier_version_are_refused(self):
        part = self.folder / "results.h5.parts/part-000001.h5"
        with h5py.File(part, "r+") as file:
            del file["summary/worlds/verdict"]
            file.attrs["software"] = "holdfast 0.0.9"
            file.attrs["fingerprint"] = re.sub("software=[0-9a-f]*", "software=" + 64 * "0", file.attrs["fingerprint"])
        self.assert_refused(self.run_here(*self.arguments(), "--resume"), "is of a run with other software: by holdfast 0.0.9",
                            "--overwrite starts anew")

    def test_nothing_to_resume_is_reported(self):
        shutil.rmtree(self.folder / "results.h5.parts")
        arguments = ("screen", "-c", "config.ini", "--layouts", "layouts/layout00.txt", "--accelerations", "short.txt")
        done = self.run_here(*arguments, "--resume")
        self.assert_exit(done, 0)
        self.assertEqual(done.stderr.splitlines()[0],
                         "results.h5: nothing is finished that could be resumed, all worlds are to be run")
        self.assertNotIn("nothing is finished", self.run_here(*arguments, "--resume").stderr)

    def test_parts_are_not_lost_by_accident(self):
        before = self.parts()
        self.assert_refused(self.run_here(*self.arguments()), "results.h5.parts", "--resume", "--overwrite")
        self.assertEqual(self.parts(), before)

    def test_a_part_can_be_read_and_is_called_one(self):
        done = self.run_here("summary", "results.h5.parts/part-000001.h5")
        self.assert_exit(done, 0)
        self.assertIn("warning: results.h5.parts/part-000001.h5: is a part of an unfinished run", done.stderr)
        self.assertIn("--resume", done.stderr)

    def test_interrupt_keeps_what_finished(self):
        shutil.rmtree(self.folder / "results.h5.parts")
        process = start(*self.arguments(), "--threads", 1, "--json", cwd=self.folder)
        for _ in range(3):
            process.stdout.readline()
        process.send_signal(signal.SIGINT)
        # Not communicate(), which does not see lines that readline() has taken into its buffer.
        out, said = process.stdout.read(), process.stderr.read()
        self.assertEqual(process.wait(timeout=PATIENCE), 130, said)
        self.assertIn("stopping: finishing the worlds in flight; press Ctrl-C again to drop them", said)
        finished = 3 + len(out.splitlines())
        self.assertIn(f"stopped after {finished} of 48 worlds", said)
        self.assertIn("--resume", said)
        done = self.run_here(*self.arguments(), "--resume", "--threads", 2)
        self.assert_exit(done, 0)
        self.assertIn(f"{finished} finished before", done.stderr)
        self.assert_same_results(self.common / "whole.h5", self.folder / "results.h5")


class Signals(CliTest):
    """A run whose second world would last for hours."""

    def setUp(self):
        super().setUp()
        self.write("config.ini", SPARSE)
        self.write("a_short.txt", "0 0.1 1 0 0\n")
        self.write("b_endless.txt", ENDLESS)
        self.write("seed.txt", layout_text(SEED))

    def start_endless(self):
        process = start("screen", "-c", "config.ini", "--layouts", "seed.txt", "--accelerations", "a_short.txt",
                        "b_endless.txt", "--json", cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def assert_ended(self, process, code):
        _, said = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, code, said)
        self.assertIn(" of 2 worlds", said)
        self.assertIn("--resume", said)
        self.assertFalse(list(self.folder.glob("results.h5.parts/*.tmp")))
        self.assertFalse(list(self.folder.glob("results.h5.parts/lock")))

    def test_a_second_interrupt_drops_what_is_in_flight(self):
        process = self.start_endless()
        self.assertIn("worlds", process.stderr.readline())
        self.assertIn("a_short.txt", process.stdout.readline())
        time.sleep(0.3)  # so that the second world has surely begun
        process.send_signal(signal.SIGINT)
        said = process.stderr.readline()
        while said.startswith(("friction", "0/2 worlds", "1/2 worlds")):  # progress, where ten seconds have passed
            said = process.stderr.readline()
        self.assertIn("press Ctrl-C again", said)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        self.assert_ended(process, 130)

    def test_terminate_drops_at_once(self):
        process = self.start_endless()
        self.assertIn("worlds", process.stderr.readline())
        process.send_signal(signal.SIGTERM)
        self.assert_ended(process, 143)


def full_disk(byte_count):
    """For `preexec_fn`: no file can grow beyond that, as if the disk were full."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # which ends a process that does not ignore it
        resource.setrlimit(resource.RLIMIT_FSIZE, (byte_count, byte_count))
    return limit


class FullDisk(CliTest):
    """Parts hold 256 worlds: small ones in the first part, large ones in the second."""

    def setUp(self):
        super().setUp()
        self.write("config.ini", CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 0.016\n")
        self.write("shake.txt", "0 0.2 6 1 0\n0.2 0.2 -6 2 0\n")
        for i in range(256):
            self.write(f"layouts/{i:03}.txt", layout_text([(i, 0, 0, i + 50, 50, 50)]))
        for i in range(40):
            cubes = [(20 * x, 20 * y + i, 40 * z, 20 * x + 18, 20 * y + 18 + i, 40 * z + 40)
                     for x in range(5) for y in range(4) for z in range(2)]
            self.write(f"layouts/x{i:02}.txt", layout_text(cubes))

    def screen_here(self, *arguments, **options):
        return self.run_here("screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", "shake.txt",
                             *arguments, **options)

    def assert_second_part_is_read(self):
        """A part but the first counts its layouts from its own: what it shows has the right names all the same."""
        process = start("screen", "-c", "config.ini", "--layouts", "layouts", "layouts", "layouts",
                        "--accelerations", "shake.txt", "--threads", 1, "-o", "other.h5", cwd=self.folder)
        wait_for((self.folder / "other.h5.parts/part-000002.h5").exists, process)
        process.kill()
        process.communicate()
        done = self.run_here("summary", "other.h5.parts/part-000002.h5")
        self.assert_exit(done, 0)
        self.assertRegex(done.stdout, r"worst worlds\n  \S+\.txt under shake.txt: of")

    def test_run_ends_clearly_and_goes_on_when_there_is_room(self):
        self.assert_exit(self.screen_here("-o", "whole.h5"), 0)
        done = self.screen_here(preexec_fn=full_disk(900_000))
        self.assert_exit(done, 1)
        self.assertIn("File too large", done.stderr)
        safe = 0
        for path in self.folder.glob("results.h5.parts/*"):
            with h5py.File(path) as part:
                safe += len(part["worlds/layout"])
        self.assertTrue(0 < safe < 296, safe)
        self.assertIn(f"{safe} of 296 worlds are safe in results.h5.parts; --resume continues from there", done.stderr)

        self.assert_second_part_is_read()

        # Now the parts have room, and the file that they are to become has not.
        done = self.screen_here("--resume", preexec_fn=full_disk((self.folder / "whole.h5").stat().st_size - 200_000))
        self.assert_exit(done, 1)
        self.assertIn("--resume", done.stderr)
        self.assertFalse((self.folder / "results.h5").exists())
        self.assert_exit(self.screen_here("--resume"), 0)
        self.assert_same_results(self.folder / "whole.h5", self.folder / "results.h5")


if __name__ == "__main__":
    unittest.main()
