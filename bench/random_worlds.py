#!/usr/bin/python3
"""Random worlds: what screening and standard let pass, and what reference says of it.

Loads are heaps, columns, bridges and packings of 2 to 40 boxes of 1 to 100 kg, half of them with a play of 1 to 10 mm;
accelerations are steps, ramps, sines, lane changes, seas and noise of a truck; random_inputs.py makes them. Friction is
from 0.25 to 0.9. The amplitude of an acceleration is drawn from 0.75 to 1.25 of what the load holds of it, which a few
runs at screening find to about 15 %. So the worlds depend a little on the program; --amplitudes takes those of an
earlier run, so that two programs are compared on the same worlds.

Worlds near what they hold are chaotic, so reference is asked twice: of each world as it is, and with the acceleration
times 0.999. How often the second answer differs from the first is what no single run can do better than by chance, and is
counted like the answers of screening and standard.

A world that is let pass, and in which a box is beyond a limit at reference, is simulated at reference three times more:
with the acceleration times 0.998 and times 1.002, and with a random play of 0.1 mm. Where a box is beyond twice a limit
in all three, the world is clearly unsafe. A world that is rejected counts as held by half when no box uses up more than
half of a limit at reference.

Those counts are of few worlds. --draws tells a bias of an accuracy from chance: each world near its limit in which a box
moves, under an acceleration that goes to and fro, is simulated several times more at each accuracy, with accelerations
times 0.9925 to 1.0075. How many of all these draws are beyond a limit is counted, and how they differ from those of
reference, world by world: alike above and below where it is by chance.

--replicas asks each world that is let pass again, with 32 replicas whose accelerations spread by 0.75 %: what they tell of
it is counted as well.

Worlds do not depend on how many there are. --json is written after every 25 worlds, and --resume goes on from there.

Example: bench/random_worlds.py --worlds 1000 --keep disagreeing/ --json worlds.json
"""
import argparse
import collections
import concurrent.futures
import json
import random
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import random_inputs as inputs
from candidates import text_of as layout_text
from sampled_accelerations import GRAVITY
from sampled_accelerations import text_of as acceleration_text
from tables import replace_tables, table_of
from with_play import with_play

ROOT = Path(__file__).resolve().parent.parent
ACCURACIES = ("screening", "standard", "reference")
AGAIN, AGAIN_FACTOR = "reference-again", 0.999  # the second answer of reference, and what the acceleration is multiplied by
JUDGED = ("screening", "standard", AGAIN)  # answers that are compared with those of reference
LIMITS = {"peak_drop_m": 0.05, "peak_displacement_m": 0.1, "peak_tilt_deg": 10.0}
WORLDS_PER_CONFIGURATION = 25  # the program is started once for so many, per accuracy
LADDER = [0.05 * 1.28**level for level in range(15)]  # g: amplitudes that are tried, up to 1.6
SHARES = (0.75, 1.25)  # of what a load holds: amplitudes are drawn from here
NEAR = (1 / 1.2, 1 / 0.8)  # a world is near its limit when it holds this times its amplitude, and not that
KEPT = ("verdict", "status", "caveats", "critical_box", *LIMITS, "end_time_s", "cpu_seconds", "state_hash")  # of an answer
MOVES = 1e-3  # m
TO_AND_FRO = ("sine", "lane change", "sea", "truck noise")
DRAWS_SPREAD = 0.0075  # of the acceleration
REPLICAS = f"Replicas = 32\nFrictionSpread = 0\nAccelerationSpread = {DRAWS_SPREAD}\n"
TOLD = ("holds", "uncertain", "fails")  # by replicas
STIRS = 0.005  # of a limit: a world in which a box moves
PERTURBED = ((0.998, 0.0), (1.002, 0.0), (1.0, 0.1))  # factor of the acceleration, play in mm
REJECTED = ("moved", "fell")


@dataclass
class World:
    """One load under one acceleration, and what became of it."""

    index: int
    load: str
    acceleration: str
    friction: str
    play_mm: float
    boxes: int
    samples: int
    held_g: float = 0.0  # about what screening holds of this acceleration
    amplitude_g: float = 0.0
    near: bool = False
    answers: dict = field(default_factory=dict)  # by accuracy
    by_twice_the_limits: list = field(default_factory=list)  # verdicts of the perturbed worlds, at reference
    draws_beyond: dict = field(default_factory=dict)  # by accuracy: how many draws are beyond a limit
    told: dict = field(default_factory=dict)  # by accuracy: what replicas tell, where it is let pass
    layout: list = field(default_factory=list, repr=False)  # lines of the layout file, which --json does not keep
    shape: np.ndarray = field(default=None, repr=False)

    def box_numbers(self):
        return [list(map(float, line.split())) for line in self.layout[1:]]

    def perturbed(self, play):
        """The boxes with a random play, mm, along and across."""
        draw = random.Random(f"play {self.index}")
        half = play / 20
        lines = [with_play(line, play / 10, (draw.uniform(-half, half), draw.uniform(-half, half))) for line in self.layout[1:]]
        return [list(map(float, line.split())) for line in lines]

    def acceleration_file(self, factor=1.0):
        rows = self.shape.copy()
        rows[:, 2:] *= factor * self.amplitude_g * GRAVITY
        return acceleration_text(rows.tolist())

    def verdict(self, accuracy):
        return self.answers[accuracy]["verdict"]

    def row(self):
        """What --json keeps, and World(**row) makes again."""
        return {name: value for name, value in vars(self).items() if name not in ("layout", "shape")}

    def labels(self):
        """What is to be looked at: how the accuracies disagree, or fail."""
        found = [f"{accuracy}-failed" for accuracy in ACCURACIES if self.verdict(accuracy) == "failed"]
        for accuracy in JUDGED:
            found += [f"{accuracy}-{name}" for name, of in COUNTS.items() if name.startswith(("unsafe", "beyond", "held"))
                      and of(self, accuracy)]
        return found


def kept(answer):
    return {name: answer[name] for name in KEPT}


def used(answer):
    """The largest share of a limit that a box used up."""
    return max(answer[name] / limit for name, limit in LIMITS.items())


def passes(world, accuracy):
    return world.verdict(accuracy) == "stayed"


def beyond(world, accuracy):
    return passes(world, accuracy) and world.verdict("reference") in REJECTED


def clearly_unsafe(world, accuracy):
    return beyond(world, accuracy) and set(world.by_twice_the_limits) <= set(REJECTED)


def rejected(world, accuracy):
    return world.verdict(accuracy) in REJECTED


def held_by_half(world, accuracy):
    return rejected(world, accuracy) and passes(world, "reference") and used(world.answers["reference"]) < 0.5


def is_drawn(world):
    """Whether --draws simulates a world again."""
    return (world.acceleration in TO_AND_FRO and world.near and world.verdict("reference") in ("stayed", *REJECTED)
            and any(used(world.answers[accuracy]) > STIRS for accuracy in ACCURACIES))


COUNTS = {"let pass": passes, "beyond a limit at reference": beyond, "unsafe clearly": clearly_unsafe, "rejected": rejected,
          "held by half a limit at reference": held_by_half}


class Group:
    """Worlds of one configuration: one process of `holdfast serve` simulates all that an accuracy is asked at a time."""

    def __init__(self, options, number, folder):
        self.options, self.folder = options, Path(folder)
        self.friction, self.config = inputs.configuration(options.seed, number)
        first = number * WORLDS_PER_CONFIGURATION
        self.worlds = [self.drawn(index) for index in range(first, min(first + WORLDS_PER_CONFIGURATION, options.worlds))]

    def drawn(self, index):
        draw = random.Random(f"{self.options.seed} world {index}")
        load, acceleration = draw.choice(list(inputs.LOADS)), draw.choice(list(inputs.ACCELERATIONS))
        lines = layout_text(inputs.load(draw, load)).splitlines()
        play = round(draw.uniform(1, 10), 1) if draw.random() < 0.5 else 0.0
        if play:
            lines[1:] = [with_play(line, play / 10) for line in lines[1:]]
        shape = inputs.ACCELERATIONS[acceleration](draw)
        return World(index, load, acceleration, self.friction, play, len(lines) - 1, len(shape), layout=lines, shape=shape)

    def run(self, accuracy, cases, times=1, more=""):
        """The answers to (world, factor of its acceleration, boxes), in their order, by so many times the limits, with
        more keys of [Screening]."""
        if not cases:
            return []
        names, lines = [], []
        for world, factor, boxes in cases:
            names.append(f"{world.index:06}_{world.amplitude_g * factor:.6g}.txt")
            if not (path := self.folder / names[-1]).exists():
                path.write_text(world.acceleration_file(factor), encoding="ascii")
            lines.append(json.dumps({"accelerations": [names[-1]], "unit": "cm", "boxes": boxes}))
        drop, move, tilt = (times * limit for limit in LIMITS.values())
        config = self.folder / "config.ini"
        config.write_text(f"{self.config}[Simulation Settings]\nDropThreshold = {drop}\n[Screening]\nStopWhen = moved\n"
                          f"MoveThreshold = {move}\nTiltThreshold = {tilt}\n{more}", encoding="ascii")
        command = [self.options.holdfast, "serve", "-c", config, "--accuracy", accuracy, "--threads", "1", "--ordered",
                   "--accelerations", *(self.folder / name for name in dict.fromkeys(names))]
        done = subprocess.run([str(word) for word in command], input="\n".join(lines), capture_output=True, text=True, check=False)
        answers = [json.loads(line) for line in done.stdout.splitlines()]
        if done.returncode or len(answers) != len(cases) or any("error" in answer for answer in answers):
            sys.exit(done.stderr or f"an answer is missing or an error: {done.stdout[-300:]}")
        return [answer["verdicts"][0] for answer in answers]

    def verdicts(self, worlds, factor):
        """Whether each stays at screening, its acceleration times this; None where it does not stand."""
        cases = [(world, factor, world.box_numbers()) for world in worlds]
        known = {"stayed": True, "unstable": None}
        return [known.get(answer["verdict"], False) for answer in self.run("screening", cases)]

    def find_amplitudes(self):
        """Halves the ladder until it is known which step is the first that the load does not hold."""
        known = {world.index: (-1, len(LADDER)) for world in self.worlds}
        while opened := [world for world in self.worlds if known[world.index][1] - known[world.index][0] > 1]:
            for world in opened:
                world.amplitude_g = LADDER[sum(known[world.index]) // 2]
            for world, stays in zip(opened, self.verdicts(opened, 1.0)):
                low, high = known[world.index]
                middle = (low + high) // 2
                known[world.index] = (middle, high) if stays else (middle, middle) if stays is None else (low, middle)
        for world in self.worlds:
            low, high = known[world.index]
            world.held_g = (LADDER[max(low, 0)] * LADDER[min(high, len(LADDER) - 1)]) ** 0.5
            draw = random.Random(f"{self.options.seed} amplitude {world.index}")
            world.amplitude_g = float(f"{world.held_g * draw.uniform(*SHARES):.4g}")

    def judge(self, amplitudes):
        """Fills in all that is known of the worlds."""
        if amplitudes:
            for world in self.worlds:
                world.held_g, world.amplitude_g = amplitudes[world.index]
        else:
            self.find_amplitudes()
        for world, holds, above in zip(self.worlds, *(self.verdicts(self.worlds, factor) for factor in NEAR)):
            world.near = holds is True and above is False
        for accuracy in ACCURACIES:
            answers = self.run(accuracy, [(world, 1.0, world.box_numbers()) for world in self.worlds])
            for world, answer in zip(self.worlds, answers):
                world.answers[accuracy] = kept(answer)
        again = self.run("reference", [(world, AGAIN_FACTOR, world.box_numbers()) for world in self.worlds])
        for world, answer in zip(self.worlds, again):
            world.answers[AGAIN] = kept(answer)
        doubtful = [world for world in self.worlds if any(beyond(world, accuracy) for accuracy in JUDGED)]
        cases = [(world, factor, world.perturbed(play) if play else world.box_numbers())
                 for world in doubtful for factor, play in PERTURBED]
        for (world, _, _), answer in zip(cases, self.run("reference", cases, 2)):
            world.by_twice_the_limits.append(answer["verdict"])
        if self.options.draws:
            self.draw_again(self.options.draws)
        if self.options.replicas:
            self.ask_replicas()
        if self.options.keep:
            self.keep()

    def draw_again(self, count):
        """Simulates worlds near their limit so many times more, at each accuracy."""
        worlds = [world for world in self.worlds if is_drawn(world)]
        factors = [1 + DRAWS_SPREAD * (2 * draw / (count - 1) - 1) for draw in range(count)]
        for accuracy in ACCURACIES:
            answers = self.run(accuracy, [(world, factor, world.box_numbers()) for world in worlds for factor in factors])
            for i, world in enumerate(worlds):
                of_world = answers[i * count:(i + 1) * count]
                world.draws_beyond[accuracy] = sum(answer["verdict"] in REJECTED for answer in of_world)

    def ask_replicas(self):
        """Asks the worlds that are let pass again, with replicas."""
        for accuracy in ACCURACIES[:2]:
            worlds = [world for world in self.worlds if passes(world, accuracy)]
            answers = self.run(accuracy, [(world, 1.0, world.box_numbers()) for world in worlds], more=REPLICAS)
            for world, answer in zip(worlds, answers):
                world.told[accuracy] = answer["replicas"]["verdict"]

    def keep(self):
        """Writes the files of worlds in which the accuracies disagree, or one fails."""
        for world in self.worlds:
            if labels := world.labels():
                folder = self.options.keep / f"world_{world.index:06}"
                folder.mkdir(parents=True, exist_ok=True)
                (folder / "layout.txt").write_text("\n".join(world.layout) + "\n", encoding="ascii")
                (folder / "acceleration.txt").write_text(world.acceleration_file(), encoding="ascii")
                (folder / "config.ini").write_text(self.config, encoding="ascii")
                (folder / "answers.json").write_text(json.dumps(world.row() | {"labels": labels}, indent=1) + "\n")


def judged_worlds(worlds, accuracy):
    """Worlds of which both this accuracy and reference say something."""
    return [world for world in worlds if not {world.verdict(accuracy), world.verdict("reference")} & {"unstable", "failed"}]


def share(part, whole):
    return f"{part} ({100 * part / whole:.1f} %)" if whole else f"{part}"


def counts_table(worlds, accuracy):
    judged = judged_worlds(worlds, accuracy)
    kinds = {"acceleration": "acceleration", "load": "load", "friction": "friction"}
    groups = {f"{word}: {value}": [world for world in judged if getattr(world, name) == value]
              for name, word in kinds.items() for value in sorted({getattr(world, name) for world in judged})}
    groups["without play"] = [world for world in judged if not world.play_mm]
    groups["with 1 to 10 mm of play"] = [world for world in judged if world.play_mm]
    groups["all"] = judged
    rows = []
    for name, members in groups.items():
        counts = {what: sum(of(world, accuracy) for world in members) for what, of in COUNTS.items()}
        passed, outside, unsafe, refused, held = counts.values()
        rows.append([name, str(len(members)), share(passed, len(members)), share(outside, passed), share(unsafe, passed),
                     share(refused, len(members)), share(held, refused)])
    head = ["worlds", "judged", "let pass", "of these beyond a limit at reference", "clearly unsafe", "rejected",
            "of these held by half a limit at reference"]
    name = f"`reference` with {AGAIN_FACTOR} times the acceleration" if accuracy == AGAIN else f"`{accuracy}`"
    return table_of(f"{name} against `reference`:", head, rows)


def apart_table(worlds):
    rows = []
    for accuracy in ACCURACIES:
        seconds = [world.answers[accuracy]["cpu_seconds"] for world in worlds]
        rows.append([f"`{accuracy}`", *(str(sum(world.verdict(accuracy) == verdict for world in worlds))
                                        for verdict in ("unstable", "failed")),
                     f"{1e3 * statistics.mean(seconds):.1f} ms", f"{1e3 * statistics.median(seconds):.1f} ms",
                     f"{1e3 * max(seconds):.0f} ms"])
    return table_of("Counted apart, and processor time of a world, which ends when a box is beyond a limit:",
                    ["accuracy", "does not stand", "failed", "mean", "median", "largest"], rows)


def caveats_table(worlds):
    """How many worlds have each caveat, and of how many of these a verdict is wrong."""
    rows = []
    for accuracy in ACCURACIES:
        having = collections.defaultdict(list)
        for world in worlds:
            for caveat in world.answers[accuracy]["caveats"].split("+"):
                having[caveat].append(world)
        for caveat in sorted(filter(None, having)):
            row = [f"`{caveat}`", f"`{accuracy}`", share(len(having[caveat]), len(worlds))]
            for of in (passes, beyond, clearly_unsafe):
                row.append(str(sum(of(world, accuracy) for world in having[caveat])) if accuracy != "reference" else "")
            rows.append(row)
    return table_of("Caveats:", ["caveat", "accuracy", "worlds", "let pass", "beyond a limit at reference", "clearly unsafe"], rows)


def draws_table(worlds, count):
    """How many draws are beyond a limit at each accuracy, and how they differ from those of reference."""
    drawn = [world.draws_beyond for world in worlds if world.draws_beyond]
    rows = []
    for accuracy in ACCURACIES:
        differences = [draws[accuracy] - draws["reference"] for draws in drawn]
        total = sum(draws[accuracy] for draws in drawn)
        rows.append([f"`{accuracy}`", share(total, count * len(drawn)), str(sum(max(0, d) for d in differences)),
                     str(sum(max(0, -d) for d in differences))])
    return table_of(f"{len(drawn)} worlds near their limit, {count} draws of each:",
                    ["accuracy", "beyond a limit", "more than at reference", "fewer than at reference"], rows)


def replicas_table(worlds):
    """What replicas tell of the worlds that are let pass, and what reference says of these."""
    rows = []
    for accuracy in ACCURACIES[:2]:
        passed = [world for world in judged_worlds(worlds, accuracy) if passes(world, accuracy)]
        for told in TOLD:
            members = [world for world in passed if world.told[accuracy] == told]
            half = sum(passes(world, "reference") and used(world.answers["reference"]) < 0.5 for world in members)
            rows.append([f"`{accuracy}`", f"`{told}`", share(len(members), len(passed)),
                         share(sum(beyond(world, accuracy) for world in members), len(members)),
                         str(sum(clearly_unsafe(world, accuracy) for world in members)), str(half)])
    return table_of("Worlds that are let pass, asked again with 32 replicas:",
                    ["accuracy", "told", "worlds", "beyond a limit at reference", "clearly unsafe",
                     "held by half a limit at reference"], rows)


def draw_lines(worlds):
    """How well the worlds were drawn."""
    standing = [world for world in worlds if world.verdict("screening") not in ("unstable", "failed")]
    accepted = [world for world in standing if passes(world, "screening")]
    moving = sum(world.answers["screening"]["peak_displacement_m"] > MOVES for world in accepted)
    boxes = statistics.mean(world.boxes for world in worlds)
    samples = statistics.mean(world.samples for world in worlds)
    return (f"{len(worlds)} worlds, {boxes:.1f} boxes and {samples:.0f} samples each on average. Within 20 % of what they hold are "
            f"{share(sum(world.near for world in standing), len(standing))} of those that stand. A box moves by more than "
            f"{1e3 * MOVES:g} mm in {share(moving, len(accepted))} of those that `screening` lets pass.")


def judged_group(options, number, amplitudes, known):
    """The worlds of a group; those that are known are not judged again."""
    with tempfile.TemporaryDirectory(prefix="holdfast-worlds-") as folder:
        group = Group(options, number, folder)
        indices = [world.index for world in group.worlds]
        if known.keys() >= set(indices):
            return [known[index] for index in indices]
        group.judge(amplitudes)
    return group.worlds


def all_worlds(options, amplitudes, known):
    """The worlds, judged, in their order; tells how far it is on standard error."""
    worlds = []
    numbers = range(-(-options.worlds // WORLDS_PER_CONFIGURATION))
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for members in pool.map(lambda number: judged_group(options, number, amplitudes, known), numbers):
            worlds += members
            if options.json:
                written = options.json.with_suffix(".part")
                written.write_text(json.dumps({"seed": options.seed, "draws": options.draws, "replicas": options.replicas,
                                               "worlds": [world.row() for world in worlds]}, indent=0) + "\n")
                written.rename(options.json)
            if not options.quiet:
                print(f"{len(worlds)} of {options.worlds} worlds", file=sys.stderr, flush=True)
    return worlds


def worlds_of(parser, path, **same):
    """The worlds that --json wrote there, by index, of a run in which these options were the same."""
    known = json.loads(path.read_text())
    for name, value in same.items():
        if known.get(name) != value:
            parser.error(f"{path}: is of --{name} {known.get(name)}")
    return {row["index"]: World(**row) for row in known["worlds"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", type=int, default=200, help="how many (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other worlds (default: %(default)s)")
    parser.add_argument("--holdfast", type=Path, default=ROOT / "build/release/bin/holdfast", help="default: %(default)s")
    parser.add_argument("--jobs", type=int, default=1, help="processes at a time, of one thread each (default: %(default)s)")
    parser.add_argument("--json", type=Path, metavar="OUT", help="write all worlds there")
    parser.add_argument("--resume", action="store_true", help="keep the worlds that --json has of an earlier run of this program")
    parser.add_argument("--amplitudes", type=Path, metavar="JSON", help="take the amplitudes from what --json wrote there, with "
                        "the same seed and at least as many worlds")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="write layout, acceleration and configuration of the worlds "
                        "there in which the accuracies disagree, or one fails")
    parser.add_argument("--into", type=Path, metavar="PAGE", help="page whose tables are replaced, such as docs/evidence/validation.md")
    parser.add_argument("--draws", type=int, default=0, metavar="N", help="how often each world near its limit is simulated "
                        "again, at each accuracy, from 2 on (default: not)")
    parser.add_argument("--replicas", action="store_true", help="ask each world that is let pass again, with replicas")
    parser.add_argument("--quiet", action="store_true", help="do not tell how far it is")
    options = parser.parse_args()
    if options.worlds < 1 or options.jobs < 1:
        parser.error("--worlds and --jobs are from 1 on")
    if options.draws == 1 or options.draws < 0:
        parser.error("--draws is from 2 on")
    known = {}
    if options.resume and options.json and options.json.exists():
        known = worlds_of(parser, options.json, seed=options.seed, draws=options.draws, replicas=options.replicas)
    amplitudes = None
    if options.amplitudes:
        earlier = worlds_of(parser, options.amplitudes, seed=options.seed)
        amplitudes = {index: (world.held_g, world.amplitude_g) for index, world in earlier.items()}
        if len(amplitudes) < options.worlds:
            parser.error(f"{options.amplitudes}: has fewer worlds")
    worlds = all_worlds(options, amplitudes, known)
    tables = {"random worlds: drawn": draw_lines(worlds),
              **{f"random worlds: {accuracy}": counts_table(worlds, accuracy) for accuracy in JUDGED},
              "random worlds: apart": apart_table(worlds), "random worlds: caveats": caveats_table(worlds)}
    if options.draws:
        tables["random worlds: draws"] = draws_table(worlds, options.draws)
    if options.replicas:
        tables["random worlds: replicas"] = replicas_table(worlds)
    print("\n\n".join(tables.values()))
    if options.into:
        replace_tables(options.into, tables)


if __name__ == "__main__":
    main()
