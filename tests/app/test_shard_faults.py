"""What happens to shards on the way: kills at random moments, a disk that is full for one of them, clocks that are years apart.

There are more random kills where tests are thorough.
"""
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

import h5py

from cli import CONFIG, SANITIZED, THOROUGH, SmallDisk, start
from test_shards import ShardTest

KILLS = 20 if THOROUGH else 2
YEAR = 365 * 86400  # s

# Stands in for the clock of another machine, and leaves the clock alone by which waiting is measured.
SHIFTED_CLOCK = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <time.h>

int clock_gettime(clockid_t clock, struct timespec* now) {
  int (*unshifted)(clockid_t, struct timespec*) = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  const int failure = unshifted(clock, now);
  if (failure == 0 && clock == CLOCK_REALTIME) now->tv_sec += atol(getenv("CLOCK_SHIFT"));
  return failure;
}

time_t time(time_t* place) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (place != NULL) *place = now.tv_sec;
  return now.tv_sec;
}
"""


class LongShards(ShardTest):
    """Three shards of a second or more each."""

    layouts = 320
    parts = 3
    seconds = 20  # of the longer acceleration

    def setUp(self):
        super().setUp()
        # Bullet steps where nothing moves too.
        self.write("config.ini", CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 5\n")
        self.write("push.txt", f"0 {self.seconds} 0 1 0\n")
        self.arguments = ["screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", "push.txt", "rest.txt",
                          "--quiet", "--threads", 1]

    def shard(self, part, *arguments, output="results.h5"):
        return [*map(str, self.arguments), "-o", output, "--part", f"{part}/{self.parts}", "--resume", *arguments]

    def assert_finishes(self, part, **options):
        self.assertIn(self.run_here(*self.shard(part, **options)).returncode, (0, 1))  # one layout is bad


class KilledShards(LongShards):
    layouts = 900  # eight blocks, so that a shard has several parts

    def assert_merges_to(self, whole, draw):
        """However often it is killed. Shards and file are removed then."""
        for _ in range(3):
            process = start("merge", "results.h5", cwd=self.folder)
            time.sleep(draw.uniform(0.0, 0.05))
            process.kill()
            process.communicate()
        self.merge()
        self.assert_same_file(whole, self.folder / "results.h5")
        (self.folder / "results.h5").unlink()
        shutil.rmtree(self.folder / "results.h5.shards")

    def test_killed_shards_and_merges_go_on_to_the_same_bytes(self):
        whole = self.screen(output="whole.h5")
        draw = random.Random(3)
        kills, on_the_way, merges = 0, 0, 0
        left = [1, 2, 3]
        while kills < KILLS:
            part = draw.choice(left)
            process = start(*self.shard(part), cwd=self.folder)
            time.sleep(draw.uniform(0.05, 0.5))
            process.send_signal(draw.choice([signal.SIGKILL, signal.SIGTERM]))
            process.communicate()
            if process.returncode in (0, 1):
                left.remove(part)
            else:
                kills += 1
                on_the_way += bool(list(self.folder.glob(f"results.h5.shards/shard-{part}-of-3.h5.parts/part-*.h5")))
            if not left:
                self.assert_merges_to(whole, draw)
                merges += 1
                left = [1, 2, 3]
        for part in left:
            self.assert_finishes(part)
        self.assert_merges_to(whole, draw)
        print(f"{kills} kills of shards, {on_the_way} of them after the first part, {merges + 1} merges")


class FullDisk(SmallDisk, LongShards):
    """One shard, and then the merged file, on a disk that is too small."""

    def test_a_shard_whose_disk_is_full_goes_on_when_there_is_room(self):
        whole = self.screen(output="whole.h5")
        self.assert_finishes(2, output="elsewhere.h5")
        size = (self.folder / "elsewhere.h5.shards/shard-2-of-3.h5").stat().st_size
        for part in (1, 3):
            self.assert_finishes(part)
        self.remount(f"size={size // 2}")
        done = self.run_here(*self.shard(2, output="disk/results.h5"))
        self.assert_exit(done, 1)
        self.assertIn("No space left on device", done.stderr)
        self.assertIn("shard-2-of-3.h5", done.stderr)
        everything = ("results.h5.shards", "disk/results.h5.shards")
        self.assert_refused(self.run_here("merge", "results.h5", *everything), "a shard is missing", "2 of 3", "--resume")
        self.remount("size=64m")
        self.assert_finishes(2, output="disk/results.h5")
        self.merge(*everything)
        self.assert_same_file(whole, self.folder / "results.h5")

    def test_a_merge_goes_on_when_there_is_room(self):
        whole = self.screen(output="whole.h5")
        for part in (1, 2, 3):
            self.assert_finishes(part)
        # Room for some of the parts of the file; then for these, and not for the file that they become.
        for room in (0.5, 1.5):
            self.remount(f"size={int(room * whole.stat().st_size)}")
            done = self.run_here("merge", "disk/results.h5", "results.h5.shards")
            self.assert_exit(done, 1)
            self.assertIn("No space left on device", done.stderr)
            self.assertFalse((self.disk / "results.h5").exists())
        self.remount("size=64m")
        self.assert_exit(self.run_here("merge", "disk/results.h5", "results.h5.shards"), 0)
        self.assert_same_file(whole, self.disk / "results.h5")
        self.assertEqual([path.name for path in self.disk.iterdir()], ["results.h5"])


@unittest.skipIf(SANITIZED, "the sanitizer wants to be the first library")
class ClocksApart(LongShards):
    """Shards on machines whose clocks are years apart, and files whose times say nothing."""

    def setUp(self):
        super().setUp()
        source = self.write("shifted_clock.c", SHIFTED_CLOCK)
        self.clock = self.folder / "shifted_clock.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-o", self.clock, source, "-ldl"], check=True)

    def at(self, years):
        """The environment of a machine whose clock is that much before ours."""
        return {**os.environ, "LD_PRELOAD": str(self.clock), "CLOCK_SHIFT": str(years * YEAR)}

    def shift_files(self, years):
        moment = time.time() + years * YEAR
        for path in self.folder.rglob("*"):
            os.utime(path, (moment, moment))

    def test_the_merged_file_is_that_of_one_clock(self):
        whole = self.screen(output="whole.h5")
        # The second shard is stopped and goes on with a clock that has been set back.
        for part, years in ((1, 10), (3, -10)):
            done = self.run_here(*self.shard(part), env=self.at(years))
            self.assertIn(done.returncode, (0, 1), done.stderr)
            self.shift_files(-years)
        process = start(*self.shard(2), cwd=self.folder, env=self.at(20))
        time.sleep(0.3)
        process.terminate()
        process.communicate()
        self.shift_files(15)
        self.assertIn(self.run_here(*self.shard(2), env=self.at(-20)).returncode, (0, 1))
        created = []
        for shard in sorted((self.folder / "results.h5.shards").glob("*.h5")):
            with h5py.File(shard) as file:
                created.append(int(file.attrs["created_utc"][:4]))
        self.assertEqual(created[0] - created[2], 20, "the clocks are apart")
        self.assertNotEqual(created[0], created[1])
        self.assert_exit(self.run_here("merge", "results.h5", env=self.at(-5)), 0)
        self.assert_same_file(whole, self.folder / "results.h5")


if __name__ == "__main__":
    unittest.main()
