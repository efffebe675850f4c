"""`holdfast bench`: its figures are those of the runs, and no speed is reported where a run failed."""
import os
import pathlib
import signal
import subprocess
import sys
import unittest

import pandas as pd

from cli import CONFIG, HOLDFAST, PATIENCE, SOURCE, CliTest, datasets, start, wait_for

STAGES = ("read", "build", "simulate", "compress", "write", "assemble")


class Bench(CliTest):
    def setUp(self):
        super().setUp()
        self.write_inputs()
        (self.folder / "scratch").mkdir()

    def bench(self, *arguments):
        return self.run_here("bench", "-c", self.config, "--accelerations", *self.accelerations, "--folder", "scratch",
                             *arguments)

    def test_figures_are_those_of_the_runs(self):
        done = self.bench("--layouts", *self.layouts, "--engine", "bullet-stock", "--threads", 1, 2, "--repeats", 2,
                          "--classes", 4, "--csv", "bench.csv")
        self.assert_exit(done, 0)
        runs = pd.read_csv(self.folder / "bench.csv")
        # Two numbers of threads, without series, and two classes: twice each.
        self.assertEqual(len(runs), 2 * (2 + 1 + 2))
        self.assertEqual(runs.groupby("layouts")["hash"].nunique().tolist(), [1, 1, 1])
        path, _ = self.screen()
        data = datasets(path)
        whole = runs[runs["layouts"] == "all"].iloc[0]
        self.assertEqual(whole["worlds"], 6)
        self.assertEqual(whole["boxes"], data["/worlds/box_count"].sum())
        self.assertEqual(whole["steps"], data["/worlds/steps"].sum())
        self.assertEqual(whole["box_steps"], (data["/worlds/steps"] * data["/worlds/box_count"]).sum())
        self.assertAlmostEqual(whole["simulated_seconds"], data["/worlds/end_time"].sum())
        self.assertEqual(sorted(set(runs["layouts"])), ["1-3 boxes", "4+ boxes", "all"])
        classes = runs[runs["layouts"] != "all"].groupby("layouts")["worlds"].first()
        self.assertEqual(classes.tolist(), [4, 2])
        for stage in ("read", "build", "simulate", "write", "assemble"):
            self.assertTrue((runs[f"{stage}_cpu_seconds"] > 0).all(), stage)
        total = sum(runs[f"{stage}_cpu_seconds"] for stage in STAGES)
        self.assertTrue((total <= runs["cpu_seconds"] + 0.02).all())
        self.assertTrue((runs["peak_memory_MiB"] > 5).all())
        self.assertEqual(len([line for line in done.stdout.splitlines() if line.startswith("bullet-stock")]), 10)
        self.assertFalse(list((self.folder / "scratch").iterdir()), "nothing is left behind")

        subprocess.run([sys.executable, SOURCE / "bench/plot.py", "bench.csv", "bench.svg"], cwd=self.folder, check=True)
        self.assertIn("strong scaling", (self.folder / "bench.svg").read_text())

    def test_a_failing_run_tells_no_speed(self):
        bad = self.write("bad.txt", "1 1\n0 0 0 5 5 x 1\n")
        done = self.bench("--layouts", *self.layouts, bad, "--engine", "bullet-stock", "--threads", 1, "--repeats", 1)
        self.assert_exit(done, 1)
        self.assertEqual(done.stdout, "")
        self.assertIn("bad.txt:2:11: z2 of box 1 is not a number: x", done.stderr)
        self.assertIn("a run failed, so nothing is measured", done.stderr)

    def test_what_cannot_be_measured_is_told_before(self):
        self.write("odd.ini", CONFIG + "Scheduler = none\n")
        (self.folder / "pipe").symlink_to("/dev/null")
        for arguments, words in ((("--engine", "bullet-stock", "bulet"), ("unknown engine: bulet", "'bullet'")),
                                 (("-c", "odd.ini"), ("odd.ini:5:13: Scheduler has a wrong value: none",)),
                                 (("--accelerations", "none.txt"), ("none.txt: no such file",)),
                                 (("--csv", "tower.txt"), ("tower.txt: is a file of another kind",)),
                                 (("--csv", "scratch"), ("scratch: is a folder",)),
                                 (("--csv", "pipe"), ("pipe: is not a regular file",)),
                                 (("--csv", "none/bench.csv"), ("none/bench.csv: cannot be written",)),
                                 (("--folder", "none"), ("none: no folder can be made in it",))):
            with self.subTest(arguments=arguments):
                given = {"-c": ["config.ini"], "--layouts": ["tower.txt"], "--accelerations": ["rest.txt"], "--folder": ["scratch"],
                         "--engine": ["bullet-stock"]}
                given[arguments[0]] = arguments[1:]
                self.assert_refused(self.run_here("bench", *(word for key in given for word in (key, *given[key]))), *words)
        self.assertTrue((self.folder / "tower.txt").read_text().startswith("1 5\n"))
        self.assertFalse(list((self.folder / "scratch").iterdir()))

    def test_a_table_of_an_earlier_benchmark_is_replaced(self):
        arguments = ("--layouts", "seed.txt", "--engine", "bullet-stock", "--threads", 1, "--repeats", 1, "--csv", "bench.csv")
        for _ in range(2):
            self.assert_exit(self.bench(*arguments), 0)
        self.assertEqual(len(pd.read_csv(self.folder / "bench.csv")), 2)

    def test_the_temporary_folder_is_the_systems(self):
        arguments = ("bench", "-c", "config.ini", "--layouts", "seed.txt", "--accelerations", "rest.txt", "--threads", 1,
                     "--repeats", 1)
        self.assert_exit(self.run_here(*arguments, env={**os.environ, "TMPDIR": str(self.folder / "scratch")}), 0)
        nowhere = {**os.environ, "TMPDIR": "/nowhere"}
        self.assert_refused(self.run_here(*arguments, env=nowhere), "no temporary folder", "TMPDIR", "--folder")
        self.assert_exit(self.run_here("engines", env=nowhere), 0)

    def test_stopped_it_leaves_nothing_behind(self):
        self.write("endless.txt", "0 1000000 1 0 0\n")
        self.write("rare.ini", CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 10\n")
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with self.subTest(signal=number):
                process = start("bench", "-c", "rare.ini", "--layouts", "tower.txt", "--accelerations", "endless.txt",
                                "--engine", "bullet-stock", "--folder", "scratch", cwd=self.folder)
                self.addCleanup(process.kill)
                wait_for(lambda: list((self.folder / "scratch").glob("*/results.h5.parts")), process)
                children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
                process.send_signal(number)
                out, said = process.communicate(timeout=PATIENCE)
                self.assertEqual((process.returncode, out), (code, ""), said)
                self.assertEqual(said.splitlines()[1:], ["stopped; an incomplete benchmark reports nothing"])
                self.assertEqual(len(children), 1)
                self.assertFalse(pathlib.Path("/proc", children[0]).exists())
                self.assertFalse(list((self.folder / "scratch").iterdir()))

    def test_costs_of_a_run(self):
        _, done = self.screen("--costs", "costs.json")
        costs = pd.read_json(self.folder / "costs.json", typ="series")
        self.assertEqual(list(costs.index), list(STAGES))
        self.assertGreater(costs["simulate"], 0)
        self.screen("--costs", "costs.json", "--overwrite")
        for path, words in (("config.ini", "is a file of another kind"), ("/dev/null", "is not a regular file"), ("scratch", "is a folder"),
                            ("none/costs.json", "cannot be written"), ("./other.h5", "is the results file")):
            with self.subTest(path=path):
                _, done = self.screen("--costs", path, output="other.h5", expect=2)
                self.assert_refused(done, f"{path}: {words}")
                self.assertFalse((self.folder / "other.h5").exists())
        self.assertEqual((self.folder / "config.ini").read_text(), CONFIG)


class Scale(CliTest):
    def test_a_small_scale_run_that_is_killed(self):
        """bench/scale.py measures what is there, and finds a resumed run the same as an undisturbed one."""
        self.write("config.ini", CONFIG)
        brake = self.write("brake.txt", "0 1 5 0 0\n")
        done = subprocess.run([sys.executable, SOURCE / "bench/scale.py", "40", "--boxes", "20", "60", "--config",
                               self.folder / "config.ini", "--accelerations", brake, "--program", HOLDFAST, "--folder",
                               self.folder, "--kills", "2"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = {line[:44].strip(): float(line[44:57]) for line in done.stdout.splitlines()[:-1]}
        self.assertEqual(figures["worlds"], 40)
        for name in ("wall time", "peak memory", "results file", "processor time: assemble", "worlds safe after kill 2",
                     "h5py: open, and read a world's displacements"):
            self.assertIn(name, figures)
        self.assertEqual(done.stdout.splitlines()[-1], "killed and resumed: the same file as without, times aside")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["brake.txt", "config.ini"])


if __name__ == "__main__":
    unittest.main()
