"""Random loads, accelerations and configurations for random_worlds.py: the same ones for the same numbers drawn.

Loads are boxes (x, y, z, X, Y, Z, material), in cm, in the order in which they are put in place. Accelerations are shapes:
rows of (begin, duration, x, y, z) whose largest horizontal size is 1, to be multiplied by an amplitude in m/s².
"""
import math
import random
from argparse import Namespace

import candidates
import numpy as np
from candidates import rounded

CONTAINER = (587.0, 233.0, 220.0)  # cm, the program's default
MOST_BOXES = 40
MASSES = [round(10 ** (step / 6), 2) for step in range(13)]  # kg, by material, from 1
ATTEMPTS = 60  # until a box has found a place
KINETIC = 0.75  # kinetic friction over static friction, in a third of the configurations


# Loads: each kind builds in a corner at the origin, and gives boxes of six numbers.


def edges_of(draw, least, most):
    return tuple(rounded(draw.uniform(low, high)) for low, high in zip(least, most))


def block(x, y, z, edges):
    """A box with its lowest corner there."""
    return tuple(rounded(value) for value in (x, y, z, x + edges[0], y + edges[1], z + edges[2]))


def overlap(box, below):
    """(x, y, X, Y) of what two boxes share when seen from above; None if nothing."""
    low, high = [max(box[i], below[i]) for i in (0, 1)], [min(box[i], below[i]) for i in (3, 4)]
    return (*low, *high) if low[0] < high[0] and low[1] < high[1] else None


def drop(boxes, x, y, edges, lowest=0.0):
    """Puts a box down from above, and whether it stands: its centre is well inside of the outline of what it stands on."""
    box = block(x, y, 0.0, edges)
    under = [(below[5], shared) for below in boxes if (shared := overlap(box, below))]
    top = max((height for height, _ in under), default=0.0)
    if top < lowest or top + edges[2] > CONTAINER[2] - 2.0:
        return False
    if top > 0.0:
        parts = [shared for height, shared in under if height == top]
        for axis in (0, 1):
            middle, play = (box[axis] + box[axis + 3]) / 2, 0.05 * edges[axis]
            if not min(part[axis] for part in parts) + play < middle < max(part[axis + 2] for part in parts) - play:
                return False
    boxes.append(block(x, y, top, edges))
    return True


def heap(draw, count):
    """Boxes of all sizes, thrown onto a small area and onto each other."""
    boxes = []
    side = 45.0 * math.sqrt(count / draw.uniform(1.5, 4.0))
    length, width = min(side * draw.uniform(1.0, 2.0), 500.0), min(side, CONTAINER[1] - 83.0)
    for _ in range(ATTEMPTS * count):
        edges = edges_of(draw, (12, 12, 8), (80, 80, 70))
        if drop(boxes, draw.uniform(0, length), draw.uniform(0, width), edges) and len(boxes) == count:
            break
    return boxes


def columns(draw, count):
    """Columns in a grid, apart or touching, with boxes of one base or of smaller and shifted ones."""
    boxes = []
    base = edges_of(draw, (20, 20, 12), (80, 70, 60))
    gap = draw.choice((0.0, rounded(draw.uniform(2, 40))))
    ragged = draw.random() < 0.5
    high = min(draw.randint(1, 8), int((CONTAINER[2] - 10) / base[2]), count)
    wide = min(draw.randint(1, 4), int(CONTAINER[1] / (base[1] + gap)))
    place = 0
    while len(boxes) < count:
        x, y = place // wide * (base[0] + gap), place % wide * (base[1] + gap)
        if x + base[0] > CONTAINER[0]:
            break
        for level in range(min(high, count - len(boxes))):
            shares = [draw.uniform(0.7, 1.0) if ragged and level else 1.0 for _ in (0, 1)]
            edges = (rounded(base[0] * shares[0]), rounded(base[1] * shares[1]), base[2])
            if not drop(boxes, x + draw.random() * (base[0] - edges[0]), y + draw.random() * (base[1] - edges[1]), edges):
                break
        place += 1
    return boxes


def bridge(draw, boxes, y, count):
    """Two supports of equal height at some y, a plank on both, and boxes on the plank. How much room it takes along y."""
    foot = edges_of(draw, (20, 25, 0), (60, 70, 0))
    parts = [rounded(draw.uniform(15, 50)) for _ in range(draw.randint(1, 3))]
    span, over = rounded(draw.uniform(20, 200)), [rounded(draw.random() * 0.4 * foot[0]) for _ in (0, 1)]
    for x in (0.0, foot[0] + span):
        for part in draw.sample(parts, len(parts)):
            drop(boxes, x, y, (foot[0], foot[1], part))
    # The plank reaches over each support from its outer side, less what is left free there, and may be narrower.
    plank = (rounded(2 * foot[0] + span - over[0] - over[1]), rounded(foot[1] * draw.uniform(0.7, 1.0)),
             rounded(draw.uniform(2, 12)))
    if not drop(boxes, over[0], y + draw.random() * (foot[1] - plank[1]), plank):
        return foot[1]
    (_, front, _, _, _, top), room = boxes[-1], plank[1]
    wanted = len(boxes) + count - 2 * len(parts) - 1
    for _ in range(ATTEMPTS):
        if len(boxes) >= wanted:
            break
        edges = edges_of(draw, (12, 0.4 * room, 10), (50, 0.95 * room, 60))
        drop(boxes, over[0] + draw.random() * max(0.0, plank[0] - edges[0]), front + draw.random() * (room - edges[1]), edges,
             lowest=top)
    return foot[1]


def bridges(draw, count):
    """Bridges beside each other, touching or apart."""
    boxes, y = [], 0.0
    gap = draw.choice((0.0, rounded(draw.uniform(2, 30))))
    while len(boxes) < count and y < CONTAINER[1] - 70:
        y = rounded(y + bridge(draw, boxes, y, draw.randint(4, 12)) + gap)
    return boxes[:MOST_BOXES]


def packing(draw, count):
    """A loading as candidates.py makes them, with gaps and overhangs, in a part of the container."""
    _, types = draw.choice(INSTANCES)
    part = (CONTAINER[0] * draw.uniform(0.3, 1.0), *CONTAINER[1:])
    knobs = Namespace(fill=draw.uniform(0.4, 0.9), gap=draw.choice((0.0, 3.0, 15.0, 30.0)),
                      overhang=draw.choice((0.0, 0.0, 0.2, 0.35)))
    boxes = candidates.pack(part, candidates.scaled(types, part, count), count, knobs, draw.random)
    return [box[:6] for box in boxes]


INSTANCES = candidates.read_instances()
LOADS = {"heap": heap, "columns": columns, "bridges": bridges, "packing": packing}


def placed(draw, boxes):
    """The load somewhere in the container, mostly away from the walls, perhaps with length and width exchanged."""
    length, width = (max(box[axis] for box in boxes) for axis in (3, 4))
    if draw.random() < 0.5 and length < CONTAINER[1] and width < CONTAINER[0]:
        boxes = [(y, x, z, Y, X, Z) for x, y, z, X, Y, Z in boxes]
        length, width = width, length
    where = draw.random()
    x, y = (rounded(draw.random() * (room - extent)) for room, extent in zip(CONTAINER, (length, width)))
    x, y = (x if where < 0.8 else 0.0), (y if where < 0.7 or where > 0.9 else 0.0)
    return [block(box[0] + x, box[1] + y, box[2], [box[axis + 3] - box[axis] for axis in range(3)]) for box in boxes]


def load(draw, kind):
    """A load of 2 to MOST_BOXES boxes, with materials: one, a few that are near, or any."""
    boxes = []
    while len(boxes) < 2:
        boxes = LOADS[kind](draw, round(2 * (MOST_BOXES / 2) ** draw.random()))
    if kind != "packing":
        boxes = placed(draw, boxes)
    first = draw.randrange(len(MASSES))
    last = draw.choice((first, min(first + 3, len(MASSES) - 1), len(MASSES) - 1))
    return [(*box, 1 + draw.randint(first, last)) for box in boxes]


# Accelerations


def heading(draw):
    """A unit vector, mostly along an axis of the container."""
    angle = draw.randrange(4) * math.pi / 2 if draw.random() < 0.7 else draw.uniform(0, 2 * math.pi)
    return round(math.cos(angle), 6), round(math.sin(angle), 6)


def sampled(draw, seconds, curve, largest_rate=1000.0):
    """Samples of a curve, which is a function of an array of times and gives x, y and z."""
    rate = round(100.0 * (largest_rate / 100.0) ** draw.random())
    begin = np.arange(round(seconds * rate)) / rate
    parts = np.array([np.broadcast_to(part, begin.shape) for part in curve(begin + 0.5 / rate)])
    parts /= np.hypot(parts[0], parts[1]).max()
    return np.column_stack([begin, np.full_like(begin, 1 / rate), *parts])


def step(draw):
    """One to three constant accelerations, with rest between them or without."""
    rows, time = [], 0.0
    for push in range(draw.randint(1, 3)):
        x, y = heading(draw)
        size = draw.uniform(0.5, 1.0) if push else 1.0
        for length, share in ((round(draw.uniform(0.2, 2.0), 2), size), (draw.choice((0.0, 0.3, 1.0)), 0.0)):
            if length:
                rows.append((time, length, x * share, y * share, 0.0))
                time = round(time + length, 2)
    return np.array(rows)


def ramp(draw):
    """Rise, hold and fall, and the same the other way in half of them."""
    rise, hold, fall = draw.uniform(0.05, 2.0), draw.uniform(0.2, 1.5), draw.uniform(0.05, 1.0)
    (x, y), back = heading(draw), draw.choice((0.0, 0.0, -1.0, -0.7))
    one = rise + hold + fall

    def curve(time):
        knots = np.array([0, rise, rise + hold, one, one + rise, one + rise + hold, 2 * one])
        share = np.interp(time, knots, [0, 1, 1, 0, back, back, 0])
        return x * share, y * share, 0.0

    return sampled(draw, one * (2 if back else 1), curve)


def sine(draw):
    """A train of 1 to 8 periods of 0.1 to 4 s, in some with a constant part or with heave."""
    period = 0.1 * 40.0 ** draw.random()
    seconds = min(period * draw.choice((1, 2, 4, 8)), 10.0)
    (x, y), bias, heave = heading(draw), draw.choice((0.0, 0.0, 0.3)), draw.choice((0.0, 0.0, 0.4))
    phase = draw.uniform(0, 2 * math.pi)

    def curve(time):
        angle = 2 * math.pi * time / period
        return x * (bias + np.sin(angle)), y * (bias + np.sin(angle)), heave * np.sin(angle + phase)

    return sampled(draw, seconds, curve)


def lane_change(draw):
    """To one side and back, as a sine or as two constant parts, once or twice, in some with braking meanwhile."""
    period, repeats, square = draw.uniform(1.5, 6.0), draw.choice((1, 1, 2)), draw.random() < 0.4
    side, brake = draw.choice((-1, 1)), draw.choice((0.0, 0.0, 0.4))

    def curve(time):
        share = np.sin(2 * math.pi * time / period) * np.where(time < period, 1, -1)
        return brake, side * (np.sign(share) if square else share), 0.0

    return sampled(draw, period * repeats, curve)


def sea(draw):
    """Roll, pitch and heave with periods of 5 to 14 s."""
    periods = [draw.uniform(low, high) for low, high in ((6, 14), (5, 9), (5, 9))]
    phases = [draw.uniform(0, 2 * math.pi) for _ in periods]
    sizes = [1.0, draw.uniform(0.0, 0.5), draw.uniform(0.0, 0.5)]

    def curve(time):
        y, x, z = (size * np.sin(2 * math.pi * time / period + phase)
                   for size, period, phase in zip(sizes, periods, phases))
        return x, y, z

    return sampled(draw, 1.5 * periods[0], curve, 400.0)


def truck(draw):
    """Noise of 0.5 to 100 Hz across, along and upwards, in half of them on top of braking or cornering."""
    (x, y), trend, noise = heading(draw), draw.choice((0.0, 1.0)), draw.uniform(0.3, 1.0)
    highest = draw.choice((20.0, 40.0, 100.0))
    waves = [[((highest / 0.5) ** draw.random() * 0.5, draw.uniform(0, 2 * math.pi)) for _ in range(30)] for _ in range(3)]
    sizes = [draw.uniform(0.2, 1.0), 1.0, draw.uniform(0.2, 1.0)]
    seconds = draw.uniform(3.0, 8.0)

    def curve(time):
        across = [size * noise / math.sqrt(15) * sum(np.sin(2 * math.pi * rate * time + phase) for rate, phase in part)
                  for size, part in zip(sizes, waves)]
        share = trend * np.clip(np.minimum(time / 0.5, (seconds - time) / 0.5), 0, 1)
        return across[0] + x * share, across[1] + y * share, 0.5 * across[2]

    return sampled(draw, seconds, curve)


ACCELERATIONS = {"step": step, "ramp": ramp, "sine": sine, "lane change": lane_change, "sea": sea, "truck noise": truck}


# Configurations


def configuration(seed, group):
    """The name of a kind of friction, and config.ini: coefficients of 0.25 to 0.9, masses by material."""
    draw = random.Random(f"{seed} configuration {group}")
    kind = draw.choice(("one coefficient", "pairs"))
    one = round(draw.uniform(0.25, 0.9), 3)
    pairs = {name: one if kind != "pairs" else round(draw.uniform(0.25, 0.9), 3) for name in ("BoxBox", "BoxFloor", "BoxWall")}
    share = KINETIC if draw.random() < 1 / 3 else 1.0
    lines = ["[Contact]", "FrictionModel = pairs", *(f"{name} = {value}" for name, value in pairs.items()),
             f"KineticFriction = {share}"]
    for number, mass in enumerate(MASSES, 1):
        lines += [f"[Material {number}]", f"Mass = {mass}"]
    return f"{kind}, kinetic {share:g}", "\n".join(lines) + "\n"
