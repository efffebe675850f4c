#!/usr/bin/python3
"""Makes layouts as a metaheuristic would: any number of distinct, valid loadings, the same ones every time.

This is test data for throughput, not a packer: nobody has looked at how well the loadings fill a container.

Each candidate belongs to one of fifteen Bischoff-Ratcliff and Davies-Bischoff instances (instances.txt, one of each class
BR1 to BR15). A vector of random keys decides everything: the order of the box types, how each is turned, how many stand in
a block, which free space comes next. A constructive heuristic puts block after block into the free spaces, each into the
corner of one, and cuts what is left of the space into three: before the block, beside it, on top of it. So no two boxes
overlap, and every box stands on the floor or on the block below it.

Example: bench/candidates.py 10000 candidates/ --seed 7
"""
import argparse
import random
import sys
from pathlib import Path

INSTANCES = Path(__file__).resolve().parent / "instances.txt"
SMALLEST_EDGE = 5.0  # cm; boxes are not scaled below this
MOST_ATTEMPTS = 1000  # until a candidate is new and has as many boxes as wanted


def read_instances(path=INSTANCES):
    """(container, types) of every instance; a type is (edges in cm, which may stand upright, count)."""
    numbers = iter(map(int, path.read_text(encoding="ascii").split()))
    instances = []
    for _ in range(next(numbers)):
        next(numbers), next(numbers)  # number and seed of the problem
        container = tuple(float(next(numbers)) for _ in range(3))
        types = []
        for _ in range(next(numbers)):
            _, a, up_a, b, up_b, c, up_c, count = (next(numbers) for _ in range(8))
            types.append(((float(a), float(b), float(c)), (up_a == 1, up_b == 1, up_c == 1), count))
        instances.append((container, types))
    return instances


def turned(edges, upright):
    """Every way to stand a box: (x, y, z) with an edge upright that may be."""
    ways = []
    for up in range(3):
        if upright[up]:
            a, b = (edges[i] for i in range(3) if i != up)
            ways += [(a, b, edges[up]), (b, a, edges[up])]
    return ways


def scaled(types, container, wanted):
    """The types with edges scaled so that about `wanted` boxes fill the container."""
    count = sum(count for _, _, count in types)
    mean = sum(a * b * c * count for (a, b, c), _, count in types) / count
    factor = (container[0] * container[1] * container[2] * 0.8 / wanted / mean) ** (1 / 3)
    return [(tuple(max(SMALLEST_EDGE, round(factor * edge, 1)) for edge in edges), upright, wanted)
            for edges, upright, _ in types]


def most_in_a_row(edge, room, carried, overhang):
    """How many boxes fit behind each other so that the last reaches no farther beyond what carries it than it may."""
    return int(min(room, carried + overhang * edge) / edge + 1e-9)


def rounded(value):
    """Tenths of a millimetre: what is written is what was placed."""
    return round(value, 2)


def pack(container, types, most, knobs, key):
    """One loading of at most so many boxes: (x, y, z, X, Y, Z, type) each. `key()` is the next random key, in [0, 1)."""
    length, width, height = container
    ways = [turned(edges, upright) for edges, upright, _ in types]
    left = [count for _, _, count in types]
    order = sorted(range(len(types)), key=[key() for _ in types].__getitem__)
    volume_left = knobs.fill * length * width * height
    spaces = [(0.0, 0.0, 0.0, length, width, height, length, width)]  # corner, extents, how much of it is carried below
    boxes = []
    while spaces and volume_left > 0.0 and len(boxes) < most:
        # The frontmost space first, mostly: a loading grows from the front wall to the door.
        spaces.sort(reverse=True)
        space = spaces.pop(-1 - int(key() ** 4 * min(3, len(spaces))))
        choice = None
        first = int(key() ** 2 * len(order))
        for kind in order[first:] + order[:first]:
            if left[kind] > 0:
                possible = [way for way in ways[kind] if way[2] <= space[5] and
                            most_in_a_row(way[0], space[3], space[6], knobs.overhang) > 0 and
                            most_in_a_row(way[1], space[4], space[7], knobs.overhang) > 0]
                if possible:
                    choice = kind, possible[int(key() * len(possible))]
                    break
        if choice is None:
            continue
        kind, (a, b, c) = choice
        x, y, z, space_x, space_y, space_z, carried_x, carried_y = space
        limit = min(left[kind], most - len(boxes), max(1, int(volume_left / (a * b * c))))
        deep = 1 + int(key() * min(2, most_in_a_row(a, space_x, carried_x, knobs.overhang)))
        wide = 1 + int(key() * min(most_in_a_row(b, space_y, carried_y, knobs.overhang),
                                    max(1, limit // deep)))
        high = 1 + int(key() * min(int(space_z / c), max(1, limit // (deep * wide))))
        while deep * wide * high > limit:
            deep, wide, high = max(1, deep - 1), max(1, wide - 1), max(1, high - 1)
        for k in range(high):
            for i in range(deep):
                for j in range(wide):
                    boxes.append((rounded(x + i * a), rounded(y + j * b), rounded(z + k * c), rounded(x + (i + 1) * a),
                                  rounded(y + (j + 1) * b), rounded(z + (k + 1) * c), kind + 1))
        left[kind] -= deep * wide * high
        volume_left -= deep * wide * high * a * b * c
        block_x, block_y, block_z = deep * a, wide * b, high * c
        # What stands on the block may reach beyond it: so much room around it stays empty below.
        over_x = rounded(min(knobs.overhang * key() * a, space_x - block_x))
        over_y = rounded(min(knobs.overhang * key() * b, space_y - block_y))
        used_x = min(space_x, block_x + max(over_x, rounded(knobs.gap * key())))
        used_y = min(space_y, block_y + max(over_y, rounded(knobs.gap * key())))
        spaces.append((x, y, z + block_z, block_x + over_x, block_y + over_y, space_z - block_z, block_x,
                       block_y))
        # What is left beside a block that overhangs may have nothing below it.
        if z == 0.0 or knobs.overhang == 0.0:
            before, beside = space_x - used_x, space_y - used_y
            spaces += [(x + used_x, y, z, before, space_y, space_z, before, space_y),
                       (x, y + used_y, z, used_x, beside, space_z, used_x, beside)]
    return boxes


def text_of(boxes):
    """The layout file: types and boxes, then a line a box, in cm."""
    lines = ["\t".join(f"{value:g}" for value in box) for box in boxes]
    return "\n".join([f"{len({box[6] for box in boxes})}\t{len(boxes)}", *lines, ""])


def candidates(count, knobs):
    """`count` pairs of a name and a text. The first candidates are the same whatever the count."""
    instances = read_instances()
    seen = set()
    for index in range(count):
        for attempt in range(MOST_ATTEMPTS):
            key = random.Random(f"{knobs.seed} {index} {attempt}").random
            number = int(key() * len(instances))
            container, types = instances[number]
            least, most = knobs.boxes or (1, sys.maxsize)
            if knobs.boxes:
                most = least + int(key() * (most - least + 1))
                types = scaled(types, container, most)
            boxes = pack(container, types, most, knobs, key)
            text = text_of(boxes)
            if text not in seen and len(boxes) >= least:
                break
        else:
            sys.exit(f"candidate {index}: none of {MOST_ATTEMPTS} is new and has as many boxes; ask for less")
        seen.add(text)
        yield f"candidate_{index:06}_BR{number + 1}.txt", text


def arguments_of(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, help="how many layouts")
    parser.add_argument("folder", type=Path, help="where to write them; made if missing")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other layouts (default: %(default)s)")
    parser.add_argument("--fill", type=float, default=0.9, help="share of the container's volume to stop at (default: "
                        "%(default)s)")
    parser.add_argument("--gap", type=float, default=0.0, metavar="CM", help="widest gap between blocks (default: "
                        "%(default)s)")
    parser.add_argument("--overhang", type=float, default=0.0, metavar="SHARE", help="how far a box may reach beyond the "
                        "block below it, as a share of that one's edge (default: %(default)s)")
    parser.add_argument("--boxes", type=int, nargs=2, metavar=("LEAST", "MOST"), help="how many boxes; the instances' boxes "
                        "are scaled so that a number drawn from this range fills the container")
    knobs = parser.parse_args(words)
    if knobs.count < 1 or not 0.0 < knobs.fill <= 1.0 or knobs.gap < 0.0 or not 0.0 <= knobs.overhang <= 0.5:
        parser.error("count from 1, fill above 0 and up to 1, gap from 0, overhang from 0 to 0.5")
    if knobs.boxes and not 1 <= knobs.boxes[0] <= knobs.boxes[1] <= 5000:
        parser.error("boxes: 1 <= LEAST <= MOST <= 5000")
    return knobs


def main():
    knobs = arguments_of()
    knobs.folder.mkdir(parents=True, exist_ok=True)
    boxes = 0
    for name, text in candidates(knobs.count, knobs):
        (knobs.folder / name).write_text(text, encoding="ascii")
        boxes += text.count("\n") - 1
    print(f"{knobs.count} layouts, {boxes / knobs.count:.1f} boxes each on average, in {knobs.folder}")


if __name__ == "__main__":
    main()
