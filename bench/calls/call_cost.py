#!/usr/bin/python3
"""What call_cost.cpp does, from Python: calls on the main thread, an array per layout.

    call_cost.py ACCELERATION THREADS CALLS each|together LAYOUT...
"""
import array
import json
import sys
import time

import holdfast


def resident():
    """Resident memory of this process, KiB."""
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS:"))


def main():
    acceleration, threads, calls, how, *paths = sys.argv[1:]
    with holdfast.Screen([acceleration], accuracy="screening", threads=int(threads)) as screen:
        layouts = [screen.read_layout(path) for path in paths]
        populations = [layouts] if how == "together" else [[layout] for layout in layouts]
        for population in populations:
            screen.evaluate(population)
        calls = int(calls)
        overheads = array.array("d", bytes(8 * calls))  # all of its memory is there before the first look
        early = resident()
        processor_begin, begin = time.process_time(), time.perf_counter()
        for i in range(calls):
            called = time.perf_counter()
            verdicts = screen.evaluate(populations[i % len(populations)])
            overheads[i] = time.perf_counter() - called
            overheads[i] -= float(verdicts.cpu_seconds.sum())
            if i == calls // 10:
                early = resident()
        wall, processor = time.perf_counter() - begin, time.process_time() - processor_begin
        late = resident()
    overheads = sorted(overheads)
    print(json.dumps({"wall": wall, "processor": processor, "median": overheads[calls // 2],
                      "percentile99": overheads[calls * 99 // 100], "early": early, "late": late}))


if __name__ == "__main__":
    main()
