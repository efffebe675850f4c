"""Worlds that end early: what is said of them, and that nothing else changes."""
import json
import unittest

import numpy as np

from cli import CliTest, datasets, layout_text, schedulers, start, wait_for

SLIDE = "0 0.5 0 0 0\n0.5 1.5 7 0 0\n"
BOX = [(200, 50, 0, 280, 110, 40)]
HIGH = [(0, 0, 0, 80, 60, 40), (40, 0, 40, 90, 60, 80)]


class StopWhen(CliTest):
    """A box that slides, a box that slides off another, and the same at rest."""

    def setUp(self):
        super().setUp()
        self.write_inputs()
        self.config.write_text("[Native]\nAccuracy = screening\n[Container]\nOpenSides = front\n")
        self.layouts = [self.write("box.txt", layout_text(BOX)), self.write("high.txt", layout_text(HIGH))]
        self.accelerations = [self.write("slide.txt", SLIDE), self.write("still.txt", "0 1 0 0 0\n")]

    def worlds(self, *arguments, **options):
        return [json.loads(line) for line in self.screen("--json", "--overwrite", *arguments, **options)[1].stdout.splitlines()]

    def test_ends_the_worlds_that_are_decided_and_no_other(self):
        whole = self.worlds()
        self.assertEqual([world["verdict"] for world in whole[1::2]], ["stayed", "stayed"])
        for world in whole:
            self.assertEqual(world["time_saved_s"], 0)
        for question, ends_early in (("moved", [True, False, True, False]), ("end", [False] * 4)):
            early = self.worlds("--stop-when", question)
            self.assertEqual([world["stop_reason"] == "decided" for world in early], ends_early)
            for all_of_it, part in zip(whole, early):
                self.assertEqual(part["verdict"] == "stayed", all_of_it["verdict"] == "stayed")
                if part["stop_reason"] == "decided":
                    self.assertEqual((part["status"], part["verdict"]), ("ok", "moved"))
                    self.assertIn(all_of_it["verdict"], ("moved", "fell"))
                    self.assertGreater(part["peak_displacement_m"], 0.1)
                    self.assertLess(part["peak_displacement_m"], 0.15)
                    self.assertAlmostEqual(part["end_time_s"] + part["time_saved_s"], 2)  # the end of the acceleration
                    self.assertGreater(part["time_saved_s"], 0.5)
                else:
                    for world in (all_of_it, part):
                        world.pop("cpu_seconds", None)
                    self.assertEqual(part, all_of_it)

    def test_is_a_key_that_the_option_overrides(self):
        by_option, _ = self.screen("--stop-when", "moved", output="option.h5")
        with self.config.open("a") as config:
            config.write("[Screening]\nStopWhen = moved\n")
        by_key, _ = self.screen(output="key.h5")
        overridden, _ = self.screen("--stop-when", "end", output="overridden.h5")
        hashes = [datasets(path)["/worlds/state_hash"].tolist() for path in (by_option, by_key, overridden)]
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])
        refused = self.run_here("screen", "--stop-when", "never", "--layouts", *self.layouts, "--accelerations",
                                *self.accelerations)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("never; accepted is end, moved or fallen", refused.stderr)

    def test_the_table_counts_them_and_the_share_of_time_saved(self):
        path, done = self.screen("--stop-when", "moved")
        data = datasets(path)
        self.assertRegex(done.stdout, r"layouts that +stayed +moved +fell +unstable +failed +the worst one\n")
        self.assertRegex(done.stdout, r"\nslide\.txt +0 +2 +0 +0 +0 +high\.txt\n")
        self.assertRegex(done.stdout, r"\nstill\.txt +2 +0 +0 +0 +0 +-\n")
        self.assertRegex(done.stdout, r"\n  high\.txt under slide\.txt: of 2 boxes at least 0 fell, 2 moved, ")
        share = 100 * (4 - data["/worlds/end_time"][::2].sum()) / 6
        self.assertIn(f"\nsimulated time saved, since worlds ended early or were not needed: {share:.1f} % of 6 s\n", done.stdout)
        self.assertEqual(data["/worlds/stop_reason"].tolist(), [4, 2, 4, 2])
        self.assertEqual(data["/summary/worlds/verdict"].tolist(), [1, 0, 1, 0])
        self.assertNotIn("at least", self.screen(output="whole.h5")[1].stdout)

    def test_series_end_where_the_world_ends(self):
        data = datasets(self.screen("--stop-when", "moved")[0])
        whole = datasets(self.screen(output="whole.h5")[0])
        last = data["/worlds/sample_begin"] + data["/worlds/sample_count"].astype(np.uint64) - 1
        np.testing.assert_array_equal(data["/series/time"][last], data["/worlds/end_time"])
        before_the_end = data["/worlds/sample_count"][0] - 1
        np.testing.assert_array_equal(data["/series/displacement"][:before_the_end], whole["/series/displacement"][:before_the_end])

    def test_looser_limits_later_say_nothing_else(self):
        path, _ = self.screen("--stop-when", "moved")
        done = self.run_here("summary", path, "--move-threshold", 0.5, "-o", "loose.h5")
        self.assertEqual(datasets(self.folder / "loose.h5")["/summary/worlds/verdict"].tolist(), [1, 0, 1, 0])
        self.assertIn("2 worlds ended early: by a limit of the run", done.stdout)

    def test_schedulers_threads_and_series_do_not_matter(self):
        first, _ = self.screen("--stop-when", "moved", "--scheduler", "serial", output="first.h5")
        for scheduler in schedulers():
            other, _ = self.screen("--stop-when", "moved", "--scheduler", scheduler, "--threads", 3, "--overwrite")
            self.assert_same_results(first, other)
        without, _ = self.screen("--stop-when", "moved", "--no-series", output="without.h5")
        self.assertEqual(datasets(first)["/worlds/state_hash"].tolist(), datasets(without)["/worlds/state_hash"].tolist())

    def test_another_question_is_another_run(self):
        self.screen("--stop-when", "moved")
        self.assert_refused(self.screen("--stop-when", "fallen", "--resume", expect=2)[1], "is of a run with other settings")
        self.screen("--stop-when", "moved", "--resume")


class FirstFailure(CliTest):
    """Forty boxes that slide, and the accelerations that they stand and that they do not."""

    def setUp(self):
        super().setUp()
        self.write_inputs()
        self.config.write_text("[Native]\nAccuracy = screening\n")
        self.layouts = [self.write(f"box{i:02}.txt", layout_text([(200, 50, 0, 280 + i, 110, 40)])) for i in range(40)]
        self.layouts[3].write_text("no layout\n")
        self.accelerations = [self.write("still.txt", "0 1 0 0 0\n"), self.write("slide.txt", SLIDE),
                              self.write("weak.txt", "0 1 1 0 0\n")]

    def test_the_worlds_after_a_failure_are_not_needed(self):
        arguments = ("--json", "--overwrite", "--threads", 3)
        whole = [json.loads(line) for line in self.screen(*arguments, expect=1)[1].stdout.splitlines()]
        until = [json.loads(line) for line in self.screen(*arguments, "--first-failure", expect=1)[1].stdout.splitlines()]
        verdicts = np.array([world["verdict"] for world in until]).reshape(40, 3)
        self.assertEqual(verdicts[3].tolist(), 3 * ["failed"])
        for block in (verdicts[:3], verdicts[4:8]):
            self.assertEqual(block.tolist(), len(block) * [["stayed", "moved", "not_needed"]])
        self.assertEqual(verdicts[8:].tolist(), 32 * [["not_needed", "moved", "not_needed"]])
        for all_of_it, world in zip(whole, until):
            if world["verdict"] == "not_needed":
                self.assertEqual((world["status"], world["stop_reason"]), ("not_needed", "not_run"))
                self.assertEqual(world["status_text"], "the layout does not hold slide.txt")
                self.assertEqual(world["time_saved_s"], all_of_it["end_time_s"])
                self.assertEqual((world["boxes"], world["moved_boxes"]), (0, None))
            else:
                self.assertEqual({**world, "cpu_seconds": 0}, {**all_of_it, "cpu_seconds": 0})

    def test_the_table_counts_them_by_themselves(self):
        del self.layouts[3]
        path, done = self.screen("--first-failure")
        self.assertRegex(done.stdout, r"layouts that +stayed +moved +fell +not needed +unstable +failed +the worst one\n")
        self.assertRegex(done.stdout, r"\nstill\.txt +8 +0 +0 +31 +0 +0 +-\n")
        self.assertRegex(done.stdout, r"\nslide\.txt +0 +39 +0 +0 +0 +0 +box")
        self.assertIn(f"or were not needed: {100 * (31 + 39) / (4 * 39):.1f} % of 156 s\n", done.stdout)
        data = datasets(path)
        self.assertEqual(np.bincount(data["/worlds/status"]).tolist(), [8 + 39] + 63 * [0] + [31 + 39])
        self.assertNotIn("unstable before", done.stdout)

    def test_schedulers_and_threads_do_not_matter(self):
        first, _ = self.screen("--first-failure", "--scheduler", "serial", output="first.h5", expect=1)
        for scheduler in schedulers():
            other, _ = self.screen("--first-failure", "--scheduler", scheduler, "--threads", 3, "--overwrite", expect=1)
            self.assert_same_results(first, other)

    def test_a_key_does_the_same(self):
        by_option, _ = self.screen("--first-failure", output="option.h5", expect=1)
        with self.config.open("a") as config:
            config.write("[Screening]\nFirstFailure = true\n")
        by_key, _ = self.screen(output="key.h5", expect=1)
        statuses = [datasets(path)["/worlds/status"].tolist() for path in (by_option, by_key)]
        self.assertEqual(statuses[0], statuses[1])

    def test_a_killed_run_is_resumed_in_the_same_order(self):
        # Boxes at the rear wall slide when the container brakes, those at the front wall when it starts. Within the
        # block from layout 64 to 128 the more frequent failure changes, and the order must not.
        self.config.write_text("[Native]\nAccuracy = reference\nFreeze = false\nJump = false\n")
        for path in self.layouts:
            path.unlink()
        for i in range(160):
            x = 507 if i < 40 else 0
            self.write(f"boxes/box{i:03}.txt", layout_text([(x, 50, 0, x + 80, 110, 40)]))
        brake = self.write("brake.txt", "0 1 7 0 0\n")
        back = self.write("start.txt", "0 1 -7 0 0\n")
        arguments = ("screen", "-c", self.config, "--layouts", "boxes", "--accelerations", back, brake, "--first-failure")
        self.assert_exit(self.run_here(*arguments, "-o", "whole.h5"), 0)
        process = start(*arguments, "--threads", 1, "-o", "results.h5", cwd=self.folder)
        try:
            wait_for((self.folder / "results.h5.parts/part-000001.h5").exists, process)
        finally:
            process.kill()
            process.communicate()
        self.assert_exit(self.run_here(*arguments, "--threads", 2, "-o", "results.h5", "--resume"), 0)
        self.assert_same_results(self.folder / "whole.h5", self.folder / "results.h5")
        needed = datasets(self.folder / "whole.h5")["/worlds/status"].reshape(160, 2) == 0
        self.assertEqual(needed.sum(axis=1).tolist(), 8 * [2] + 32 * [1] + 88 * [2] + 32 * [1])


if __name__ == "__main__":
    unittest.main()
