#!/usr/bin/python3
"""Accelerations as a data logger records them: a lane change of 0.2 g and a braking of 0.8 g with vibration, as curves of
samples. The same bytes each time.

Example: bench/sampled_accelerations.py sampled/ --samples 1000
"""
import argparse
import math
from pathlib import Path

GRAVITY = 9.81  # m/s²


def lane_change(time):
    """One period of a sine to the side, with half a second before and after it."""
    period, begin = 5.5, 0.5
    inside = begin <= time < begin + period
    return 0.0, 0.2 * GRAVITY * math.sin(2 * math.pi * (time - begin) / period) if inside else 0.0


def braking(time):
    """Half a second of rise, a second and a half of 0.8 g with 3 % of vibration at 7 and 11 Hz, and 0.3 s of fall."""
    share = max(0.0, min(1.0, time / 0.5, (2.3 - time) / 0.3))
    vibration = 0.03 * math.sin(2 * math.pi * 7 * time)
    return 0.8 * GRAVITY * share * (1 + vibration), 0.01 * GRAVITY * share * math.sin(2 * math.pi * 11 * time)


def text_of(rows):
    """The acceleration file of (begin, duration, x, y, z), in s and m/s²."""
    lines = [f"{begin:.12g}\t{duration:.12g}\t{x:.5f}\t{y:.5f}\t{z:.5g}" for begin, duration, x, y, z in rows]
    return "\n".join(["#Initial-Time\t/ Duration\t/ X\t/ Y\t/ Z", *lines, ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--samples", type=int, default=50, metavar="N", help="samples per second (default: 50)")
    arguments = parser.parse_args()
    folder, samples = arguments.folder, arguments.samples
    folder.mkdir(parents=True, exist_ok=True)
    for name, curve, duration in (("lane_change_0g2", lane_change, 6.5), ("braking_0g8", braking, 3.0)):
        rows = [(sample / samples, 1 / samples, *curve((sample + 0.5) / samples), 0.0)
                for sample in range(round(duration * samples))]
        (folder / f"{name}.txt").write_text(text_of(rows))


if __name__ == "__main__":
    main()
