#!/usr/bin/python3
"""Gives every box of some layouts play to all sides: what a load is that was not packed tightly.

Each box is made smaller by the play along the length and across the width, about its middle; heights stay, so that every
box stands where it stood.

Example: bench/with_play.py 1 loose/ configs/layouts/BR*.txt
"""
import argparse
from pathlib import Path


def with_play(line, play, shift=(0.0, 0.0)):
    """The line of a box, smaller by `play` and then shifted, cm; comments and blank lines as they are."""
    words = line.split("#")[0].split()
    if not words:
        return line
    for low in (0, 1):
        words[low] = f"{float(words[low]) + play / 2 + shift[low]:.6g}"
        words[low + 3] = f"{float(words[low + 3]) - play / 2 + shift[low]:.6g}"
    return " ".join(words)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("play", type=float, help="between neighbours that touched, mm")
    parser.add_argument("folder", type=Path, help="where the layouts go, under their names")
    parser.add_argument("layouts", type=Path, nargs="+")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for path in arguments.layouts:
        try:
            lines = path.read_text(encoding="utf-8").splitlines()
            header = next(i for i, line in enumerate(lines) if line.split("#")[0].strip())
            loose = lines[:header + 1] + [with_play(line, arguments.play / 10) for line in lines[header + 1:]]
        except (OSError, ValueError, IndexError, StopIteration):
            parser.error(f"{path}: not a layout; `holdfast check` says why")
        (arguments.folder / path.name).write_text("\n".join(loose) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
