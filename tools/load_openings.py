"""What of a container is open or low, which boxes are part of it, and how boxes leave it."""
import re

BED_HEIGHT = "0"  # cm: where the settings do not say it; floors had no end in versions that did not know the key
SIDES = {"front": (0, False), "rear": (0, True), "left": (1, False), "right": (1, True)}  # axis, and whether at its far end


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
    """The materials whose boxes are part of the container."""
    keys = {re.fullmatch(r"Material (-?\d+)/Fixed", key): str(value) for key, value in settings.items()}
    return {int(match[1]) for match, value in keys.items() if match and value.lower() in ("true", "yes", "1")}
