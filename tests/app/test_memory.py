"""Runs that get less memory than they need: reported by the world's name, and what finished is kept."""
import resource
import unittest

from cli import AT_ONCE, SANITIZED, SEED, CliTest, datasets, layout_text, some

SPARSE = "[Export Settings]\nResultsIntervallInSeconds = 0.0001\n"
REMEDY = "take less with fewer --threads, a longer ResultsIntervallInSeconds, or --no-series"


def lattice(count):
    """So many cubes of 13 cm at rest, side by side and on top of each other."""
    return [(14 * (k % 40), 14 * (k // 40 % 16), 14 * (k // 640), 14 * (k % 40) + 13, 14 * (k // 40 % 16) + 13,
             14 * (k // 640) + 13) for k in range(count)]


def memory(mebibytes):
    """For `preexec_fn`: the program gets so much address space, and no more."""
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (mebibytes << 20, mebibytes << 20))


class LittleMemory(CliTest):
    def setUp(self):
        super().setUp()
        if SANITIZED:
            self.skipTest("a sanitizer takes terabytes of address space")
        self.write("config.ini", SPARSE + AT_ONCE)
        self.write("still.txt", "0 0.1 0 0 0\n")
        self.write("a_small.txt", layout_text(SEED))
        self.write("b_large.txt", layout_text(lattice(2000)))
        self.write("c_small.txt", layout_text(SEED))

    def arguments(self, *more):
        return ("screen", "-c", "config.ini", "--layouts", "a_small.txt", "b_large.txt", "c_small.txt", "--accelerations",
                "still.txt", "--quiet", *more)

    def test_the_world_is_named_and_what_finished_is_kept(self):
        self.assert_exit(self.run_here(*self.arguments("-o", "whole.h5")), 0)
        for scheduler in ("serial", "tbb"):
            words = self.arguments("--scheduler", scheduler, "--threads", 2)
            with self.subTest(scheduler=scheduler):
                done = self.run_here(*words, "--overwrite", preexec_fn=memory(150))
                self.assert_refused(done, "b_large.txt: memory ran out when its world under still.txt was simulated", REMEDY,
                                    "1 of 3 worlds are safe in results.h5.parts; --resume continues from there", code=1, lines=2)
                self.assert_exit(self.run_here(*words, "--resume"), 0)
                self.assert_same_results(self.folder / "whole.h5", self.folder / "results.h5")

    def test_whatever_is_allocated_last_there_is_a_message(self):
        """From less than the program needs to begin to more than the run needs: reading, simulating, placing, writing,
        assembling fail in turn. Each thread may reserve 64 MiB of addresses for its own heap, depending on timing:
        only the last limit is enough for certain."""
        self.assert_exit(self.run_here(*self.arguments("-o", "whole.h5")), 0)
        for engine in ("native", "bullet"):
            codes = set()
            for limit in some((*range(35, 75, 5), 100, 130, 160, 190, 210, 230, 250, 300, 400, 1000), 4) + [1000]:
                with self.subTest(engine=engine, mebibytes=limit):
                    done = self.run_here(*self.arguments("--engine", engine, "--overwrite", "--threads", 2),
                                         preexec_fn=memory(limit))
                    # The C library itself ends a process that has no room to load what the end of a thread takes.
                    if any(text in done.stderr for text in ("error while loading shared libraries", "libgcc_s.so.1")):
                        continue
                    codes.add(done.returncode)
                    self.assertIn(done.returncode, (0, 1, 2), done.stderr)
                    self.assert_exit(done, done.returncode)
                    if done.returncode != 0:
                        self.assertRegex(done.stderr, "memory|Resource temporarily unavailable|cannot be loaded")
            self.assertLessEqual({0, 1}, codes)

    def test_assembling_with_little_memory(self):
        self.assert_exit(self.run_here(*self.arguments("-o", "whole.h5")), 0)
        done = self.run_here(*self.arguments(), preexec_fn=memory(150))
        self.assertEqual(done.returncode, 1)
        for limit in (30, 35, 40, 50, 60, 400):
            done = self.run_here(*self.arguments("--resume", "--scheduler", "serial"), preexec_fn=memory(limit))
            if done.returncode == 127:  # not even the libraries had room
                continue
            self.assert_exit(done, done.returncode)
            self.assertIn(done.returncode, (0, 1, 2), done.stderr)
            self.assertEqual(done.returncode != 0, done.stderr != "", done.stderr)
        self.assert_same_results(self.folder / "whole.h5", self.folder / "results.h5")

    def test_a_series_that_is_too_large_is_not_begun(self):
        self.write("config.ini", "[Export Settings]\nResultsIntervallInSeconds = 0.00001\n" + AT_ONCE)
        words = self.arguments("--accelerations", "short.txt")
        self.write("short.txt", "0 0.001 0 0 0\n")
        done = self.run_here(*words)
        self.assert_refused(done, "b_large.txt: its series under still.txt would be too large, 10002 samples of 2000 boxes: "
                                  "20004000; at most 20000000: a longer ResultsIntervallInSeconds, less RunOutSeconds, or --no-series", code=1)
        data = datasets(self.folder / "results.h5")
        self.assertEqual(data["/worlds/status"].tolist(), [0, 0, 32, 0, 0, 0])
        self.assertEqual(data["/worlds/box_count"].tolist(), [3, 3, 0, 2000, 3, 3])
        self.assertEqual(data["/summary/worlds/verdict"][2], 4)
        self.assert_exit(self.run_here(*words, "--no-series", "--overwrite"), 0)


if __name__ == "__main__":
    unittest.main()
