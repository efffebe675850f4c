#!/usr/bin/python3
"""Screens thousands of candidates in one run and tells what it took: memory, disk, assembling, reading, and the tail.

With --kills the same run is done again, killed so many times on the way and resumed; its file must then equal the
undisturbed one, times aside.

Example: bench/scale.py 10000 --boxes 90 110 --kills 2
"""
import argparse
import heapq
import json
import os
import random
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parent))
import candidates  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
TICK = os.sysconf("SC_CLK_TCK")
MIB = 2**20
READS = 20  # worlds read for the median


class Watch:
    """Follows a run: memory and processor time as they grow, when assembling begins, and when it is done."""

    def __init__(self, process, results):
        self.process, self.results = process, results
        self.begin = time.monotonic()
        self.samples = []  # (s since the start, memory in MiB, processor s)
        self.assembling = self.assembled = None  # s: when it began, when the results file was there

    def look(self):
        now = time.monotonic() - self.begin
        try:
            resident = int(Path(f"/proc/{self.process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")
            fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        except (FileNotFoundError, ProcessLookupError):
            return
        if resident:
            self.samples.append((now, resident / MIB, (int(fields[11]) + int(fields[12])) / TICK))
        if self.assembling is None and Path(f"{self.results}.tmp").exists():
            self.assembling = now
        elif self.assembled is None and self.results.exists():
            self.assembled = now

    def follow(self):
        """Until the process ends; seconds it took."""
        while self.process.poll() is None:
            self.look()
            time.sleep(0.02)
        return time.monotonic() - self.begin

    def busy_threads(self, begin, end):
        """Mean number of threads at work between two times."""
        inside = [(t, cpu) for t, _, cpu in self.samples if begin <= t <= end]
        if len(inside) < 2 or inside[-1][0] == inside[0][0]:
            return float("nan")
        return (inside[-1][1] - inside[0][1]) / (inside[-1][0] - inside[0][0])

    def peak(self, begin, end):
        return max((memory for t, memory, _ in self.samples if begin <= t <= end), default=float("nan"))


def command(options, folder, results, *more):
    words = [options.program, "screen", "--quiet", "--layouts", folder / "layouts", "--accelerations",
             *options.accelerations, "-o", results, *more]
    for name in ("config", "engine", "threads"):
        if getattr(options, name):
            words += [f"--{name}", getattr(options, name)]
    return [str(word) for word in words]


def tell(name, value, unit="", note=""):
    print(f"{name:<44} {value:>12.4g} {unit:<8} {note}", flush=True)


def undisturbed(options, folder, results):
    costs = folder / "costs.json"
    process = subprocess.Popen(command(options, folder, results, "--costs", costs))
    watch = Watch(process, results)
    seconds = watch.follow()
    if process.returncode != 0:
        sys.exit(f"the run failed with exit code {process.returncode}")
    with h5py.File(results) as file:
        worlds = len(file["worlds/layout"])
        boxes = len(file["boxes/mass"]) / worlds
    simulated = watch.assembling or seconds
    tell("worlds", worlds, "", f"of {boxes:.0f} boxes on average")
    tell("wall time", seconds, "s")
    tell("worlds a second", worlds / seconds, "1/s")
    tell("peak memory until a tenth of the time", watch.peak(0, 0.1 * simulated), "MiB")
    tell("peak memory until assembling", watch.peak(0, simulated), "MiB")
    tell("peak memory", watch.peak(0, seconds), "MiB")
    tell("threads at work, all the time", watch.busy_threads(0, simulated))
    tell("threads at work, last tenth", watch.busy_threads(0.9 * simulated, simulated))
    size = results.stat().st_size
    tell("results file", size / MIB, "MiB", f"{size / worlds / 1024:.1f} KiB a world")
    for stage, cpu_seconds in json.loads(costs.read_text()).items():
        tell(f"processor time: {stage}", cpu_seconds, "s")
    if watch.assembling is not None and watch.assembled is not None:  # shorter than a look, they are not seen
        took = watch.assembled - watch.assembling
        tell("assembling", took, "s", f"{size / MIB / took:.0f} MiB/s")
        tell("removing the parts, telling the outcomes", seconds - watch.assembling - took, "s")
    return size


IN_FLIGHT = 8  # worlds that a run has in flight a thread: kUnitsInFlight of src/parallel/schedulers/ordered_run.hpp


def replayed(costs, threads, window):
    """When worlds of these costs are done by so many threads, and when the first thread finds none left, s."""
    free = [0.0] * threads  # when each thread is free again
    written = []  # when each world has been written: in order, after those before it
    for index, cost in enumerate(costs):
        begin = heapq.heappop(free)
        if index >= window:
            begin = max(begin, written[index - window])
        heapq.heappush(free, begin + cost)
        written.append(max(begin + cost, written[-1] if written else 0.0))
    return written[-1], free[0]


def tell_tail(options, results):
    """How evenly the threads were at work, by the processor time that each world took: no other load disturbs that."""
    with h5py.File(results) as file:
        costs = file["worlds/cpu_seconds"][:].tolist()
    threads = options.threads or os.cpu_count()
    end, first_idle = replayed(costs, threads, IN_FLIGHT * threads)
    tell("largest share of a world in all", 100 * max(costs) / sum(costs), "%", f"{max(costs):.2f} s; "
         f"median {statistics.median(costs):.3f} s")
    tell("threads at work, replayed", sum(costs) / end, "", f"of {threads}")
    tell("replayed: from the first idle thread on", end - first_idle, "s", f"{100 * (end - first_idle) / end:.1f} % of "
         "the time")


def measure_disk(folder, size):
    """Writes as many bytes as the results have, and syncs them: what assembling can be compared with."""
    path = folder / "plain.bin"
    block = os.urandom(MIB)
    begin = time.monotonic()
    with open(path, "wb", buffering=0) as file:
        for _ in range(max(1, size // MIB)):
            file.write(block)
        os.fsync(file.fileno())
    seconds = time.monotonic() - begin
    path.unlink()
    tell("plain writing of as many bytes", seconds, "s", f"{size / MIB / seconds:.0f} MiB/s")


def measure_reading(options, folder, results):
    begin = time.monotonic()
    subprocess.run([options.program, "summary", results, "--csv", folder / "tables", "--move-threshold", "0.05"],
                   stdout=subprocess.DEVNULL, check=True)
    tell("summary with other thresholds, into CSV", time.monotonic() - begin, "s")
    with h5py.File(results) as file:
        count = len(file["worlds/layout"])
    times = []
    place = random.Random(1)
    for _ in range(READS):
        world = place.randrange(count)
        begin = time.monotonic()
        with h5py.File(results) as file:
            row, samples, boxes = (int(file["worlds"][name][world]) for name in ("row_begin", "sample_count", "box_count"))
            path = file["series/displacement"][row:row + samples * boxes].reshape(samples, boxes, 3)
        times.append(time.monotonic() - begin)
        assert len(path) == samples
    tell("h5py: open, and read a world's displacements", 1000 * statistics.median(times), "ms",
         f"median of {READS}; largest {1000 * max(times):.1f} ms")


def same(a, b):
    """The first dataset that differs, or None; times aside."""
    differing = []

    def compare(name, item):
        if not isinstance(item, h5py.Dataset) or name == "worlds/cpu_seconds" or differing:
            return
        other = b[name]
        if item.shape != other.shape or item.dtype != other.dtype:
            differing.append(name)
        elif item.ndim == 0:
            differing.extend([name] if item[()] != other[()] else [])
        else:
            for begin in range(0, len(item), 1_000_000):
                part = slice(begin, begin + 1_000_000)
                if item[part].tobytes() != other[part].tobytes():
                    differing.append(name)
                    return

    a.visititems(compare)
    return differing[0] if differing else None


def killed(options, folder, whole, seconds):
    """The same run, killed on the way and resumed."""
    results = folder / "killed.h5"
    moments = random.Random(options.seed)
    for kill in range(options.kills):
        process = subprocess.Popen(command(options, folder, results, "--resume"))
        time.sleep(seconds / (options.kills + 1) * moments.uniform(0.5, 1.0))
        process.send_signal(signal.SIGKILL)
        process.wait()
        finished = 0
        for path in sorted(folder.glob("killed.h5.parts/part-*.h5")):
            with h5py.File(path) as part:
                finished += len(part["worlds/layout"])
        tell(f"worlds safe after kill {kill + 1}", finished)
    done = subprocess.run(command(options, folder, results, "--resume"), check=False)
    if done.returncode != 0:
        sys.exit(f"the resumed run failed with exit code {done.returncode}")
    with h5py.File(whole) as a, h5py.File(results) as b:
        differing = same(a, b) or same(b, a)
    if differing:
        sys.exit(f"the resumed file differs from the undisturbed one in {differing}")
    print("killed and resumed: the same file as without, times aside")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=10_000, help="candidates (default: %(default)s)")
    parser.add_argument("--boxes", type=int, nargs=2, default=(90, 110), metavar=("LEAST", "MOST"), help="boxes of a "
                        "candidate (default: 90 110)")
    parser.add_argument("--accelerations", nargs="+", default=[ROOT / "configs/accelerations/road_brake_0g8.txt"])
    parser.add_argument("--config", help="configuration of the run")
    parser.add_argument("--engine", help="engine, instead of the configuration's")
    parser.add_argument("--threads", type=int, help="threads; all cores without it")
    parser.add_argument("--kills", type=int, default=0, help="how often a second run is killed (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of candidates and kills (default: %(default)s)")
    parser.add_argument("--program", default=ROOT / "build/release/bin/holdfast", help="default: %(default)s")
    parser.add_argument("--folder", help="where to work; a temporary folder without it, which is removed")
    options = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="holdfast-scale-", dir=options.folder))
    try:
        knobs = candidates.arguments_of([str(options.count), str(folder / "layouts"), "--seed", str(options.seed),
                                         "--boxes", *map(str, options.boxes)])
        begin = time.monotonic()
        (folder / "layouts").mkdir()
        for name, text in candidates.candidates(options.count, knobs):
            (folder / "layouts" / name).write_text(text, encoding="ascii")
        tell("making the candidates", time.monotonic() - begin, "s")
        results = folder / "results.h5"
        begin = time.monotonic()
        size = undisturbed(options, folder, results)
        seconds = time.monotonic() - begin
        tell_tail(options, results)
        measure_disk(folder, size)
        measure_reading(options, folder, results)
        if options.kills:
            killed(options, folder, results, seconds)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
