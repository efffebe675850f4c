#!/usr/bin/python3
"""What an evaluation costs through each way into holdfast: C++, C, Python, `holdfast serve` and one process per candidate.

All take turns on the same candidates, round after round, on one thread. Evaluations are counted per second of processor time, of
all processes that take part, so that other work on the machine does not count: they are of layouts that a search might make,
under an acceleration of the road. The overhead of a call is its wall time less the processor time of building and simulating,
the median of 200 calls on the same layouts at rest, of which the best round is given. Then two threads against one, by
wall time, which needs a machine without other work; and the memory of a million calls.

Build before: cmake --preset release -DHOLDFAST_PYTHON=ON
              cmake --build --preset release --target holdfast call_cost holdfast_python

Example: bench/calls/compare.py --into docs/evidence/performance.md
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))
import candidates
from tables import replace_tables, table_of

BRAKE = ROOT / "configs/accelerations/road_brake_0g8.txt"
SHORT_BRAKE = ROOT / "bench/short_brake_2ms2.txt"
CANDIDATES = {30: 12, 100: 6, 300: 2}  # layouts by their number of boxes
POPULATION = 200  # layouts of 100 boxes for two threads against one
CALLS_AT_REST = 200
ROUNDS_AT_REST = 5  # in each round: they are short, and one of them is likely to be undisturbed
CALLS_OF_A_PROCESS = 10  # each takes milliseconds
REST = "0 0.1 0 0 0\n"
ONE_BOX = "1 1\n200 100 0 250 150 50 1\n"
PARTS = ("cost", "threads", "memory")
WAYS = ("C++", "C", "Python", "serve", "process")


class Ways:
    """Every way evaluates layouts one by one on one thread."""

    def __init__(self, build, folder):
        self.build = build
        self.folder = folder

    def driver(self, way, *words):
        """What call_cost says that was called from this language."""
        environment = {**os.environ, "PYTHONPATH": str(self.build / "python")}
        command = ([sys.executable, ROOT / "bench/calls/call_cost.py"] if way == "Python" else
                   [self.build / "bin/call_cost", way.lower()])
        done = subprocess.run([*map(str, command), *map(str, words)], env=environment, stdout=subprocess.PIPE, check=True)
        return json.loads(done.stdout)

    def run(self, way, acceleration, calls, layouts):
        """Processor time per call, and median overhead of a call, s."""
        if way == "serve":
            return self.serve(acceleration, calls, layouts)
        if way == "process":
            return self.processes(acceleration, min(calls, max(CALLS_OF_A_PROCESS, len(layouts))), layouts)
        cost = self.driver(way, acceleration, 1, calls, "each", *layouts)
        return cost["processor"] / calls, cost["median"]

    def serve(self, acceleration, calls, layouts):
        """Each line is written when the answer to the one before is there."""
        lines = [self.line(path) for path in layouts]
        words = ["serve", "--accelerations", acceleration, "--accuracy", "screening", "--threads", "1"]
        with subprocess.Popen([self.build / "bin/holdfast", *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as service:

            def call(line):
                service.stdin.write(line)
                service.stdin.flush()
                return service.stdout.readline()

            for line in lines:
                call(line)
            return measured(call, calls, lines, lambda: time.process_time() + processor_of(service.pid))

    @staticmethod
    def line(path):
        boxes = [list(map(float, row.split())) for row in path.read_text(encoding="ascii").splitlines()[1:]]
        return (json.dumps({"unit": "cm", "boxes": boxes}) + "\n").encode()

    def processes(self, acceleration, calls, layouts):
        """`holdfast screen` for every layout."""
        def call(path):
            return subprocess.run([self.build / "bin/holdfast", "screen", "--quiet", "--json", "--no-series", "--overwrite",
                                   "--accuracy", "screening", "--threads", "1", "--layouts", path, "--accelerations", acceleration,
                                   "-o", self.folder / "results.h5"], stdout=subprocess.PIPE, check=True).stdout

        call(layouts[0])
        return measured(call, calls, layouts, lambda: time.process_time() + processor_of_children())


def measured(call, calls, inputs, processor):
    """Processor time per call, and median overhead, s, of calls that answer with a line of JSON.

    :param processor: says the processor time, s, that all have used so far
    """
    overheads = []
    processor_begin = processor()
    for i in range(calls):
        begin = time.perf_counter()
        answer = call(inputs[i % len(inputs)])
        overheads.append(time.perf_counter() - begin - simulated(json.loads(answer)))
    return (processor() - processor_begin) / calls, statistics.median(overheads)


def processor_of(process):
    """Processor time of the threads of another process, s."""
    threads = Path(f"/proc/{process}/task").glob("*/schedstat")
    return 1e-9 * sum(int(path.read_text(encoding="ascii").split()[0]) for path in threads)


def processor_of_children():
    """Processor time of the processes that have ended, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def simulated(answer):
    """Processor time of building and simulating, s, of what `serve` or `screen --json` answers."""
    return sum(world["cpu_seconds"] for world in answer.get("verdicts", [answer]))


def made(folder, count, boxes):
    """Paths of candidates with so many boxes."""
    knobs = candidates.arguments_of([str(count), str(folder), "--boxes", str(boxes), str(boxes)])
    paths = []
    for name, text in candidates.candidates(count, knobs):
        paths.append(folder / f"{boxes}_{name}")
        paths[-1].write_text(text, encoding="ascii")
    return paths


def time_text(seconds):
    """Two digits or all of µs, from 1 ms on of ms."""
    number, unit = (1e3 * seconds, "ms") if seconds >= 1e-3 else (1e6 * seconds, "µs")
    return f"{number:.0f} {unit}" if number >= 10 else f"{number:.1f} {unit}"


def calls_table(ways, rounds, folder, rest):
    layouts = {boxes: made(folder, count, boxes) for boxes, count in CANDIDATES.items()}
    rates = {(way, boxes): [] for way in WAYS for boxes in layouts}
    overheads = {key: [] for key in rates}
    for _ in range(rounds):
        for (way, boxes), found in rates.items():
            found.append(1 / ways.run(way, BRAKE, len(layouts[boxes]), layouts[boxes])[0])
        for _ in range(ROUNDS_AT_REST):
            for (way, boxes), found in overheads.items():
                found.append(ways.run(way, rest, CALLS_AT_REST, layouts[boxes])[1])
    rows = []
    for way in WAYS:
        row = [way]
        for boxes in layouts:
            rate = statistics.median(rates[way, boxes])
            row.append(f"{rate:.3g} ({rate / statistics.median(rates['C++', boxes]):.2f})")
        rows.append(row + [time_text(min(overheads[way, boxes])) for boxes in layouts])
    head = ["through", *(f"{boxes} boxes: per second" for boxes in layouts), *(f"{boxes}: overhead" for boxes in layouts)]
    return table_of(f"Evaluations per processor second under {BRAKE.name} (in brackets as a share of those from C++), and "
                    f"overhead of a call; {rounds} rounds.", head, rows)


def threads_table(ways, rounds, folder):
    population = made(folder, POPULATION, 100)
    rows = []
    for way in ("C++", "C", "Python"):
        speed_ups, works = [], []
        for _ in range(rounds):
            one, two = (ways.driver(way, SHORT_BRAKE, threads, 1, "together", *population) for threads in (1, 2))
            speed_ups.append(one["wall"] / two["wall"])
            works.append(two["processor"] / one["processor"])
        rows.append([way, f"{max(speed_ups):.2f}", f"{statistics.median(speed_ups):.2f}", f"{statistics.median(works):.2f}"])
    return table_of(f"Two threads against one: a call on {POPULATION} layouts of 100 boxes under {SHORT_BRAKE.name}; {rounds} "
                    "rounds.", ["through", "speed-up, best round", "median", "processor time"], rows)


def memory_table(ways, calls, folder, rest):
    box = folder / "one.txt"
    box.write_text(ONE_BOX, encoding="ascii")
    rows = []
    for way in ("C++", "C", "Python"):
        cost = ways.driver(way, rest, 1, calls, "each", box)
        rows.append([way, f"{cost['early']} KiB", f"{cost['late']} KiB", time_text(cost["median"]),
                     time_text(cost["percentile99"])])
    return table_of(f"{calls:,} calls on one box at rest.",
                    ["through", "resident after a tenth", "resident at the end", "overhead, median", "99th percentile"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release", help="default: %(default)s")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS, help="default: all")
    parser.add_argument("--rounds", type=int, default=5, help="default: %(default)s")
    parser.add_argument("--calls", type=int, default=1_000_000, help="of which memory is watched (default: %(default)s)")
    parser.add_argument("--into", type=Path, help="page whose tables are replaced, such as docs/evidence/performance.md")
    arguments = parser.parse_args()
    tables = {}
    with tempfile.TemporaryDirectory(prefix="holdfast-calls-") as name:
        folder = Path(name)
        rest = folder / "rest.txt"
        rest.write_text(REST, encoding="ascii")
        ways = Ways(arguments.build, folder)
        measures = (lambda: calls_table(ways, arguments.rounds, folder, rest),
                    lambda: threads_table(ways, arguments.rounds, folder),
                    lambda: memory_table(ways, arguments.calls, folder, rest))
        for part, measure in zip(PARTS, measures):
            if part in arguments.parts:
                tables[f"calls: {part}"] = measure()
                print(tables[f"calls: {part}"], end="\n\n", flush=True)
    if arguments.into:
        replace_tables(arguments.into, tables)


if __name__ == "__main__":
    main()
