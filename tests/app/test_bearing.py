"""What rests on each box, as `check` tells it, against an independent solver of linear programs."""
import re
import unittest

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_matrix

from cli import CliTest, layout_text
from test_readme import indented_blocks

DENSITY = 250.0  # kg/m3, the default of the program
GAP = OVERLAP = 0.1  # cm, as in docs/guide/bearing.md
PRINTED = 0.006  # kg, half of the last digit that is printed
ROW = re.compile(r" +(\d+) +([\d.]+) +([\d.]+) +([\d.]+) +-(  tips|  unsupported)?$", re.MULTILINE)


def contacts_of(boxes):
    """Rectangles in which box `upper` stands on box `lower`, or on the floor, -1."""
    for upper, (x0, y0, z, x1, y1, _) in enumerate(boxes):
        if z <= GAP:
            yield upper, -1, x0, y0, x1, y1
        for lower, below in enumerate(boxes):
            low = np.maximum((x0, y0), below[:2])
            high = np.minimum((x1, y1), below[3:5])
            if lower != upper and abs(z - below[5]) <= GAP and min(high - low) >= OVERLAP:
                yield (upper, lower, *low, *high)


def bearing_by_scipy(boxes):
    """The least and largest load on each box, kg; None where the load has no equilibrium."""
    boxes = np.array(boxes, float)
    masses = DENSITY * np.prod(boxes[:, 3:] - boxes[:, :3], axis=1) * 1e-6
    centres = (boxes[:, :3] + boxes[:, 3:]) / 2
    contacts = list(contacts_of(boxes))
    rows, columns, values = [], [], []
    for k, (upper, lower, x0, y0, x1, y1) in enumerate(contacts):
        for corner, (x, y) in enumerate(((x0, y0), (x1, y0), (x0, y1), (x1, y1))):
            for box, sign in ((upper, 1), (lower, -1)):
                if box < 0:
                    continue
                rows += [3 * box, 3 * box + 1, 3 * box + 2]
                columns += [4 * k + corner] * 3
                values += [sign, sign * (x - centres[box, 0]), sign * (y - centres[box, 1])]
    equations = coo_matrix((values, (rows, columns)), (3 * len(boxes), 4 * len(contacts)))
    weights = np.zeros(3 * len(boxes))
    weights[::3] = masses
    ranges = []
    for box in range(len(boxes)):
        on_top = np.repeat([float(contact[1] == box) for contact in contacts], 4)
        found = [linprog(sign * on_top, A_eq=equations, b_eq=weights, method="highs") for sign in (1, -1)]
        if any(it.status == 2 for it in found):
            return None
        assert all(it.status == 0 for it in found), [it.message for it in found]
        ranges.append((found[0].fun, -found[1].fun))
    return np.array(ranges)


def pile(seed, count, base):
    """Boxes dropped at random; each has at least that share of its base on others, all are 20 to 30 cm high."""
    random = np.random.default_rng(seed)
    boxes = []
    for _ in range(3000):
        size = np.append(random.integers(30, 80, 2), 10 * random.integers(2, 4))
        x, y = random.integers(0, (180, 120) - size[:2])
        over = [b for b in boxes if x < b[3] and x + size[0] > b[0] and y < b[4] and y + size[1] > b[1]]
        z = max((b[5] for b in over), default=0)
        area = sum((min(x + size[0], b[3]) - max(x, b[0])) * (min(y + size[1], b[4]) - max(y, b[1]))
                   for b in over if b[5] == z)
        if z > 0 and area < base * size[0] * size[1] or z > 160:
            continue
        boxes.append((x, y, z, x + size[0], y + size[1], z + size[2]))
        if len(boxes) == count:
            break
    return boxes


class Bearing(CliTest):
    def bearing(self, boxes):
        """Rows of the table: least and largest load, and whether the box stands."""
        self.write("pile.txt", layout_text(boxes))
        done = self.run_here("check", "pile.txt", "--bearing")
        self.assert_exit(done, 0)
        rows = [(float(least), float(largest), note) for _, _, least, largest, note in ROW.findall(done.stdout)]
        self.assertEqual(len(rows), len(boxes), done.stdout)
        return np.array([row[:2] for row in rows]), [row[2] for row in rows], done

    def test_random_piles_bear_what_an_independent_solver_finds(self):
        standing = tipping = ranges = 0
        for seed in range(24):
            boxes = pile(seed, 12 + seed, (0.4, 0.6, 0.8)[seed % 3])
            with self.subTest(seed=seed, boxes=len(boxes)):
                found, notes, done = self.bearing(boxes)
                expected = bearing_by_scipy(boxes)
                self.assertEqual(any(notes), expected is None)
                self.assertEqual(bool(any(notes)), "vertical forces alone cannot balance" in done.stderr)
                if expected is None:
                    tipping += 1
                    continue
                standing += 1
                ranges += np.count_nonzero(expected[:, 1] - expected[:, 0] > 1)
                np.testing.assert_allclose(found, expected, rtol=0, atol=PRINTED)
        print(f"bearing: {standing} piles stand, {tipping} do not; {ranges} boxes with a range")
        self.assertGreater(standing, 8)
        self.assertGreater(tipping, 2)
        self.assertGreater(ranges, 20)

    def test_the_example_of_the_page_is_what_the_program_prints(self):
        content, command, expected = indented_blocks("docs/guide/bearing.md")[:3]
        name = command.split()[2]
        self.write(name, content)
        done = self.run_here(*command.split()[1:])
        self.assert_exit(done, 0)
        self.assertEqual((done.stderr, done.stdout), ("", expected))

    def test_without_limits_and_option_nothing_is_said(self):
        self.write("pile.txt", layout_text(pile(1, 5, 0.8)))
        done = self.run_here("check", "pile.txt")
        self.assert_exit(done, 0)
        self.assertNotIn("largest", done.stdout)
        self.assertNotIn("limit", done.stdout)


if __name__ == "__main__":
    unittest.main()
