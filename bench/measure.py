#!/usr/bin/python3
"""Measures the screening run on this machine: threads, recording, memory, and whether the results stay the same.

Each figure is a ratio of runs that took turns on the same machine; every run's results are compared by hash before
its speed is reported. Takes some minutes; `--quick` for a first look.

Example: bench/measure.py --threads 1 2 --csv measured.csv
"""
import argparse
import csv
import hashlib
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py

ROOT = Path(__file__).resolve().parent.parent
ACCELERATIONS = sorted((ROOT / "configs/accelerations").glob("*.txt"))


def all_layouts():
    """The real layouts and the unstable ones, without the example of three boxes."""
    folders = ("configs/layouts", "bench/layouts", "bench/layouts_unstable")
    paths = [path for folder in folders for path in sorted((ROOT / folder).glob("*.txt"))]
    return [path for path in paths if path.name != "seed_example.txt"]


def write_pulses(folder, count, seconds):
    """Accelerations of `seconds` each, all different: a pulse along x of rising strength."""
    for i in range(count):
        Path(folder, f"pulse_{i:03}.txt").write_text(f"# start duration x y z\n0 {seconds} {2 + 4 * i / count} 0 0\n")
    return folder


def screen(program, layouts, accelerations, *options):
    """One run: wall seconds, CPU seconds, peak memory in MiB, worlds, hash of series and summary."""
    with tempfile.TemporaryDirectory() as folder:
        results = Path(folder, "results.h5")
        command = [program, "screen", "--quiet", "-o", results, "--layouts", *layouts, "--accelerations",
                   *accelerations, *options]
        begin = time.monotonic()
        process = subprocess.Popen([str(word) for word in command])
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
        if os.waitstatus_to_exitcode(status) != 0:
            sys.exit(f"failed: {' '.join(map(str, command))}")
        with h5py.File(results) as file:
            return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss / 1024,
                    "worlds": len(file["worlds/layout"]), "hash": hash_of(file, "summary"),
                    "series_hash": hash_of(file, "series"), "bytes": results.stat().st_size}


def hash_of(file, group):
    digest = hashlib.sha256()

    def add(name, item):
        if isinstance(item, h5py.Dataset):
            digest.update(name.encode() + item[...].tobytes())

    if group in file:
        file[group].visititems(add)
    return digest.hexdigest()[:16]


def take_turns(runs, repeats):
    """Runs each named callable `repeats` times in turn; all results by name."""
    results = {name: [] for name in runs}
    for _ in range(repeats):
        for name, run in runs.items():
            results[name].append(run())
    return results


def median(results, what):
    return statistics.median(result[what] for result in results)


def spread(results, what):
    values = [result[what] for result in results]
    return (max(values) - min(values)) / statistics.median(values)


def same(results, what="hash"):
    hashes = {result[what] for runs in results.values() for result in runs}
    if len(hashes) != 1:
        sys.exit(f"results differ between runs that must agree: {hashes}")


def measure_threads(run, layouts, folder, options, report):
    counts = sorted(options.threads)
    pulses = write_pulses(folder, 4, 1.0)
    results = take_turns({n: lambda n=n: run(layouts, [pulses], "--threads", n) for n in counts}, options.repeats)
    same(results)
    base = median(results[counts[0]], "wall")
    for n in counts[1:]:
        wall = median(results[n], "wall")
        report(f"worlds/s, {n} threads over {counts[0]}", base / wall, ">= 1.85 at 2",
               f"{results[n][0]['worlds'] / wall:.2f} worlds/s, spread {spread(results[n], 'wall'):.1%}")


def measure_recording(run, layouts, folder, options, report):
    pulses = write_pulses(folder, 4, 1.0)
    results = take_turns({"series": lambda: run(layouts, [pulses]), "none": lambda: run(layouts, [pulses], "--no-series")},
                         options.repeats)
    one = results["series"][0]
    report("wall time with series over without", median(results["series"], "wall") / median(results["none"], "wall"),
           "<= 1.05", f"CPU {median(results['series'], 'cpu') / median(results['none'], 'cpu'):.3f}, "
           f"{one['bytes'] / one['worlds'] / 1024:.0f} KiB a world")


def measure_memory(run, layouts, folder, options, report):
    write_pulses(folder, 30, 0.1)
    pulses = sorted(Path(folder).glob("*.txt"))
    few, many = run(layouts, pulses[:3]), run(layouts, pulses)
    report(f"peak memory, {many['worlds']} worlds over {few['worlds']}", many["memory"] / few["memory"], "<= 1.5",
           f"{many['memory']:.0f} MiB and {few['memory']:.0f} MiB")


def measure_same_bits(run, layouts, folder, _options, report):
    real = [path for path in layouts if "bpjs" not in path.name]
    config = Path(folder, "coarse.ini")  # a coarse step: it is the bits that count
    config.write_text("[Physics Engine]\nSimulationStepsPerSecond = 60\n")
    kinds = [("tbb", 1), ("tbb", 2), ("openmp", 1), ("openmp", 2), ("serial", 1)]
    results = {f"{name} {n}": [run(real, ACCELERATIONS, "-c", config, "--scheduler", name, "--threads", n)]
               for name, n in kinds}
    same(results)
    same(results, "series_hash")
    one = results["tbb 1"][0]
    report("runs of the same bits: schedulers x threads", len(results), "5", f"{one['worlds']} worlds, hash {one['hash']}")


def measure(options):
    rows = []

    def report(name, value, bound, note):
        rows.append({"figure": name, "value": value, "bound": bound, "note": note})
        print(f"{name:<42} {value:>8.3f}  {bound:<13} {note}", flush=True)

    def run(layouts, accelerations, *extra):
        return screen(options.program, layouts, accelerations, "--engine", options.engine, *extra)

    layouts = all_layouts()
    with tempfile.TemporaryDirectory() as folder:
        measure_threads(run, layouts[:16], folder, options, report)
        measure_recording(run, layouts[:16], folder, options, report)
    with tempfile.TemporaryDirectory() as folder:
        measure_memory(run, layouts, folder, options, report)
        if not options.quick:
            measure_same_bits(run, layouts, folder, options, report)
    return rows


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default=ROOT / "build/release/bin/holdfast", help="default: %(default)s")
parser.add_argument("--engine", default="bullet-stock", help="default: %(default)s, which computes every step of every world")
parser.add_argument("--threads", type=int, nargs="+", default=[1, os.cpu_count()], help="thread counts to compare")
parser.add_argument("--repeats", type=int, default=3, help="runs of each kind; the median counts (default: %(default)s)")
parser.add_argument("--quick", action="store_true", help="leave out the runs over all real layouts")
parser.add_argument("--csv", metavar="FILE", help="write the figures there as well")
arguments = parser.parse_args()
figures = measure(arguments)
if arguments.csv:
    with open(arguments.csv, "w", newline="") as stream:
        writer = csv.DictWriter(stream, figures[0].keys())
        writer.writeheader()
        writer.writerows(figures)
