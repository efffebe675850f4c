#!/usr/bin/python3
"""Screens the layouts of a folder on a Dask cluster, here one of processes of this machine, and prints how many hold.

Each worker process makes a Screen once and keeps it: a Screen is pickled as its options alone. Needs Debian's
python3-distributed, and the Python package of holdfast. Example: dask_screen.py configs/layouts --workers 2
"""
import argparse
import pathlib

import numpy as np
from distributed import Client, LocalCluster

import holdfast


def verdicts_of(screen, paths):
    """Verdicts of a block of layouts, of shape (layouts, accelerations)."""
    return screen.evaluate([screen.read_layout(path) for path in paths]).verdict


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("layouts", type=pathlib.Path, help="folder of layouts")
    parser.add_argument("--norm", default="road", help="norm of the accelerations (default: %(default)s)")
    parser.add_argument("--workers", type=int, default=2, help="processes (default: %(default)s)")
    parser.add_argument("--block", type=int, default=64, help="layouts of one task (default: %(default)s): enough that handing "
                        "it out costs little beside them")
    options = parser.parse_args()
    paths = [str(path) for path in sorted(options.layouts.glob("*.txt"))]
    screen = holdfast.Screen(norm=options.norm, accuracy="screening", threads=1)
    with LocalCluster(n_workers=options.workers, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        blocks = [paths[begin:begin + options.block] for begin in range(0, len(paths), options.block)]
        shared = client.scatter(screen, broadcast=True)
        verdicts = np.concatenate(client.gather([client.submit(verdicts_of, shared, block) for block in blocks]))
    holds = (verdicts == holdfast.Verdict.STAYED).all(axis=1)
    for path, good in zip(paths, holds):
        print(f"{'holds' if good else 'fails'}  {pathlib.Path(path).name}")
    print(f"{holds.sum()} of {len(paths)} layouts hold")


if __name__ == "__main__":
    main()
