#!/usr/bin/python3
"""Replays a run over many cores on paper: how long they take, and how long they wait, from what its worlds cost.

The layouts of the results file are repeated in a random order up to the number asked for, cut into shards as `holdfast screen
--part` does, and handed out in turn to cores, each shard to the next free one (holdfast-mpi), or all before the start (a job
array of as many shards as cores). Example: bench/cluster_replay.py results.h5 --layouts 2500000 --cores 100 1000
"""
import argparse
import heapq

import h5py
import numpy as np

BLOCK_WORLDS = 256  # as in src/core/model/shard.hpp
MOST_SHARDS = 16384  # as in src/mpi/distributed_screening.hpp

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", type=argparse.FileType("rb"), help="results file with the costs of worlds")
parser.add_argument("--layouts", type=int, default=100_000, help="layouts of the run (default: %(default)s)")
parser.add_argument("--cores", type=int, nargs="+", default=[100, 1000], help="cores (default: 100 1000)")
parser.add_argument("--shards", type=int, nargs="+", default=[MOST_SHARDS // 16, MOST_SHARDS],
                    help="shards that are handed out by a counter (default: %(default)s)")
parser.add_argument("--overhead", type=float, default=0.05, help="seconds that a shard costs beside its worlds (default: %(default)s)")
options = parser.parse_args()

with h5py.File(options.results) as file:
    accelerations = len(file["inputs/accelerations/name"])
    cost = file["worlds/cpu_seconds"][:].reshape(-1, accelerations).sum(axis=1)  # per layout
    size = options.results.seek(0, 2) / len(cost)  # bytes of the file per layout

costs = cost[np.random.default_rng(1).integers(len(cost), size=options.layouts)]
block = max(1, BLOCK_WORLDS // accelerations)
blocks = np.add.reduceat(costs, np.arange(0, options.layouts, block))
total = costs.sum()
print(f"{options.layouts:,} layouts, {options.layouts * accelerations:,} worlds, {total / 3600:,.1f} processor hours, "
      f"{options.layouts * size / 1e9:,.1f} GB of results")


def end_of(shares, cores):
    """When the last of the cores is ready, which take the shares in turn."""
    free = [0.0] * cores
    for share in shares:
        heapq.heapreplace(free, free[0] + share + options.overhead)
    return max(free)


def shards_of(count):
    count = min(count, len(blocks))
    return np.array([blocks[part::count].sum() for part in range(count)])


print(f"{'cores':>6}  {'shards':>7}  {'handed out':<10}  {'hours':>8}  waiting")
for cores in options.cores:
    for name, count in [("at start", cores), *(("by counter", shards) for shards in options.shards if shards > cores)]:
        end = end_of(shards_of(count), cores)
        print(f"{cores:6}  {count:7}  {name:<10}  {end / 3600:8.2f}  {1 - total / (end * cores):6.1%}")
