"""What loads say of their boxes and of their containers: what is open or low, what is part of it, and how boxes leave it."""
import re

import numpy as np

BED_HEIGHT = "0"  # cm: where the settings do not say it; floors had no end in versions that did not know the key
SIDES = {"front": (0, False), "rear": (0, True), "left": (1, False), "right": (1, True)}  # axis, and whether at its far end
LONGEST_NAME = 40  # letters of a name within a sentence
ROWS_READ = 65536  # texts in memory at a time


def side_name(side):
    return f"{side} side" if side in ("left", "right") else side


class Openings:
    """Heights of the walls, the roof, and the floor above the ground.

    :param settings: texts by section and key, as a results file has them
    :param container: inner length, width and height, m
    """

    def __init__(self, settings, container):
        self.container = container
        opened, low = (re.findall(r"[a-z]+|[\d.]+", str(settings.get(f"Container/{key}", "")).lower()) for key in ("OpenSides", "DropSides"))
        heights = {name: float(height) / 100 for name, height in zip(low, low[1:]) if name in SIDES and height[0].isdigit()}
        self.walls = {name: 0.0 if name in opened else min(container[2], heights.get(name, container[2])) for name in SIDES}  # m; 0: open
        self.has_roof = "roof" not in opened
        self.bed_height = float(settings.get("Container/BedHeight") or BED_HEIGHT) / 100  # m; 0: a floor without end

    def is_full(self, side):
        return self.walls[side] >= self.container[2]

    def is_low(self, side):
        return 0 < self.walls[side] < self.container[2]

    @property
    def is_closed(self):
        return self.has_roof and all(map(self.is_full, SIDES))

    def text(self):
        """What is open or low, in words; nothing where all is closed."""
        if self.is_closed:
            return ""
        opened = [name for name in SIDES if self.walls[name] == 0] + ([] if self.has_roof else ["roof"])
        told = [f"{', '.join(opened)} open"] if opened else []
        told += [f"{name} {100 * self.walls[name]:g} cm high" for name in SIDES if self.is_low(name)]
        return "; ".join(told + ([f"floor {100 * self.bed_height:g} cm above the ground"] if self.bed_height > 0 else []))

    def side_beyond(self, point):
        """The side that a point is beyond: an open or low one, the farthest of several; the open roof where all that it is
        beyond are full walls; None where it is within, or where no way leads out."""
        beyond = {name: point[axis] - self.container[axis] if far else -point[axis] for name, (axis, far) in SIDES.items()}
        ways = [name for name in SIDES if beyond[name] > 0 and not self.is_full(name)]
        if ways:
            return max(ways, key=beyond.get)
        return "roof" if max(beyond.values()) > 0 and not self.has_roof else None

    def way(self, side):
        """How a box leaves at a side, in words."""
        return f"{'over the low' if self.walls.get(side, 0) > 0 else 'through the open'} {side_name(side)}"


def fixed_materials(settings):
    """The materials whose boxes are part of the container: numbers as texts, and names."""
    keys = {re.fullmatch(r"Material (.+)/Fixed", key): str(value) for key, value in settings.items()}
    return {match[1] for match, value in keys.items() if match and value.lower() in ("true", "yes", "1")}


def size_text(size):
    return " × ".join(f"{round(part, 3):g}" for part in size) + " m"


class Loads:
    """What the layouts of a results file say of themselves. Files of earlier versions have less, and hold for all layouts what the
    settings say.

    :param file: the results file
    :param settings: texts by section and key, as it has them
    """

    def __init__(self, file, settings):
        inputs = file["inputs/layouts"]
        layouts, boxes = len(inputs["name"]), len(inputs["material"])
        self.run_type = str(settings.get("Container/Type", ""))
        run_size = [float(settings[f"Container/{name}"]) / 100 for name in ("Length", "Width", "Height")]  # m
        self.run_openings = Openings(settings, run_size)
        self.names = texts_in(inputs, "box_name")  # by box
        self.materials = texts_in(inputs, "material_name")  # by box, of those whose material has a name
        self.bearing_limit, self.mat = (inputs[name][:] if name in inputs else np.full(boxes, np.nan) for name in ("bearing_limit", "mat"))
        fixed = fixed_materials(settings)
        # Per box of the layouts: part of the container.
        self.is_fixed = np.isin(inputs["material"][:], [int(name) for name in fixed if re.fullmatch(r"-?\d+", name)])
        self.is_fixed[[box for box, name in self.materials.items() if name in fixed]] = True
        if "fixed" in inputs:
            self.is_fixed |= inputs["fixed"][:] != 0
        sizes = inputs["container_size"][:] if "container_size" in inputs else np.full((layouts, 3), np.nan)
        own = [i for i in range(layouts) if np.isfinite(sizes[i]).all()]
        types, opened, low = ({} if not own else texts_in(inputs, name) for name in ("container_type", "open_sides", "drop_sides"))
        beds = inputs["bed_height"][:] if own else ()
        self.own = {i: (types.get(i, ""), Openings({"Container/OpenSides": opened.get(i, ""), "Container/DropSides": low.get(i, ""),
                                                    "Container/BedHeight": str(100 * beds[i])}, [float(part) for part in sizes[i]]))
                    for i in own}
        self.layouts = layouts

    def openings(self, layout):
        """Of the container of a layout."""
        return self.own[layout][1] if layout in self.own else self.run_openings

    @property
    def all_closed(self):
        return self.run_openings.is_closed and all(openings.is_closed for _, openings in self.own.values())

    def type_of(self, layout):
        """The type of the container of a layout in the catalogue; nothing where it has none."""
        return self.own[layout][0] if layout in self.own else self.run_type

    def run_text(self):
        """The container of the run, or that layouts have their own."""
        if self.own and len(self.own) == self.layouts:
            return "each layout has its own"
        own = f"{len(self.own)} of {self.layouts} layouts have their own" if self.own else ""
        return "; ".join(filter(None, [self.run_type, size_text(self.run_openings.container), self.run_openings.text(), own]))

    def name(self, box):
        """The name of a box of the layouts; nothing where it has none but its number."""
        return self.names.get(int(box), "")

    def short_name(self, box):
        name = self.name(box)
        return name if len(name) <= LONGEST_NAME else f"{name[:LONGEST_NAME - 1].rstrip()}…"


def texts_in(group, name):
    """The texts of a dataset that are not empty, by row; none where the file does not have it. What is cut within a letter ends
    before it."""
    found = {}
    if name not in group:
        return found
    dataset = group[name]
    for begin in range(0, len(dataset), ROWS_READ):
        part = dataset[begin:begin + ROWS_READ]
        found |= {begin + int(row): part[row].decode(errors="ignore").strip() for row in np.flatnonzero(part != b"")}
    return found
