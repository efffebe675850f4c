"""Progress: one line redrawn on a terminal, plain lines elsewhere, and standard output left alone."""
import os
import pty
import re
import signal
import subprocess
import time
import unittest

from cli import CONFIG, PATIENCE, SEED, CliTest, layout_text, start

SPARSE = CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 5\n"


class Progress(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", SPARSE)
        self.write("long.txt", "0 60 1 0 0\n")
        self.write("endless.txt", "0 100000 1 0 0\n")

    def write_layouts(self, count):
        for i in range(count):
            self.write(f"layouts/{i:02}.txt", layout_text([(x + i, y, z, X + i, Y, Z) for x, y, z, X, Y, Z in SEED]))

    def arguments(self, *more):
        return ("screen", "-c", "config.ini", "--layouts", "layouts", "--threads", 1, *more)

    def on_terminal(self, *arguments):
        """What the program writes on a terminal as standard error, and on standard output."""
        ours, theirs = pty.openpty()
        process = start(*arguments, cwd=self.folder, stderr=theirs)
        os.close(theirs)
        drawn = b""
        try:
            while piece := os.read(ours, 4096):
                drawn += piece
        except OSError:  # the other end is closed
            pass
        os.close(ours)
        out, _ = process.communicate(timeout=PATIENCE)
        return process.returncode, drawn.decode(), out

    def test_one_line_is_redrawn_on_a_terminal(self):
        self.write_layouts(20)
        code, drawn, out = self.on_terminal(*self.arguments("--accelerations", "long.txt"))
        self.assertEqual(code, 0)
        lines = drawn.split("\r\n")
        self.assertEqual(lines[-1].count("\n"), 0)
        self.assertIn("20 layouts x 1 acceleration = 20 worlds", lines[0])
        self.assertTrue(lines[1].startswith("friction: "), lines[1])
        self.assertEqual(len(lines), 3, "the line is drawn over, never continued")
        shown = lines[2].split("\r")
        texts = [text.strip() for text in shown if re.match(r"\d+/20 worlds  [\d.]+ worlds/s  \d+ % of steps skipped"
                                                            r"  \d+:\d\d to go *$", text)]
        self.assertGreater(len(texts), 1, drawn)
        done = [int(text.split("/")[0]) for text in texts]
        self.assertEqual(done, sorted(done))
        self.assertLess(max(map(len, shown)), 80, "fits an ordinary terminal")
        self.assertEqual(shown[-1], "", "the cursor is back at the left")
        self.assertEqual(shown[-2].strip(), "", "the line is wiped")
        self.assertGreaterEqual(len(shown[-2]), len(texts[-1]))
        self.assertNotIn("\x1b", drawn)
        self.assertNotIn("\r", out)
        self.assertIn("stayed", out)

    def test_quiet_on_a_terminal(self):
        self.write_layouts(1)
        self.assertEqual(self.on_terminal(*self.arguments("--accelerations", "long.txt", "--quiet")), (0, "", ""))

    def test_a_merge_shows_its_progress_as_a_run_does(self):
        self.write_layouts(3)
        self.write("short.txt", "0 0.1 1 0 0\n")
        self.assert_exit(self.run_here(*self.arguments("--accelerations", "short.txt", "--quiet", "--part", "1/1")), 0)
        code, drawn, out = self.on_terminal("merge", "results.h5")
        self.assertEqual((code, out), (0, "results: results.h5, 3 worlds of 1 shard\n"))
        shown = drawn.split("\r")
        self.assertEqual(shown[:2], ["", "0/3 worlds"])
        self.assertEqual((shown[-2].strip(), shown[-1]), ("", ""), "the line is wiped, and the cursor is back at the left")
        self.assertNotIn("\n", drawn)
        self.assertEqual(self.on_terminal("merge", "results.h5", "--overwrite", "--quiet"), (0, "", ""))
        self.assertEqual(self.run_here("merge", "results.h5", "--overwrite").stderr, "")

    def test_plain_lines_in_a_pipe(self):
        self.write_layouts(2)
        process = start(*self.arguments("--accelerations", "long.txt", "endless.txt", "--json"), cwd=self.folder)
        self.addCleanup(process.kill)
        self.assertIn("4 worlds", process.stderr.readline())
        self.assertIn("friction", process.stderr.readline())
        self.assertIn("long.txt", process.stdout.readline(), "a world has finished")
        # A line comes every ten seconds; stopped meanwhile, the program leaves the processor to other tests.
        process.send_signal(signal.SIGSTOP)
        time.sleep(10)
        process.send_signal(signal.SIGCONT)
        line = process.stderr.readline()
        self.assertRegex(line, r"^1/4 worlds  [\d.]+ worlds/s  \d+ % of steps skipped  \d+:\d\d to go\n$")
        process.send_signal(signal.SIGTERM)
        out, said = process.communicate(timeout=PATIENCE)
        self.assertEqual((process.returncode, out), (143, ""))
        self.assertIn("stopped after 1 of 4 worlds", said)
        self.assertNotRegex(said, "[\r\x1b]")

    def test_a_short_run_says_little(self):
        self.write_layouts(1)
        done = self.run_here(*self.arguments("--accelerations", "long.txt"))
        self.assert_exit(done, 0)
        self.assertEqual(len(done.stderr.splitlines()), 2)

    def test_a_reader_that_goes_away_ends_the_run(self):
        self.write_layouts(3)
        process = start(*self.arguments("--accelerations", "long.txt", "--json"), cwd=self.folder)
        process.stdout.close()
        self.assertNotEqual(process.wait(timeout=PATIENCE), 0)
        self.assertNotIn("terminate called", process.stderr.read())
        process.stderr.close()


if __name__ == "__main__":
    unittest.main()
