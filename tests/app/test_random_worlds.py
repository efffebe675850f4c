"""bench/random_worlds.py: worlds that are valid and the same every time, and what is counted of them."""
import argparse
import itertools
import json
import random
import subprocess
import sys
import unittest

import numpy as np

from cli import HOLDFAST, SOURCE, CliTest

sys.path.insert(0, str(SOURCE / "bench"))
import random_inputs  # noqa: E402
import random_worlds  # noqa: E402

DRAWS = 40  # of each kind
SMALL = 0.2  # of a limit
ANSWERS = (*random_worlds.ACCURACIES, random_worlds.AGAIN)


def answer(verdict, used=SMALL):
    """An answer of the program in which a box used up such a share of each limit."""
    return {"verdict": verdict, "status": "ok", "caveats": "", "critical_box": 1, "end_time_s": 1.0, "cpu_seconds": 0.1,
            "state_hash": "0", **{name: used * limit for name, limit in random_worlds.LIMITS.items()}}


class RandomWorlds(CliTest):
    def options(self, **given):
        return argparse.Namespace(**{"seed": 6, "worlds": 3, "holdfast": HOLDFAST, "keep": None, **given})

    def judged(self, name, *options):
        """The worlds that a run of the script writes, without times."""
        done = subprocess.run([sys.executable, SOURCE / "bench/random_worlds.py", "--holdfast", HOLDFAST, "--worlds", "3", "--seed",
                               "6", "--quiet", "--json", self.folder / name, *map(str, options)], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        worlds = json.loads((self.folder / name).read_text())["worlds"]
        for world, accuracy in itertools.product(worlds, ANSWERS):
            del world["answers"][accuracy]["cpu_seconds"]
        return worlds, done.stdout

    def test_loads_are_valid(self):
        for kind, number in itertools.product(random_inputs.LOADS, range(DRAWS)):
            boxes = random_inputs.load(random.Random(number), kind)
            self.assertEqual(boxes, random_inputs.load(random.Random(number), kind))
            self.assertTrue(2 <= len(boxes) <= random_inputs.MOST_BOXES, kind)
            for one, other in itertools.combinations(boxes, 2):
                apart = any(one[axis] >= other[axis + 3] or other[axis] >= one[axis + 3] for axis in range(3))
                self.assertTrue(apart, (kind, number, one, other))
            self.write(f"layouts/{kind}_{number}.txt", random_worlds.layout_text(boxes))
        done = self.run_here("check", "layouts")
        self.assert_exit(done, 0)
        self.assertEqual(done.stdout.count(": ok: layout"), DRAWS * len(random_inputs.LOADS))

    def test_accelerations_have_the_size_one(self):
        for kind, number in itertools.product(random_inputs.ACCELERATIONS, range(DRAWS)):
            rows = random_inputs.ACCELERATIONS[kind](random.Random(number))
            self.assertAlmostEqual(np.hypot(rows[:, 2], rows[:, 3]).max(), 1, 5)
            self.assertLess(abs(rows[:-1, 0] + rows[:-1, 1] - rows[1:, 0]).max(initial=0), 1e-9)
            self.assertLess(abs(rows[:, 4]).max(), 1)
            self.assertTrue(kind == "step" or 0.9e-3 < rows[0, 1] < 1.1e-2, (kind, rows[0, 1]))

    def test_the_same_every_time_and_with_the_amplitudes_of_an_earlier_run(self):
        worlds, text = self.judged("one.json")
        self.assertEqual(len(worlds), 3)
        self.assertIn("`screening` against `reference`:", text)
        self.assertEqual(worlds, self.judged("two.json", "--jobs", 2, "--amplitudes", self.folder / "one.json")[0])
        few = self.judged("few.json", "--worlds", 2)[0]
        self.assertEqual(worlds[:2], few)

    def test_what_an_earlier_run_has_judged_is_kept(self):
        group = random_worlds.Group(self.options(), 0, self.folder)
        for world in group.worlds:
            world.answers = {accuracy: answer("fell") for accuracy in ANSWERS}
        rows = [world.row() for world in group.worlds]
        self.write("all.json", json.dumps({"seed": 6, "draws": 0, "replicas": False, "worlds": rows}))
        self.assertEqual(self.judged("all.json", "--resume")[0], [
            {**row, "answers": {accuracy: {name: value for name, value in row["answers"][accuracy].items() if name != "cpu_seconds"}
                                for accuracy in ANSWERS}} for row in rows])

    def test_what_is_counted(self):
        for screening, reference, again, expected in (
                ("stayed", answer("stayed"), [], ["let pass"]),
                ("stayed", answer("moved", 1.1), ["moved", "stayed", "fell"], ["let pass", "beyond a limit at reference"]),
                ("stayed", answer("fell", 1.1), ["moved", "moved", "fell"],
                 ["let pass", "beyond a limit at reference", "unsafe clearly"]),
                ("moved", answer("stayed", 0.49), [], ["rejected", "held by half a limit at reference"]),
                ("fell", answer("stayed", 0.51), [], ["rejected"]),
                ("moved", answer("moved", 1.1), [], ["rejected"]),
                ("stayed", answer("failed"), [], ["let pass"]),
                ("unstable", answer("unstable"), [], [])):
            with self.subTest(screening=screening, reference=reference, again=again):
                world = random_worlds.Group(self.options(), 0, self.folder).worlds[0]
                world.answers, world.by_twice_the_limits = {"screening": answer(screening), "reference": reference}, again
                self.assertEqual([name for name, of in random_worlds.COUNTS.items() if of(world, "screening")], expected)
                judged = random_worlds.judged_worlds([world], "screening")
                self.assertEqual(len(judged), 0 if reference["verdict"] in ("failed", "unstable") else 1)

    def test_what_replicas_tell_of_worlds_that_are_let_pass(self):
        worlds = random_worlds.Group(self.options(), 0, self.folder).worlds
        held, limit = answer("stayed", 0.1), answer("moved", 1.1)
        for world, told, reference in zip(worlds, ("holds", "uncertain", "fails"), (held, held, limit)):
            world.answers = {"screening": answer("stayed"), "standard": answer("moved"), "reference": reference}
            world.told, world.by_twice_the_limits = {"screening": told}, ["moved"] * 3
        rows = random_worlds.replicas_table(worlds[:3]).splitlines()[-6:]
        self.assertEqual(rows, ["| `screening` | `holds` | 1 (33.3 %) | 0 (0.0 %) | 0 | 1 |",
                                "| `screening` | `uncertain` | 1 (33.3 %) | 0 (0.0 %) | 0 | 1 |",
                                "| `screening` | `fails` | 1 (33.3 %) | 1 (100.0 %) | 1 | 0 |",
                                *(f"| `standard` | `{told}` | 0 | 0 | 0 | 0 |" for told in random_worlds.TOLD)])
        worlds, text = self.judged("told.json", "--replicas")
        self.assertIn("asked again with 32 replicas", text)
        for world in worlds:
            self.assertEqual("screening" in world["told"], world["answers"]["screening"]["verdict"] == "stayed")

    def test_draws_of_worlds_near_their_limit(self):
        worlds = random_worlds.Group(self.options(), 0, self.folder).worlds
        for world, draws in zip(worlds, ((0, 2, 4), (4, 3, 2), ())):
            world.draws_beyond = dict(zip(random_worlds.ACCURACIES, draws))
        rows = random_worlds.draws_table(worlds, 4).splitlines()[-3:]
        self.assertEqual(rows, ["| `screening` | 4 (50.0 %) | 2 | 4 |", "| `standard` | 5 (62.5 %) | 1 | 2 |",
                                "| `reference` | 6 (75.0 %) | 0 | 0 |"])
        _, text = self.judged("drawn.json", "--draws", 2, "--seed", 1)
        self.assertRegex(text, r"\d worlds near their limit, 2 draws of each:")

    def test_worlds_that_disagree_are_kept_with_all_that_is_needed_to_simulate_them(self):
        group = random_worlds.Group(self.options(keep=self.folder / "kept"), 0, self.folder)
        for world in group.worlds:
            world.amplitude_g = 0.3
            world.answers = {accuracy: answer("stayed") for accuracy in ANSWERS}
        group.worlds[1].answers["reference"] = answer("moved", 1.1)
        group.worlds[1].answers[random_worlds.AGAIN] = answer("moved", 1.1)
        group.worlds[1].by_twice_the_limits = ["moved"] * 3
        group.keep()
        self.assertEqual([path.name for path in (self.folder / "kept").iterdir()], ["world_000001"])
        kept = self.folder / "kept/world_000001"
        self.assertEqual(json.loads((kept / "answers.json").read_text())["labels"][:2],
                         ["screening-beyond a limit at reference", "screening-unsafe clearly"])
        done = self.run_here("screen", "-c", kept / "config.ini", "--layouts", kept / "layout.txt", "--accelerations",
                             kept / "acceleration.txt", "--no-series", "--json", "--accuracy", "screening")
        self.assert_exit(done, 0)
        world = group.worlds[1]
        found = group.run("screening", [(world, 1.0, world.box_numbers())])[0]
        self.assertEqual(json.loads(done.stdout.splitlines()[0])["verdict"], found["verdict"])


if __name__ == "__main__":
    unittest.main()
