"""What the tests of the command line share: running the program, writing small inputs, comparing results files.

The environment variable HOLDFAST names the program. Run a file by hand with
HOLDFAST=build/release/bin/holdfast /usr/bin/python3 tests/app/test_screen.py
"""
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HOLDFAST = str(pathlib.Path(os.environ.get("HOLDFAST", SOURCE / "build/release/bin/holdfast")).resolve())
SEED_LAYOUT = SOURCE / "configs/layouts/seed_example.txt"
SEED_ACCELERATION = SOURCE / "configs/accelerations/seed_example.txt"
SANITIZED = bool(os.environ.get("HOLDFAST_SANITIZED"))
PATIENCE = 600 if SANITIZED else 60  # s that a program may take before a test gives it up
# What runs before a release and not for every change, `.ci/slow`: more random kills, wrong bytes and generated layouts.
THOROUGH = os.environ.get("HOLDFAST_THOROUGH") == "1"

CONFIG = """\
[Physics Engine]
SimulationStepsPerSecond = 60
[Screening]
Engine = bullet-stock
"""
# Worlds begin and end with their acceleration, as those of `holdfast run` do.
AT_ONCE = "[Screening]\nSettleSeconds = 0\nRunOutSeconds = 0\n"
# Stands, moves with increasing force, ends while all is in motion.
SHOVE = "#Initial-Time / Duration / X / Y / Z\n0 0.25 0 0 0\n0.25 0.5 8 0 0\n0.75 0.27 2 -7 0\n"
REST = "#Initial-Time / Duration / X / Y / Z\n0 1 0 0 0\n"

SEED = [(0, 0, 0, 80, 59, 106), (80, 0, 0, 160, 59, 106), (80, 0, 106, 160, 59, 212)]
TOWER = [(200, 100, 40 * i, 230, 130, 40 * (i + 1)) for i in range(5)]
FLOATING = [(0, 0, 0, 80, 60, 100), (200, 100, 60, 280, 160, 120)]


def some(cases, every=3):
    """A part of the cases, spread over all of them; all where tests are thorough."""
    cases = list(cases)
    return cases if THOROUGH else cases[::every]



def layout_text(boxes, material=1):
    """A layout file; boxes are two opposite corners in cm."""
    lines = ["\t".join(f"{value:g}" for value in (*box, material)) for box in boxes]
    return "\n".join([f"1 {len(boxes)}", *lines, ""])


def run(*arguments, program=HOLDFAST, **options):
    """Runs the program to its end; standard output and standard error are text."""
    options = {"stdin": subprocess.DEVNULL if "input" not in options else None, "timeout": PATIENCE, **options}
    return subprocess.run([str(program), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          encoding="utf-8", errors="surrogateescape", check=False,
                          **{key: value for key, value in options.items() if value is not None})


def start(*arguments, **options):
    """Starts the program and does not wait for its end."""
    return subprocess.Popen([HOLDFAST, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            **{"stderr": subprocess.PIPE, "encoding": "utf-8", **options})


def schedulers():
    """The schedulers that were built, as the program lists them."""
    refused = run("screen", "--scheduler", "none", "--layouts", SEED_LAYOUT, "--accelerations", SEED_ACCELERATION)
    return refused.stderr.strip().split("accepted are ")[1].split(", ")


def wait_for(condition, process=None):
    """Waits until the condition holds; fails when the process ends before."""
    end = time.monotonic() + PATIENCE
    while not condition():
        if process is not None and process.poll() is not None:
            raise AssertionError(f"the program ended too early: {process.communicate()}")
        if time.monotonic() > end:
            raise AssertionError("waited in vain")
        time.sleep(0.01)


def datasets(path, groups=("/",)):
    """All datasets below the groups of an HDF5 file, by name."""
    found = {}

    def take(item):
        if isinstance(item, h5py.Dataset):
            found[item.name] = item[()]

    with h5py.File(path, "r") as file:
        for group in groups:
            file[group].visititems(lambda _, item: take(item))
    return found


def same_bits(a, b):
    """Whether two values of datasets are the same, NaN included."""
    a, b = np.asarray(a), np.asarray(b)
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


class CliTest(unittest.TestCase):
    """A test with a folder of its own, in which the program runs."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="holdfast-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def write_inputs(self):
        """A configuration, three layouts and two accelerations: what most tests need."""
        self.config = self.write("config.ini", CONFIG)
        self.layouts = [self.write("seed.txt", layout_text(SEED)), self.write("tower.txt", layout_text(TOWER)),
                        self.write("floating.txt", layout_text(FLOATING))]
        self.accelerations = [self.write("shove.txt", SHOVE), self.write("rest.txt", REST)]

    def run_here(self, *arguments, **options):
        return run(*arguments, **{"cwd": self.folder, **options})

    def screen(self, *arguments, output="results.h5", expect=0, **options):
        """Screens the inputs of `write_inputs`; the path of the results comes first in the pair returned."""
        done = self.run_here("screen", "-c", self.config, "--layouts", *self.layouts, "--accelerations",
                             *self.accelerations, "-o", output, *arguments, **options)
        self.assert_exit(done, expect)
        return self.folder / output, done

    def assert_exit(self, done, code):
        self.assertEqual(done.returncode, code, f"{' '.join(done.args)}\n{done.stdout}\n{done.stderr}")
        for output in (done.stdout, done.stderr):
            for symptom in ("terminate called", "HDF5-DIAG", "what():", "Sanitizer", "Assertion"):
                self.assertNotIn(symptom, output)

    def assert_refused(self, done, *words, code=2, lines=1):
        """The program said why in one line, and printed nothing else."""
        self.assert_exit(done, code)
        self.assertEqual(done.stdout, "")
        said = done.stderr.splitlines()
        self.assertEqual(len(said), lines, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def assert_same_results(self, a, b):
        """Every dataset and attribute is the same, those that tell of time and place of the run aside."""
        left, right = datasets(a), datasets(b)
        self.assertEqual(sorted(left), sorted(right))
        for name in left:
            if name != "/worlds/cpu_seconds":
                self.assertTrue(same_bits(left[name], right[name]), name)
        with h5py.File(a, "r") as one, h5py.File(b, "r") as two:
            for group in ("/", "/summary", "/inputs/settings"):
                apart = {"created_utc", "command_line", "Screening/Threads", "Screening/Scheduler"}
                self.assertEqual({k: v for k, v in one[group].attrs.items() if k not in apart},
                                 {k: v for k, v in two[group].attrs.items() if k not in apart})


class SmallDisk(CliTest):
    """A test with a file system of its own, `disk`, which is made small, full or read-only by mounting it anew."""

    def setUp(self):
        super().setUp()
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        if self.mount("size=64m") != 0:
            self.skipTest("this user may not mount a file system")
        self.addCleanup(subprocess.run, ["umount", self.disk], check=True)

    def mount(self, options, *more):
        return subprocess.run(["mount", "-t", "tmpfs", "-o", options, *more, "tmpfs", self.disk],
                              stderr=subprocess.DEVNULL, check=False).returncode

    def remount(self, options):
        self.assertEqual(self.mount(f"remount,{options}"), 0)
