#!/usr/bin/env python3
"""Measures what `holdfast serve` costs beyond the simulation, from Python's side of the pipes.

Cubes at rest on the floor, whose simulation takes next to nothing. One by one: a line is written when the answer to the
one before is there; the time of a call less the processor seconds that its verdict reports. In a row: all lines are
written at once; the wall time per layout, simulation included, on one thread.

    bench/serve_overhead.py --boxes 1 30 100 300
"""
import argparse
import json
import pathlib
import subprocess
import tempfile
import threading
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent


def cubes(count):
    """So many cubes of 20 cm on the floor and on each other, as rows of seven numbers in m."""
    boxes = []
    for k in range(count):
        x, y, z = 0.21 * (k % 25), 0.21 * (k // 25 % 10), 0.2 * (k // 250)
        boxes.append([round(number, 2) for number in (x, y, z, x + 0.2, y + 0.2, z + 0.2)] + [1])
    return boxes


class Service:
    def __init__(self, program, acceleration):
        self.process = subprocess.Popen([program, "serve", "--accelerations", acceleration, "--accuracy", "screening",
                                         "--threads", "1"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def ask(self, line):
        """The answer's text, and the wall time from writing to reading, s."""
        start = time.perf_counter()
        self.process.stdin.write(line)
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        return answer, time.perf_counter() - start

    def end(self):
        self.process.stdin.close()
        if self.process.wait() != 0:
            raise SystemExit("the service failed")


def simulated(answer):
    """Processor seconds of building and simulating a layout."""
    return sum(world["cpu_seconds"] for world in json.loads(answer)["verdicts"])


def one_by_one(service, line, calls):
    overheads = []
    for _ in range(calls):
        answer, seconds = service.ask(line)
        overheads.append(seconds - simulated(answer))
    overheads.sort()
    return overheads[calls // 2], overheads[calls * 99 // 100]


def in_a_row(service, line, calls):
    start = time.perf_counter()
    writer = threading.Thread(target=lambda: (service.process.stdin.write(line * calls), service.process.stdin.flush()))
    writer.start()
    answers = [service.process.stdout.readline() for _ in range(calls)]
    wall = time.perf_counter() - start
    writer.join()
    return wall / calls, sum(map(simulated, answers)) / calls


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=SOURCE / "build/release/bin/holdfast")
    parser.add_argument("--boxes", type=int, nargs="+", default=[1, 30, 100, 300])
    parser.add_argument("--calls", type=int, default=2000)
    options = parser.parse_args()
    print("boxes  one by one: median, 99th percentile, ms   in a row: wall, simulation, ms per layout")
    with tempfile.TemporaryDirectory() as folder:
        acceleration = pathlib.Path(folder) / "rest.txt"
        acceleration.write_text("0 0.1 0 0 0\n")
        for count in options.boxes:
            line = (json.dumps({"boxes": cubes(count)}) + "\n").encode()
            service = Service(options.program, acceleration)
            one_by_one(service, line, 20)
            median, worst = one_by_one(service, line, options.calls)
            wall, simulation = in_a_row(service, line, options.calls)
            service.end()
            print(f"{count:5}  {1e3 * median:18.3f} {1e3 * worst:15.3f}       {1e3 * wall:17.3f} {1e3 * simulation:11.3f}")


if __name__ == "__main__":
    main()
