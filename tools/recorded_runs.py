"""What same_results.py runs: every analysis, engine and command of the program on the bundled inputs and some small ones.

Each run has a folder of its own, in which all that it writes is kept. Inputs are in the folder `inputs` beside it, so
that paths are the same whatever the place.
"""
import fnmatch
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time

import h5py

from results_listing import masked

SOURCE = pathlib.Path(__file__).resolve().parent.parent
FEW = ("seed_example.txt", "BR0_012_block.txt", "BR8_009_layer_h60.txt", "unstable_BR2_007_bpjs.txt")
LAYOUTS, ACCELERATIONS, SMALL = "--layouts ../inputs/layouts", "--accelerations ../inputs/accelerations", "--layouts ../inputs/small"
FEW_LAYOUTS = "--layouts ../inputs/few"
SHORT = "--accelerations ../inputs/push.txt ../inputs/rest.txt"
UNUSABLE = ("0_outside.txt", "1_words.txt", "2_empty.txt", "3_overlap.txt")
UNUSABLE_LAYOUTS = "--layouts " + " ".join(f"../inputs/unusable/{name}" for name in UNUSABLE)
EVERYTHING = "--margins --replicas 27 --walls en283 --damage --indicators"
QUICK = "--accuracy screening"

# Name: arguments of `holdfast screen`. `summary` judges each result again.
SCREENINGS = {
    "road": f"{QUICK} {LAYOUTS} --norm road",
    "road_without_series": f"{QUICK} {LAYOUTS} --norm road --no-series",
    "accelerations": f"{QUICK} {LAYOUTS} {ACCELERATIONS}",
    "accelerations_without_series": f"{QUICK} {LAYOUTS} {ACCELERATIONS} --no-series",
    "norm_and_accelerations": f"{QUICK} {FEW_LAYOUTS} {ACCELERATIONS} --norm sea-b",
    "rail": f"{QUICK} {FEW_LAYOUTS} --norm rail-en12195",
    "eumos": f"{QUICK} {FEW_LAYOUTS} --norm eumos-40509:0.5",
    "settled": f"{QUICK} -c ../inputs/demo.ini {LAYOUTS} --norm road",
    "standard": f"{FEW_LAYOUTS} --norm road",
    "all_settings": f"-c ../inputs/all_settings.ini {FEW_LAYOUTS} {ACCELERATIONS}",
    "sleeping": f"{QUICK} -c ../inputs/sleeping.ini {FEW_LAYOUTS} --norm road",
    "axes": f"{QUICK} -c ../inputs/axes.ini --layouts ../inputs/layouts/seed_example.txt {ACCELERATIONS}",
    "margins": f"{QUICK} {LAYOUTS} --norm road --margins",
    "replicas": f"{QUICK} {FEW_LAYOUTS} --norm road --replicas 32",
    "margin_spread": f"{QUICK} {FEW_LAYOUTS} --norm road --replicas 27 --margins --no-series",
    "acceleration_spread": f"{QUICK} -c ../inputs/spread.ini {FEW_LAYOUTS} --norm road",
    "wall_forces": f"{QUICK} {LAYOUTS} --norm road --wall-forces",
    "wall_norm": f"{QUICK} {LAYOUTS} --norm road --walls en12642-xl",
    "damage": f"{QUICK} {LAYOUTS} --norm road --damage",
    "indicators": f"{QUICK} {LAYOUTS} --norm road --indicators",
    "load_shift": f"{QUICK} {LAYOUTS} --norm road --load-shift",
    "everything": f"{QUICK} {FEW_LAYOUTS} --norm road {EVERYTHING}",
    "everything_without_series": f"{QUICK} {FEW_LAYOUTS} --norm road {EVERYTHING} --no-series --stop-when moved",
    "stop_when_moved": f"{QUICK} {LAYOUTS} --norm road --stop-when moved",
    "stop_when_fallen": f"{QUICK} {LAYOUTS} --norm road --stop-when fallen --walls iso-container",
    "first_failure": f"{QUICK} {LAYOUTS} --norm road --first-failure",
    "first_failure_and_moved": f"{QUICK} {SMALL} {SHORT} --first-failure --stop-when moved --no-series",
    "unusable": f"{QUICK} {UNUSABLE_LAYOUTS} ../inputs/few --accelerations ../inputs/unusable_accelerations/words.txt ../inputs/push.txt {EVERYTHING}",
    "parts": f"{QUICK} {SMALL} {SHORT} --damage --walls en283 --indicators",
    "bullet": f"{FEW_LAYOUTS} --accelerations ../inputs/push.txt ../inputs/rest.txt --engine bullet --damage --indicators",
    "bullet_stock": f"{FEW_LAYOUTS} --accelerations ../inputs/push.txt --engine bullet-stock",
    "bullet_f64": "--layouts ../inputs/layouts/seed_example.txt --norm road --engine bullet-f64 --stop-when fallen",
    "native_plain": "--layouts ../inputs/pair --accelerations ../inputs/push.txt --engine native-plain --damage",
}
# Only with --all, after those above.
LONGER_SCREENINGS = {
    "longer_standard": f"{LAYOUTS} --norm road",
    "longer_reference": f"{FEW_LAYOUTS} --norm road --accuracy reference",
    "longer_demo": f"-c ../inputs/demo.ini {LAYOUTS} {ACCELERATIONS}",
    "longer_bench": f"{QUICK} --layouts ../inputs/bench --norm road --margins --walls en283 --damage --indicators",
    "longer_bench_standard": "--layouts ../inputs/bench --norm road --no-series",
    "longer_replicas": f"{QUICK} {LAYOUTS} --norm road --replicas 27 --no-series",
    "longer_bullet": f"{FEW_LAYOUTS} --norm road --engine bullet",
    "longer_bullet_stock": f"{LAYOUTS} --norm road --engine bullet-stock --no-series",
    "longer_native_plain": "--layouts ../inputs/layouts/seed_example.txt --norm road --engine native-plain",
}
ENGINES = {"bullet": "bullet", "bullet_stock": "bullet-stock", "bullet_f64": "bullet-f64", "config_pair": "bullet",
           "longer_bullet": "bullet", "longer_bullet_stock": "bullet-stock"}

SMALL_BEFORE_LARGE = 256  # as many worlds as a part has at most
PUSH = "0 0.1 0 0 0\n0.1 0.4 3 6 0\n"
SHAKES = "".join(f"{0.25 * i:g} 0.25 {(-1) ** i * 5} {(-1) ** (i // 2) * 3} 0\n" for i in range(20))
CONFIGS = {
    "all_settings.ini": """\
[Physics Engine]
ConstantDensity = false
DensityValue = 40
[Export Settings]
ResultsIntervallInSeconds = 0.25
[Simulation Settings]
TimeoutInSeconds = 1.3
DropThreshold = 0.02
[Container]
OpenSides = rear roof
[Contact]
Restitution = 0.2
FrictionModel = pairs
BoxBox = 0.4
BoxFloor = timber-plywood
BoxWall = 0.3
KineticFriction = 0.75
[Material 1]
Density = 300
Restitution = 0.1
CentreOfMass = 3 -2 4
[Screening]
SettleSeconds = 0.5
ReferencePose = layout
Damage = true
DamageWindow = 10
CriticalAcceleration = 5
WallForces = true
[Native]
Accuracy = screening
StepsPerSecond = 120
Sleep = false
ImpactCuts = 2
""",
    "sleeping.ini": "[Simulation Settings]\nStoppingCondition = sleeping\nTimeoutInSeconds = 4\n",
    "axes.ini": "[Container]\nUpAxis = y\nLength = 600\nWidth = 240\nHeight = 230\n[Screening]\nGravity = 9.8\n",
    "spread.ini": "[Screening]\nReplicas = 27\nFrictionSpread = 0.2\nAccelerationSpread = 0.1\nPlayShift = 0.02\nSettleSeconds = 0.5\nRunOutSeconds = 0.5\n",
    "batch.ini": "[Export Settings]\nSavePath = saved\n[Simulation Settings]\nBatchSimulation = true\nBatchPath = ../inputs/batch\n"
                 "[Screening]\nNorm = road\n[Native]\nAccuracy = screening\n",
    "pair.ini": "[Export Settings]\nSavePath = saved\n[Simulation Settings]\nTimeoutInSeconds = 1.5\n[Container]\nMotion = free\n[Screening]\n"
                "Engine = bullet\nLayout = ../inputs/layouts/seed_example.txt\nAcceleration = ../inputs/accelerations/seed_example.txt\n",
    "wrong.ini": "[Screening]\nThreshold = 1\nMoveThreshold = far\n",
}


def layout_text(boxes):
    return "\n".join([f"1 {len(boxes)}", *("\t".join(map(str, (*box, 1))) for box in boxes), ""])


def write_inputs(folder):
    """The bundled inputs, and small ones that are made here."""
    for name in ("layouts", "accelerations"):
        shutil.copytree(SOURCE / "configs" / name, folder / name)
    shutil.copytree(SOURCE / "bench/layouts", folder / "bench")
    shutil.copy(SOURCE / "configs/demo.ini", folder)
    for name in FEW:
        (folder / "few").mkdir(exist_ok=True)
        shutil.copy(folder / "layouts" / name, folder / "few")
    texts = {**CONFIGS, "push.txt": PUSH, "rest.txt": "0 0.1 0 0 0\n", "shakes/shakes.txt": SHAKES,
             "pair/pair.txt": layout_text([(0, 0, 0, 80, 60, 90), (100, 20, 0, 160, 80, 50), (100, 20, 50, 150, 70, 110)]),
             **{f"unusable/{name}": text for name, text in zip(UNUSABLE, (
                 layout_text([(0, 0, 0, 1000, 10, 10)]), "no layout\n", "", layout_text([(0, 0, 0, 80, 60, 90), (20, 0, 0, 90, 60, 90)])))},
             "unusable_accelerations/words.txt": "0 1 fast 0 0\n"}
    draw = random.Random(7)
    for i in range(300):
        boxes = [(30 * k, 10, 0, 30 * k + 20, 30, draw.randint(10, 90)) for k in range(draw.randint(1, 4))]
        texts[f"small/{i:04}.txt"] = layout_text(boxes)
        if i < SMALL_BEFORE_LARGE:
            texts[f"then_large/{i:04}.txt"] = layout_text(boxes[:1])
    for i in range(130):
        texts[f"many_accelerations/{i:03}.txt"] = f"0 0.05 {i % 5} {i % 3} 0\n"
    for name, text in texts.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    for name in FEW[1:]:
        shutil.copy(folder / "layouts" / name, folder / "then_large" / f"large_{name}")
    shutil.copytree(folder / "pair", folder / "batch")
    shutil.copy(folder / "push.txt", folder / "batch/push.txt")


class Run:
    """A folder in which the program runs; what it prints is kept there, and its exit codes."""

    def __init__(self, program, folder, threads):
        self.program, self.folder, self.threads = program, folder, threads
        self.commands = 0
        folder.mkdir(parents=True)

    def start(self, *words, **options):
        # Called by its bare name, so that its path is not in what it writes.
        return subprocess.Popen(["holdfast", *words], executable=self.program, cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, encoding="utf-8", errors="surrogateescape",
                                env={**os.environ, "COLUMNS": "120"}, **options)

    def keep(self, name, text):
        (self.folder / name).write_text(masked(text, name), encoding="utf-8", errors="surrogateescape")

    def note(self, text):
        with (self.folder / "commands.txt").open("a") as file:
            file.write(masked(text + "\n"))

    def holdfast(self, arguments, threads=True, text=None):
        """Runs a command to its end and keeps what it prints."""
        words = arguments.split() + (["--threads", str(self.threads)] if threads else [])
        process = self.start(*words, stdin=subprocess.PIPE)
        out, err = process.communicate(text or "")
        self.commands += 1
        name = f"{self.commands}_{words[0].lstrip('-')}"
        self.keep(f"{name}.out.txt", out)
        self.keep(f"{name}.err.txt", err)
        self.note(f"holdfast {' '.join(words)}: exit code {process.returncode}")

    def screen(self, arguments):
        self.holdfast(f"screen {arguments} -o results.h5")

    def mask_files(self, pattern):
        """What the program itself has written as text."""
        for path in sorted(self.folder.glob(pattern)):
            self.keep(path.relative_to(self.folder).as_posix(), path.read_text(encoding="utf-8", errors="surrogateescape"))


def judge_again(run):
    run.holdfast("summary results.h5 --move-threshold 0.05 --tilt-threshold 5 --drop-threshold 0.02 --csv tables -o judged.h5", threads=False)
    run.mask_files("tables/*.csv")


def screening(arguments):
    def run_it(run):
        run.screen(arguments)
        judge_again(run)
    return run_it


def text_files(run):
    run.screen(f"{QUICK} {FEW_LAYOUTS} --norm road --text texts --costs costs.json")
    run.mask_files("costs.json")


def json_lines(run):
    run.threads = 1  # lines come as worlds finish
    run.screen(f"{QUICK} {LAYOUTS} --norm road --json --quiet")
    run.holdfast(f"screen {QUICK} --layouts ../inputs/pair ../inputs/few/{FEW[2]} --norm road {EVERYTHING} --json --quiet -o everything.h5")
    run.holdfast(f"screen {QUICK} {UNUSABLE_LAYOUTS} ../inputs/pair {SHORT} --first-failure --json --quiet -o unusable.h5")


def margins_command(run):
    run.holdfast(f"margins {QUICK} {LAYOUTS} -o results.h5")
    run.holdfast(f"margins {QUICK} {FEW_LAYOUTS} --norm road --replicas 27 -o with_norm.h5")
    judge_again(run)


def requests():
    """Lines for `serve`: boxes in both units, all that can be asked for, and what cannot be used."""
    lines = []
    for name in FEW[:3]:
        rows = [[float(word) for word in row.split()] for row in (SOURCE / "configs/layouts" / name).read_text().splitlines()[1:]]
        lines.append(json.dumps({"id": name, "boxes": rows, "unit": "cm"}))
        lines.append(json.dumps({"id": [name], "boxes": rows, "unit": "cm", "per_box": True, "series": True, "accelerations": ["road-rear-0g5"]}))
    lines.append(json.dumps({"boxes": [[0, 0, 0, 0.8, 0.6, 1.0, 1]], "per_box": True}))
    lines += [json.dumps({"id": 1, "boxes": [[0, 0, 0, 80, 0.6, 1.0, 1]]}), json.dumps({"id": 2, "boxes": [[0, 0, 1]]}), "no JSON", "{}",
              json.dumps({"id": 3, "boxes": [[0, 0, 0, 1, 1, 1, 1]], "accelerations": ["none"]})]
    return "\n".join(lines) + "\n"


def serve(run):
    run.holdfast(f"serve {QUICK} --norm road --ordered", text=requests())
    run.holdfast(f"serve -c ../inputs/all_settings.ini {SHORT} --ordered", text=requests())


def shards(run):
    for part in (1, 2, 3):
        run.holdfast(f"screen {QUICK} {SMALL} {SHORT} --damage -o results.h5 --part {part}/3")
    run.holdfast("merge results.h5")
    judge_again(run)


def shards_of_everything(run):
    arguments = (f"screen {QUICK} --layouts ../inputs/few/BR8_009_layer_h60.txt ../inputs/pair ../inputs/unusable/0_outside.txt "
                 f"--accelerations ../inputs/many_accelerations {EVERYTHING} -o results.h5")
    for part in (1, 2):
        run.holdfast(f"{arguments} --part {part}/2")
    run.holdfast("merge results.h5")
    judge_again(run)


def worlds_of(part):
    if not part.exists():
        return 0
    with h5py.File(part, "r") as file:
        return len(file["worlds/layout"])


def stop_after_first_part(run, arguments, stop_signal):
    """Stops a run once its first part is on disk; it is closed after 256 worlds, or sooner where they take more than 2 s."""
    part = run.folder / "results.h5.parts/part-000001.h5"
    for _ in range(5):
        shutil.rmtree(part.parent, ignore_errors=True)
        process = run.start(*arguments.split(), "--threads", str(run.threads), stdin=subprocess.DEVNULL)
        while process.poll() is None and not part.exists():
            time.sleep(0.005)
        if process.poll() is None:
            process.send_signal(stop_signal)
        process.communicate()
        if worlds_of(part) == SMALL_BEFORE_LARGE:
            shutil.copy(part, run.folder / "first_part.h5")
            break
    run.note(f"stopped by {stop_signal.name}: exit code {process.returncode}")


def resumed(stop_signal, more=""):
    """A run of one part and worlds that take longer, in which it is stopped; then it is resumed."""
    def run_it(run):
        arguments = f"screen {QUICK} --layouts ../inputs/then_large --accelerations ../inputs/shakes {more} -o results.h5"
        stop_after_first_part(run, arguments, stop_signal)
        run.holdfast(f"{arguments} --resume --quiet")
        judge_again(run)
    return run_it


def config_batch(run):
    run.holdfast("run ../inputs/batch.ini")


def config_pair(run):
    run.holdfast("run ../inputs/pair.ini")


def report(run):
    run.screen(f"{QUICK} {LAYOUTS} --norm road --margins --walls en12642-l --quiet")
    run.holdfast("report results.h5 -o report.html --most 5", threads=False)
    run.mask_files("report.html")


def pages(run):
    for page in ("--config-page", "--norms-page", "--results-page", "--help-config", "--man-page", "--bash-completion", "--help", "norms"):
        run.holdfast(page, threads=False)
    for command in ("screen", "run", "margins", "serve", "merge", "summary", "report", "view", "check", "bench", "validate"):
        run.holdfast(f"{command} --help", threads=False)


def checks(run):
    run.holdfast("check ../inputs/layouts ../inputs/accelerations ../inputs/demo.ini", threads=False)
    run.holdfast("check ../inputs/unusable ../inputs/unusable_accelerations ../inputs/wrong.ini", threads=False)


def refusals(run):
    for arguments in (f"screen {LAYOUTS}", f"screen {LAYOUTS} --norm rode", f"screen {LAYOUTS} --norm road --engine nativ",
                      f"screen -c ../inputs/wrong.ini {LAYOUTS} --norm road", "screen --layouts ../inputs/none --norm road",
                      f"screen {LAYOUTS} --norm road --part 3/2", f"screen {LAYOUTS} --norm road --text t --no-series",
                      f"screen {LAYOUTS} --norm road --replicas 3", "summary ../inputs/demo.ini", "merge none.h5", "scren", "screen --layout x",
                      "run ../inputs/demo.ini"):
        run.holdfast(arguments, threads=False)


OTHER_RUNS = {
    "text_files": text_files, "json_lines": json_lines, "margins_command": margins_command, "serve": serve, "shards": shards,
    "shards_of_everything": shards_of_everything, "interrupted": resumed(signal.SIGINT), "terminated": resumed(signal.SIGTERM, "--indicators"),
    "config_batch": config_batch, "config_pair": config_pair, "report": report, "pages": pages, "checks": checks, "refusals": refusals,
}


def all_runs(longer):
    """Functions by the names of the runs."""
    runs = {name: screening(arguments) for name, arguments in SCREENINGS.items()} | OTHER_RUNS
    if longer:
        runs |= {name: screening(arguments) for name, arguments in LONGER_SCREENINGS.items()}
    return runs


def chosen_runs(patterns, longer):
    """Those whose name matches one of the patterns; all of the set without patterns."""
    runs = all_runs(longer or bool(patterns))
    return {name: act for name, act in runs.items() if not patterns or any(fnmatch.fnmatch(name, pattern) for pattern in patterns)}


def missing_engines(program):
    done = subprocess.run([program, "engines"], stdout=subprocess.PIPE, encoding="utf-8", check=False)
    return {line.split()[0] for line in done.stdout.splitlines() if line.split()[1:2] == ["missing:"]}
