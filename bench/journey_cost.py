#!/usr/bin/python3
"""What settling, running out and an early end cost: the numbers of docs/evidence/performance.md.

  bench/journey_cost.py [--candidates 120] [--rounds 5] [--accuracy screening]

Generated layouts are screened under the accelerations of the road, on one thread and without series. The ways of screening
take turns; the median of the program's processor time is printed over that of the first way.
"""
import argparse
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
AT_ONCE = "[Screening]\nSettleSeconds = 0\nRunOutSeconds = 0\n"
WAYS = {
    "neither settles nor runs out": ["-c", "at_once.ini"],
    "the default: settles until it rests, and runs out until it rests": [],
    "the default with `--stop-when moved`": ["--stop-when", "moved"],
    "the default with `--stop-when moved --first-failure`, as `Screen::holds` asks": ["--stop-when", "moved", "--first-failure"],
}


def seconds(program, folder, accuracy, words):
    """Processor time of a run of the program, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "screen", "--layouts", "layouts", "--norm", "road", "--accuracy", accuracy, "--no-series",
                           "--threads", "1", "--quiet", "--overwrite", *words], cwd=folder, capture_output=True, text=True,
                          check=False)
    if done.returncode > 1:
        sys.exit(done.stderr)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--candidates", default="120")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--accuracy", default="screening")
    parser.add_argument("--program", type=pathlib.Path, default="build/release/bin/holdfast")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([ROOT / "bench/candidates.py", arguments.candidates, f"{folder}/layouts", "--boxes", "20", "150"],
                       stdout=subprocess.DEVNULL, check=True)
        pathlib.Path(folder, "at_once.ini").write_text(AT_ONCE, encoding="ascii")
        times = {way: [] for way in WAYS}
        for _ in range(arguments.rounds):
            for way, words in WAYS.items():
                times[way].append(seconds(arguments.program.resolve(), folder, arguments.accuracy, words))
    medians = {way: statistics.median(values) for way, values in times.items()}
    least = medians[next(iter(WAYS))]
    print("| | ratio | s |\n| --- | --- | --- |")
    for way, median in medians.items():
        print(f"| {way} | {median / least:.2f} | {median:.1f} |")


if __name__ == "__main__":
    main()
