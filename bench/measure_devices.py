#!/usr/bin/python3
"""Measures bullet-opencl against batch size on every device found, beside Bullet on the processor at an equal setting.

A batch is one real layout under as many accelerations as there are worlds, all different. Each figure is taken from runs
of their own; what starting up takes (building the device's kernels, or finding them in the driver's cache) is measured by
a run of a single step and given apart. Processor time is that of the whole process.

Example: bench/measure_devices.py --worlds 1 10 100 --csv devices.csv
"""
import argparse
import csv
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RATE = 240  # steps a second


def devices(program):
    """Names of the devices that can be used, as `holdfast engines --devices` lists them."""
    listed = subprocess.run([program, "engines", "--devices"], capture_output=True, text=True, check=True).stdout
    found = re.findall(r"^ +(?:CPU|GPU|accelerator) (.+?) \(.+\): (.+)$", listed, re.MULTILINE)
    return [name for name, what in found if not what.startswith("cannot be used")]


def run(arguments, engine, device, worlds, steps):
    """Wall and processor seconds and peak memory in MiB of `worlds` worlds of `steps` steps."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        accelerations = folder / "accelerations"
        accelerations.mkdir()
        for i in range(worlds):
            (accelerations / f"pulse_{i:04}.txt").write_text(f"# start duration x y z\n0 {steps / RATE} {2 + 4 * i / worlds} 0 0\n")
        config = folder / "config.ini"
        config.write_text(f"[Screening]\nSettleSeconds = 0\nRunOutSeconds = 0\n"
                          f"[Physics Engine]\nSimulationStepsPerSecond = {RATE}\n[Bullet]\nIterations = {arguments.iterations}\n"
                          f"[OpenCL]\nIterations = {arguments.iterations}\n" + (f"Device = {device}\n" if device else ""))
        command = [arguments.program, "screen", "--quiet", "--no-series", "--threads", "1", "-c", config, "--engine", engine,
                   "--layouts", arguments.layout, "--accelerations", accelerations, "-o", folder / "results.h5"]
        begin = time.monotonic()
        process = subprocess.Popen([str(word) for word in command])
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
        if os.waitstatus_to_exitcode(status) != 0:
            sys.exit(f"failed: {' '.join(map(str, command))}")
        return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss / 1024}


def measure(arguments):
    rows = []
    kinds = [("bullet-opencl", device) for device in devices(arguments.program)] + [("bullet", "")]
    for engine, device in kinds:
        run(arguments, engine, device, 1, 1)  # fills the driver's cache
        starts = [run(arguments, engine, device, 1, 1) for _ in range(3)]
        start = {what: min(each[what] for each in starts) for what in starts[0]}
        print(f"{engine} {device}: start-up {start['wall']:.2f} s", flush=True)
        for worlds in arguments.worlds:
            if engine == "bullet" and worlds > 10:
                continue  # a world costs the same in any company
            steps = max(arguments.steps, 240 // worlds)  # enough to stand out from starting up
            cost = run(arguments, engine, device, worlds, steps)
            wall, cpu = cost["wall"] - start["wall"], cost["cpu"] - start["cpu"]
            rows.append({"engine": engine, "device": device, "worlds": worlds, "start_up_s": start["wall"],
                         "world_steps_per_s": worlds * steps / wall, "cpu_ms_per_world_step": 1e3 * cpu / worlds / steps,
                         "memory_mib": cost["memory"]})
            row = rows[-1]
            print(f"  {worlds:>5} worlds: {row['world_steps_per_s']:8.0f} steps of worlds a second, "
                  f"{row['cpu_ms_per_world_step']:.3f} ms of processor a world and step, {row['memory_mib']:.0f} MiB", flush=True)
    return rows


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default=ROOT / "build/release/bin/holdfast", help="default: %(default)s")
parser.add_argument("--layout", default=ROOT / "bench/layouts/BR1_001_block.txt", help="default: %(default)s")
parser.add_argument("--worlds", type=int, nargs="+", default=[1, 10, 100, 1000], help="default: %(default)s")
parser.add_argument("--steps", type=int, default=24, help="steps of each world (default: %(default)s)")
parser.add_argument("--iterations", type=int, default=20, help="of both solvers (default: %(default)s)")
parser.add_argument("--csv", metavar="FILE", help="write the figures there as well")
options = parser.parse_args()
figures = measure(options)
if options.csv:
    with open(options.csv, "w", newline="") as stream:
        writer = csv.DictWriter(stream, figures[0].keys())
        writer.writeheader()
        writer.writerows(figures)
