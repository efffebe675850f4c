#!/usr/bin/python3
"""Searches for the fullest loading of a container that holds all accelerations, with DEAP and holdfast.

An individual is a vector of random keys, which a decoder turns into a loading; holdfast checks a generation in one call.
examples/search is a stronger search of the same kind, in C++.

Example: examples/search_deap.py bench/instances.txt 10 configs/accelerations/road_*.txt --generations 20 -o loading.txt
"""
import argparse
import random
import time
from pathlib import Path

import numpy as np
from deap import algorithms, base, creator, tools

import holdfast

PENALTY = 0.02  # fill that a box out of place costs


def read_instance(path, problem):
    """Container and types of a Bischoff-Ratcliff problem; a type is its edges in cm, which may be upright, and a count."""
    numbers = iter(map(int, Path(path).read_text(encoding="ascii").split()))
    problems = next(numbers)
    if not 1 <= problem <= problems:
        raise SystemExit(f"{path}: no problem {problem}; there are 1 to {problems}")
    for _ in range(problem):
        next(numbers), next(numbers)  # its number and seed
        container = [next(numbers) for _ in range(3)]
        types = []
        for _ in range(next(numbers)):
            _, a, up_a, b, up_b, c, up_c, count = (next(numbers) for _ in range(8))
            types.append(((a, b, c), (up_a, up_b, up_c), count))
    return container, types


def decode(keys, container, types):
    """The loading of some keys, rows as holdfast takes them, in cm: type after type is put as a block into the corner of the
    first space that has room. What is left of the space is three: before the block, beside it, and on top of it."""
    turns = [kind for kind, (_, _, count) in enumerate(types) for _ in range(count)]
    left = [count for _, _, count in types]
    spaces = [(0, 0, 0, *container)]  # corner and extents
    boxes = []
    for turn in np.argsort(keys[:len(turns)]):
        kind, key = turns[turn], keys[len(turns) + turn]
        edges, upright, _ = types[kind]
        ways = [[edges[i] for i in way] for way in ((0, 1, 2), (1, 0, 2), (0, 2, 1), (2, 0, 1), (1, 2, 0), (2, 1, 0))
                if upright[way[2]]]
        extents = ways[int(key * len(ways))]
        spaces.sort()  # from the front wall on
        space = next((space for space in spaces if all(e <= room for e, room in zip(extents, space[3:]))), None)
        if space is None or left[kind] == 0:
            continue
        high = min(left[kind], space[5] // extents[2])
        wide = min(left[kind] // high, space[4] // extents[1])
        deep = min(left[kind] // (high * wide), max(1, space[3] // extents[0] // 2))
        left[kind] -= deep * wide * high
        for i, j, k in np.ndindex(deep, wide, high):
            corner = [low + n * e for low, n, e in zip(space, (i, j, k), extents)]
            boxes.append([*corner, *(c + e for c, e in zip(corner, extents)), kind + 1])
        x, y, z, length, width, height = space
        a, b, c = deep * extents[0], wide * extents[1], high * extents[2]
        spaces.remove(space)
        spaces += [(x + a, y, z, length - a, width, height), (x, y + b, z, a, width - b, height), (x, y, z + c, a, b, height - c)]
    return np.array(boxes, dtype=float)


def fill_of(layout, container):
    return float(np.prod(layout[:, 3:6] - layout[:, :3], axis=1).sum() / np.prod(container))


def arguments_of():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("instances", help="file of Bischoff-Ratcliff problems")
    parser.add_argument("problem", type=int, help="position in that file, from 1")
    parser.add_argument("accelerations", nargs="+", help="files")
    parser.add_argument("--generations", type=int, default=20, help="(default: %(default)s)")
    parser.add_argument("--population", type=int, default=40, help="(default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="(default: %(default)s)")
    parser.add_argument("--threads", type=int, default=0, help="that simulate; 0: one per core (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, help="layout file to write: the fullest loading that holds")
    return parser.parse_args()


def main():
    options = arguments_of()
    container, types = read_instance(options.instances, options.problem)
    random.seed(options.seed)
    creator.create("Fitness", base.Fitness, weights=(1.0,))
    creator.create("Keys", list, fitness=creator.Fitness)
    toolbox = base.Toolbox()
    toolbox.register("individual", tools.initRepeat, creator.Keys, random.random, 2 * sum(count for _, _, count in types))
    toolbox.register("population", tools.initRepeat, list, toolbox.individual)
    toolbox.register("mate", tools.cxUniform, indpb=0.3)
    toolbox.register("mutate", lambda keys: (creator.Keys(random.random() if random.random() < 0.05 else k for k in keys),))
    toolbox.register("select", tools.selBest)
    toolbox.register("evaluate", decode, container=container, types=types)
    best = {"fill": 0.0, "layout": None}
    seconds = {"all": time.process_time(), "simulation": 0.0}

    def evaluate_all(decode_keys, population):
        """A map of DEAP: the fitness of each individual, by one call of holdfast for all of them."""
        layouts = [decode_keys(keys) for keys in population]
        verdicts = screen.evaluate(layouts)
        seconds["simulation"] += verdicts.cpu_seconds.sum()
        out_of_place = np.maximum.reduce([verdicts.fallen, verdicts.moved, verdicts.tilted, verdicts.unstable]).max(axis=1)
        for layout, holds, boxes in zip(layouts, verdicts.holds.all(axis=1), out_of_place):
            fill = fill_of(layout, container)
            if holds and fill > best["fill"]:
                best.update(fill=fill, layout=layout)
            yield (fill - (0.0 if holds else PENALTY * max(1, int(boxes))),)

    toolbox.register("map", evaluate_all)
    statistics = tools.Statistics(lambda keys: keys.fitness.values[0])
    statistics.register("fitness", lambda values: f"{max(values):.4f}")
    statistics.register("fill_that_holds", lambda _: f"{best['fill']:.4f}")
    config = "[Screening]\nFirstFailure = true\n[Container]\n" + "".join(
        f"{name} = {extent}\n" for name, extent in zip(("Length", "Width", "Height"), container))
    with holdfast.Screen(options.accelerations, accuracy="screening", unit="cm", config=config,
                         threads=options.threads) as screen:
        _, log = algorithms.eaMuPlusLambda(toolbox.population(options.population), toolbox, mu=options.population // 4,
                                           lambda_=options.population, cxpb=0.7, mutpb=0.3, ngen=options.generations,
                                           stats=statistics)
    seconds["all"] = time.process_time() - seconds["all"]
    loadings = sum(log.select("nevals"))
    print(f"{loadings} loadings, {loadings / seconds['all']:.1f} per second of processor time, "
          f"{seconds['simulation'] / seconds['all']:.0%} of it simulation; fullest that holds: {best['fill']:.4f}")
    if options.output and best["layout"] is not None:
        rows = ["\t".join(f"{number:g}" for number in box) for box in best["layout"]]
        options.output.write_text(f"{len(types)}\t{len(rows)}\n" + "\n".join(rows) + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
