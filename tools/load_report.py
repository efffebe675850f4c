#!/usr/bin/python3
"""Writes a page to print for each layout of a results file, the worst first, as HTML or, with WeasyPrint, as PDF.

Each page shows the load from above, from the side, from both ends and from a corner, how the run was made, what fails
under what, which box goes first, what rests on boxes with a limit, and margins and wall forces where the run has them.
The page of the viewer prints the same one. Verdicts are by all that ever happened; of a file of an earlier version, by
where boxes are at the end. Example: load_report.py results.h5 report.html
"""
import argparse
import html
import json
import os
import pathlib
import re
import signal
import sys
import tempfile
from collections import Counter

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # each thread takes memory, of which there may be little
try:
    import h5py
    import numpy as np
except ImportError as missing:
    sys.exit(f"a report needs python3-h5py: {missing}")
from load_openings import Loads, side_name, size_text
from load_views import FILLS, HIGHEST, SURROUNDINGS, draw, is_near, packed_faces, rooms_of_views, turned_faces

VERDICTS = {0: "stayed", 1: "moved", 2: "fell", 3: "unstable", 4: "failed", 6: "not needed"}
STAYED, MOVED, FELL, UNSTABLE, FAILED, NOT_NEEDED = VERDICTS
GAVE_WAY = 5  # in files of earlier versions: a box was beyond a limit, and the world ended there
WITH_PEAKS = 3  # first version of the file that has what boxes did on the way
DECIDED = 4  # stop reason of a world that ended when its verdict was decided
CAVEATS = {1: ("not at rest", "the load was still moving when the acceleration began"),
           2: ("still moving", "a box was still moving when the world ended"),
           4: ("marginal", "a friction coefficient is within 2 % of what the acceleration asks for: what is not known so exactly decides")}
REPLICA_VERDICTS = ("", "holds", "fails", "uncertain")
SIDES = ("front", "rear", "left", "right")
FIXED_BOXES = 7  # of what is pressed, behind the six sides and the ground
PUSHED_BY = ((0, 1), (0, -1), (1, 1), (1, -1))  # axis and sign of the container's acceleration that pushes to each side
GRAVITY = 9.81  # m/s2: what norms call 1 g
ROUNDING = 1e-6  # of numbers that have two digits
LARGEST_MARGIN = 1.5  # g: margins are not sought beyond it
WORST = (UNSTABLE, FELL, MOVED)  # the worst first
ORDER = ("The worst come first: those with most boxes that are unstable, then those with most that fall, then those with most that move, "
         "under all accelerations together.")
READING_SECONDS = 30  # of processor time, after which the HDF5 library is taken not to come to an end: SIGPROF ends the process
TEXTS = ("name", "sha256", "header", "status_text", "engine", "config", "layout_hashes", "material_name", "box_name", "container_type",
         "open_sides", "drop_sides")  # datasets that are no numbers
WITHIN_LIMIT = 1e-3  # kg above a limit that count as within it, as for `holdfast check`
FEW_COLUMNS = 9  # of a table whose heads are in a line
# Lines for which a page has room in its tables of boxes, of bearing and of what is loaded, beside four accelerations; those that
# margins or walls take of them at least, those of the views of the end, of the heads of a table and of a second caveat that is
# explained, and the rows that each has anyway.
LINES, LINES_OF_MARGINS, LINES_OF_END, LINES_OF_HEADS, LINES_OF_CAVEAT, LEAST_ROWS = 20, 6, 12, 4, 2, 3
LINES_OF_SECOND_PAGE = 20  # that a load has where these do not fit; names may take two of them
LINE_HEIGHT = 18  # pixels
MOST_UNNAMED = 14  # kinds of boxes without names that are listed
MOST_RANGES = 8  # of numbers of boxes, in a list of what is loaded
MOST_LISTED = 6  # of what a line of the front page lists
MOST_ON_MATS = 20  # boxes that a note names
ECCENTRICITY = 0.05  # of the length, from the middle: where the centre of gravity of a container may lie in general
ECCENTRICITY_SOURCE = "CTU Code 2014, Annex 7, 3.1.4"
NO_CONTAINER = ("trailer", "van", "pallet")  # types whose axles, or who stacks them, say where a load may lie
ASIDE = 0.1  # a component of a push that is smaller than this share of the largest one is left out of its direction
CAPTIONS = {"top": "from above; the front wall is on the left", "side": "from the left side", "rear": "from the rear", "front": "from the front",
            "corner": "from above the door"}
ROOM_OF_END = (330, 150)  # pixels of a picture of the end: width and height
STYLE = pathlib.Path(__file__).with_name("load_report.css")


def check_types(file):
    """Everything but names is numbers, and goes into the page as it is."""
    def check(path, item):
        text = path.rsplit("/", 1)[-1] in TEXTS
        if isinstance(item, h5py.Dataset) and item.dtype.kind not in ("S" if text else "iuf"):
            raise ValueError(f"/{path} is no column of {'texts' if text else 'numbers'}")
    file.visititems(check)


def pressed_sides(forces):
    """Of what is pressed, the four walls and the fixed boxes together; a file of an earlier version has nothing of the latter."""
    fixed = forces[:, FIXED_BOXES] if forces.shape[1] > FIXED_BOXES else np.full(len(forces), np.nan)
    return np.column_stack([forces[:, 1:5], fixed])  # the floor comes first there


class Results:
    """What the report needs of a results file."""

    def __init__(self, file):
        check_types(file)
        self.attributes = dict(file.attrs)
        self.settings = dict(file["inputs/settings"].attrs)
        self.loads = Loads(file, self.settings)
        inputs = file["inputs/layouts"]
        self.layout_names = inputs["name"].asstr()[:]
        self.begin, self.count = (inputs[name][:].astype(int) for name in ("box_begin", "box_count"))
        self.low, self.high = inputs["corner_min"][:], inputs["corner_max"][:]
        self.acceleration_names = file["inputs/accelerations/name"].asstr()[:]
        self.worlds = {name: file[f"worlds/{name}"][:] for name in ("layout", "acceleration", "box_begin", "box_count", "stop_reason")}
        self.by_layout = np.argsort(self.worlds["layout"], kind="stable")  # worlds
        self.sorted_layout = self.worlds["layout"][self.by_layout]
        self.status_text = file["worlds/status_text"].asstr()[:]
        self.world_summary = {name: file[f"summary/worlds/{name}"][:] for name in file["summary/worlds"]}
        self.box_summary = {name: file[f"summary/boxes/{name}"][:] for name in file["summary/boxes"]}
        self.limits = dict(file["summary"].attrs)
        self.box_mass = file["boxes/mass"][:]
        # Per box how far it was displaced, m, lowered, m, and tilted, degrees: at most, and at the end.
        end = file["boxes/end_displacement"][:]
        self.box_end = np.column_stack([np.linalg.norm(end, axis=1), np.maximum(0, -end[:, 2]), file["boxes/end_tilt"][:]])
        self.initial = file["boxes/initial_position"][:].astype(float)
        self.start, self.end = self.places(file, end)
        self.judged_at_end = file.attrs["format_version"] < WITH_PEAKS
        if self.judged_at_end:
            self.box_peak = np.full_like(self.box_end, np.nan)
            self.box_peak[:, 0] = file["boxes/peak_displacement"][:]
            self.take_ends_for_peaks()
        else:
            self.box_peak = np.column_stack([file[f"boxes/peak_{name}"][:] for name in ("displacement", "drop", "tilt")])
            self.caveats = file["worlds/caveats"][:]
        self.margins = {name: values[:] for name, values in file["margins"].items()} if "margins" in file else None
        self.wall_force = pressed_sides(file["walls/lasting_force"]) if "walls" in file else None
        self.wall_limit = pressed_sides(file["walls/limit"]) if "walls" in file else None
        self.end_turn = self.last_orientations(file)
        self.replicas = {name: file[f"replicas/{name}"][:] for name in ("verdict", "failed", "count")} if "replicas" in file else None
        self.needed = self.needed_margins(file)
        self.pushes = self.hardest_pushes(file)  # per acceleration, in words
        self.state_hash = file["worlds/state_hash"][:]
        self.norm_source = ""  # where the numbers of the run's norm are from
        self.bearing = {}  # per layout with bearing limits: least and largest load on each box at rest, kg

    def places(self, file, end_displacement):
        """Centres of mass of all boxes where displacement counts from, and at the end, m."""
        start = self.initial.copy()
        if self.settings.get("Screening/ReferencePose") == "settled":
            settling = file["boxes/settling_displacement"][:]
            for world in np.flatnonzero(self.world_summary["verdict"] != UNSTABLE):
                start[self.rows_of(world)] += settling[self.rows_of(world)]
        return start, start + end_displacement

    def last_orientations(self, file):
        """Quaternions w, x, y, z of all boxes at the end, NaN where the file does not have them; None where all containers are
        closed, of which nobody asks."""
        if self.loads.all_closed:
            return None
        turns = np.full((len(self.box_mass), 4), np.nan)
        if "series/orientation" not in file:
            return turns
        for world, (row, samples) in enumerate(zip(file["worlds/row_begin"][:].astype(int), file["worlds/sample_count"][:].astype(int))):
            boxes = int(self.worlds["box_count"][world])
            if samples > 0 and boxes > 0:
                turns[self.rows_of(world)] = file["series/orientation"][row + (samples - 1) * boxes:row + samples * boxes]
        return turns

    def sides_left(self, world):
        """The side at which each box left the container that is outside at the end, by index: it was within as loaded, or has fallen since."""
        rows = self.rows_of(world)
        openings = self.loads.openings(int(self.worlds["layout"][world]))
        if openings.is_closed:
            return {}
        fell = self.box_end[rows][:, 1] > self.limits["drop_threshold"]
        sides = {box: openings.side_beyond(end) for box, (start, end) in enumerate(zip(self.start[rows], self.end[rows]))
                 if fell[box] or openings.side_beyond(start) is None}
        return {box: side for box, side in sides.items() if side}

    def needed_margins(self, file):
        """What the norm of the run asks for in each direction, g; zeros without a norm."""
        norm = str(self.settings.get("Screening/Norm", "")).split(":")[0]
        if not norm:
            return np.zeros(len(SIDES))
        accelerations = file["inputs/accelerations"]
        # Those of files have a point in their names.
        of_norm = [name.startswith(f"{norm}-") and "." not in name for name in self.acceleration_names]
        values = accelerations["value"][:][np.repeat(of_norm, accelerations["segment_count"][:].astype(int))]
        values = values[values[:, 2] == 0]  # as for the program: those that leave the load its weight
        return np.array([max(0.0, (sign * values[:, axis]).max(initial=0.0)) for axis, sign in PUSHED_BY]) / GRAVITY

    @staticmethod
    def hardest_pushes(file):
        """Where each acceleration pushes the load hardest, and how hard: "front 0.8 g"; nothing where it does not push."""
        accelerations = file["inputs/accelerations"]
        values = accelerations["value"][:]
        told = []
        for begin, count in zip(accelerations["segment_begin"][:].astype(int), accelerations["segment_count"][:].astype(int)):
            sizes = np.linalg.norm(values[begin:begin + count, :2], axis=1) / GRAVITY
            if not sizes.max(initial=0) > 0.005:
                told.append("")
                continue
            value = values[begin + sizes.argmax()] / GRAVITY
            sides = [name for name, (axis, sign) in zip(SIDES, PUSHED_BY) if sign * value[axis] > ASIDE * sizes.max()]
            told.append(f"{' and '.join(sides)} {sizes.max():.3g} g")
        return told

    def take_ends_for_peaks(self):
        """Fills in what a file of an earlier version has under another name, or not at all: which box went first, and when."""
        worlds, verdict = self.world_summary, self.world_summary["verdict"]
        worlds["verdict"] = np.where(verdict == GAVE_WAY, np.where(worlds["fallen_boxes"] > 0, FELL, MOVED), verdict)
        worlds["end_displacement"] = worlds["max_displacement"]
        worlds["fallen_at_end"] = worlds["fallen_boxes"]
        worlds["critical_box"] = np.zeros_like(worlds["fallen_boxes"])
        self.caveats = np.zeros_like(verdict)
        self.box_summary["first_beyond"] = np.full(len(self.box_mass), np.nan)

    def worlds_of(self, layout):
        begin, end = np.searchsorted(self.sorted_layout, (layout, layout + 1))
        return self.by_layout[begin:end]

    def span_of(self, layout):
        """The rows of a layout's boxes in what the file says of layouts."""
        return slice(int(self.begin[layout]), int(self.begin[layout]) + int(self.count[layout]))

    def box_text(self, layout, box):
        """A box as it is called on the page: its number, and its name where it has one."""
        name = self.loads.short_name(self.begin[layout] + box)
        return html.escape(f"box {box + 1}, {name}" if name not in ("", str(box + 1)) else f"box {box + 1}")

    def mass_of(self, layout):
        """Mass of a load without what is part of the container, kg; NaN where none of its worlds was simulated."""
        for world in self.worlds_of(layout):
            if self.worlds["box_count"][world] > 0:
                return float(self.box_mass[self.rows_of(world)][~self.loads.is_fixed[self.span_of(layout)]].sum())
        return np.nan

    def rows_of(self, world):
        begin = int(self.worlds["box_begin"][world])
        return slice(begin, begin + int(self.worlds["box_count"][world]))

    def fails(self, world):
        return self.world_summary["verdict"][world] not in (STAYED, NOT_NEEDED)

    def verdict_of(self, world):
        """The verdict in words; "at least" where the world ended when that was decided, while its load was moving on."""
        verdict = self.world_summary["verdict"][world]
        early = self.worlds["stop_reason"][world] == DECIDED and verdict != UNSTABLE
        return ("at least " if early else "") + VERDICTS[verdict]

    def under(self, world):
        """What a world went under: the name of its acceleration, or gravity where the load did not stand as it was."""
        unstable = self.world_summary["verdict"][world] == UNSTABLE
        return "gravity alone" if unstable else html.escape(self.acceleration_names[self.worlds["acceleration"][world]])

    def is_beyond(self, world):
        """Per box of the world, whether it was ever beyond a limit."""
        rows = self.rows_of(world)
        return np.any([self.box_summary[what][rows] for what in ("fallen", "moved", "tilted", "unstable")], axis=0)


def table(heads, rows, text=(), kind=""):
    """:param text: columns beside the first that are aligned to the left; as a dictionary, with one more class of each in the style
    :param kind: class of the table in the style
    """
    def kind_of(i):
        more = text[i] if isinstance(text, dict) else ""
        return f' class="text {more}"' if more else " class=text"

    def cells(tag, row):
        return "".join(f'<{tag}{kind_of(i) if i in text else ""}>{cell}</{tag}>' for i, cell in enumerate(row))

    head = f"<tr>{cells('th', heads)}</tr>" if any(heads) else ""
    return f"<table class='{kind}'>{head}" + "".join(f"<tr>{cells('td', row)}</tr>" for row in rows) + "</table>"


def counted(number, noun):
    """A number with its noun, which has an s, or es after an x, unless it is one."""
    return f"{number} {noun}{'' if number == 1 else 'es' if noun.endswith('x') else 's'}"


def fixed(value, digits=0):
    """A number with so many digits behind the point: a zero has no sign, and what is not known is a dash."""
    if np.isnan(value):
        return "-"
    text = f"{value:.{digits}f}"
    return text.lstrip("-") if float(text) == 0 else text


def number(value):
    """A number with the digits that it needs, three at most; what is not known is nothing."""
    return "" if np.isnan(value) else f"{value:.3g}"


def compared(value, limit):
    """A number beside a limit, with as many digits as it takes to see whether it is beyond."""
    texts = [fixed(value, digits) for digits in range(4)]
    return next((text for text in texts if text == "-" or (float(text) > limit) == (value > limit)), texts[-1])


def percent(share):
    """A share of a limit, or of a whole."""
    return f"{compared(100 * share, 100)} %"


def when(time):
    """When a box went beyond a limit first."""
    if np.isnan(time):
        return "-"
    return f"{fixed(time, 2)} s" if time >= 0 else "settling"


def weight(mass):
    """A mass, kg."""
    return fixed(mass, 0 if mass >= 100 else 1)


def listed(texts, most=MOST_LISTED, between=", "):
    """The first of several, and how many there are more."""
    return between.join(texts[:most]) + (f" and {len(texts) - most} more" if len(texts) > most else "")


def box_at(text, time):
    """A box with the time at which it was beyond a limit first, where that is known."""
    return text + ("" if np.isnan(time) else f", {when(time)}")


def most_and_last(most, last, limit):
    """A number at its largest, and in brackets at the end, beside its limit; either may not be known."""
    return f"{compared(most, limit)} ({compared(last, limit)})"


def first_box(results, world):
    """Index of the box that was first beyond a limit; None where none was, or where the file does not say which."""
    critical = int(results.world_summary["critical_box"][world])
    return critical - 1 if critical > 0 and results.is_beyond(world).any() else None


def worlds_table(results, layout, worlds):
    rows, explained = [], {}
    for world in worlds:
        summary = {name: column[world] for name, column in results.world_summary.items()}
        verdict = results.verdict_of(world)
        name = html.escape(results.acceleration_names[results.worlds["acceleration"][world]])
        pushed = results.pushes[results.worlds["acceleration"][world]]
        if summary["verdict"] in (FAILED, NOT_NEEDED):
            rows.append([name, pushed, verdict, *[""] * 6, html.escape(results.status_text[world])])
            continue
        first = first_box(results, world)
        caveats = dict(words for bit, words in CAVEATS.items() if results.caveats[world] & bit)
        explained |= {"In brackets": "at the end", **caveats}
        told = ""
        if results.replicas is not None:
            replicas = {key: column[world] for key, column in results.replicas.items()}
            told = f"{REPLICA_VERDICTS[replicas['verdict']]}: {replicas['failed']} of {replicas['count']} fail" if replicas["count"] else ""
        rows.append([name, pushed, f"<span class=bad>{verdict}</span>" if results.fails(world) else verdict,
                     "-" if first is None else box_at(results.box_text(layout, first), results.box_summary["first_beyond"][results.rows_of(world)][first]),
                     f"{summary['fallen_boxes']} ({summary['fallen_at_end']})", summary["moved_boxes"], summary["tilted_boxes"],
                     most_and_last(100 * summary["peak_displacement"], 100 * summary["end_displacement"], 100 * results.limits["move_threshold"]), told,
                     ", ".join(filter(None, [*caveats, html.escape(results.status_text[world])]))])
    heads = ["acceleration", "pushed to", "verdict", "goes first", "fallen", "moved", "tilted", "farthest, cm", "replicas", "to know"]
    text = {1: "", 2: "", 3: "name", 8: "", 9: ""}
    for last in (9, 8):
        if not any(row[last] for row in rows):
            for row in [heads, *rows]:
                row.pop(last)
            text = {(i if i < last else i - 1): kind for i, kind in text.items() if i != last}
    return table(heads, rows, text=text, kind="wrap") + note(results, explained)


def note(results, explained):
    """What a reader of any page has to know of its verdicts.

    :param explained: sentences by the words of a table that they explain
    """
    sentences = [f"{word}: {sentence}" for word, sentence in explained.items()] + ["Straps, air bags and stretch film are not modelled"]
    if results.judged_at_end:
        sentences.append("The file is of an earlier version: its worlds are judged by where boxes are at the end, since it does not have "
                         "what they did on the way")
    return f"<p class=note>{' '.join(sentence[0].upper() + sentence[1:] + '.' for sentence in sentences)}</p>"


def departures(results, layout, worlds):
    """How boxes leave the container under each acceleration, or before any, as sentences."""
    sentences = []
    for world in worlds:
        ways = {box: results.loads.openings(layout).way(side) for box, side in results.sides_left(world).items()}
        first = first_box(results, world)
        told = [f"{results.box_text(layout, first)}, which goes first, leaves {ways.pop(first)}"] if first in ways else []
        more = " more" if told else ""
        told += [f"{number}{more} {'leaves' if number == 1 else 'leave'} {way}" for way, number in Counter(ways.values()).items()]
        if told:
            sentences.append(f"<p>Under {results.under(world)}, {' and '.join(filter(None, [', '.join(told[:-1]), told[-1]]))}.</p>")
    return "".join(dict.fromkeys(sentences))  # all worlds under gravity alone are the same


def margins_table(results, layout):
    if results.margins is None or np.isnan(results.margins["margin"][layout]).all():
        return ""

    def size(margin):
        if np.isnan(margin) or margin < 0:
            return "-" if np.isnan(margin) else "unstable"
        # Rounded down: a load stands what the text says.
        hundredths = np.floor(100 * margin + ROUNDING)
        return f"{fixed(hundredths / 100, 2)} g" if margin < LARGEST_MARGIN else f"{LARGEST_MARGIN:.2f}+ g"

    # A file of an earlier version has the margins in place alone, and is judged by them.
    judged = "" if results.judged_at_end else "_within_limits"
    rows = []
    for i, side in enumerate(SIDES):
        in_place, margin, box = (results.margins[name][layout, i] for name in ("margin", f"margin{judged}", f"critical_box{judged}"))
        needed = results.needed[i]
        lacks = margin + ROUNDING < needed and margin < LARGEST_MARGIN  # larger ones are not known
        stands = f"<span class=bad>{size(margin)}</span>" if lacks else size(margin)
        rows.append([side, *([size(in_place)] if judged else []), stands, f"{needed:.3g} g" if needed else "-", results.box_text(layout, int(box) - 1) if box else "-"])
    heads = ["pushed to", "in place", *(["within limits"] if judged else []), "needed", "goes first above"]
    return part("How many g it stands", table(heads, rows, text={len(heads) - 1: "name"}))


def walls_table(results, layout, worlds):
    if results.wall_force is None:
        return ""
    force = results.wall_force[worlds]
    if np.isnan(force).all():
        return ""
    walls, has_fixed = results.loads.openings(layout).walls, results.loads.is_fixed[results.span_of(layout)].any()
    rows = []
    for i, side in enumerate([*SIDES, "fixed boxes"]):
        if np.isnan(force[:, i]).all() or not (walls[side] > 0 if side in walls else has_fixed):
            continue
        world = worlds[np.nanargmax(force[:, i])]
        most, limit = results.wall_force[world, i], results.wall_limit[world, i]
        share = percent(most / limit) if limit > 0 else "-"
        rows.append([side, f"{fixed(most / 1000, 1)} kN", f"{fixed(limit / 1000, 1)} kN" if limit > 0 else "-",
                     f"<span class=bad>{share}</span>" if most > limit > 0 else share,
                     html.escape(results.acceleration_names[results.worlds["acceleration"][world]])])
    norm = str(results.settings.get("Screening/Walls", ""))
    return part(f"Force on the walls{', limits of ' + html.escape(norm) if norm else ''}",
                table(["wall", "largest", "limit", "share", "under"], rows, text=(4,)))


def lines_beside(parts):
    """Lines that margins and walls take, which stand beside each other: a heading, and the rows of the longer table."""
    return max(LINES_OF_MARGINS, *(1 + text.count("<tr>") for text in parts)) if any(parts) else 0


def lines_of_caveats(caveats):
    """Lines that caveats take beyond the first of a page: where a world has two, and where a second one is explained."""
    all_of_page = [bit for bit in CAVEATS if any(own & bit for own in caveats)]
    wrapped = sum(max(0, sum(bool(own & bit) for bit in CAVEATS) - 1) for own in caveats)
    return wrapped + LINES_OF_CAVEAT * max(0, len(all_of_page) - 1)


def rows_for(room, wanted):
    """Rows of the tables that share the room of a page, evenly but for those that want fewer.

    :param room: lines, with those of the heads of tables
    :param wanted: rows of each table at most; 0: it is not there
    """
    rows = [min(LEAST_ROWS, most) for most in wanted]
    room -= LINES_OF_HEADS * np.count_nonzero(wanted) + sum(rows)
    for _ in range(room if room >= 0 else room + LINES_OF_SECOND_PAGE):
        growing = [i for i, most in enumerate(wanted) if rows[i] < most]
        if growing:
            rows[min(growing, key=rows.__getitem__)] += 1
    return rows


def part(title, *texts):
    """A part of a page with a heading, which a break of the page does not cut in two."""
    return f"<div class=part><h3>{title}</h3>{''.join(texts)}</div>"


def more_boxes(number):
    """How many boxes a table leaves out."""
    return f"<p>and {counted(number, 'more box')}</p>" if number > 0 else ""


def farthest_boxes(results, worlds):
    """The boxes that were beyond a limit, with how far each went and the acceleration in which it went farthest; the farthest first."""
    found = {}
    for world in worlds:
        rows = results.rows_of(world)
        for box in np.flatnonzero(results.is_beyond(world)):
            peak = float(results.box_peak[rows][box, 0])
            if box not in found or peak > found[box][0]:
                found[box] = (peak, world)
    return dict(sorted(found.items(), key=lambda item: (-item[1][0], item[0])))


def boxes_table(results, layout, found, most):
    """:param found: of farthest_boxes"""
    order = list(found)
    loads, span = results.loads, results.span_of(layout)
    limits = [results.limits[f"{name}_threshold"] for name in ("move", "drop", "tilt")]
    lines = []
    for box in order[:most]:
        _, world = found[box]
        row, own = results.rows_of(world).start + box, span.start + box
        size = results.high[own] - results.low[own]
        excursion = [most_and_last(unit * most, unit * last, unit * limit)
                     for unit, most, last, limit in zip((100, 100, 1), results.box_peak[row], results.box_end[row], limits)]
        side = results.sides_left(world).get(box)
        lines.append([box + 1, html.escape(loads.short_name(own)), " × ".join(f"{round(100 * part, 1):g}" for part in size),
                      weight(results.box_mass[row]), weight(loads.bearing_limit[own]), *excursion,
                      when(results.box_summary["first_beyond"][row]), results.under(world), side_name(side) if side else ""])
    columns = {"box": True, "name": any(map(loads.name, range(span.start, span.stop))), "size, cm": True, "mass, kg": True,
               "may bear, kg": np.isfinite(loads.bearing_limit[span]).any(), "farthest, cm": True, "drop, cm": True, "tilt, °": True,
               "beyond from": True, "under": True, "leaves at": any(line[-1] for line in lines)}
    heads = [head for head, shown in columns.items() if shown]
    lines = [[cell for cell, shown in zip(line, columns.values()) if shown] for line in lines]
    text = {i: "name" if head == "name" else "" for i, head in enumerate(heads) if head in ("name", "under", "leaves at")}
    kind = "many" if len(heads) > FEW_COLUMNS else ""
    return part("What went beyond a limit", table(heads, lines, text=text, kind=kind), more_boxes(len(order) - most))


def limited_boxes(results, layout):
    """The boxes with a bearing limit whose loads are known, with the least and the largest load that statics admits; the nearest to
    its limit first."""
    if layout not in results.bearing:
        return []
    limits = results.loads.bearing_limit[results.span_of(layout)]
    ranges = np.array(results.bearing[layout], dtype=float)  # what is not known is null there
    limited = np.flatnonzero(np.isfinite(limits))
    shares = np.nan_to_num(ranges[limited, 1], nan=np.inf) / np.maximum(limits[limited], WITHIN_LIMIT)
    return [(int(box), ranges[box]) for box in limited[np.argsort(-shares, kind="stable")]]


def bearing_table(results, layout, limited, most):
    """What rests on boxes with a bearing limit.

    :param limited: of limited_boxes
    """
    if not limited:
        return ""
    span = results.span_of(layout)
    rows = []
    for box, loads in limited[:most]:
        limit = float(results.loads.bearing_limit[span.start + box])
        texts = [weight(load) if weight(load) != weight(limit) else compared(load, limit) for load in loads]
        cells = [f"<span class=bad>{text}</span>" if load > limit + WITHIN_LIMIT else text for text, load in zip(texts, loads)]
        rows.append([box + 1, html.escape(results.loads.short_name(span.start + box)), *cells, weight(limit)])
    return part("What rests on boxes with a limit, by gravity alone",
                table(["box", "name", "least, kg", "largest, kg", "may bear, kg"], rows, text={1: "name"}), more_boxes(len(limited) - most))


def colour_key(meanings, states):
    """What the colours of a view mean that it has, by their names in FILLS."""
    meanings = {name: meaning for name, meaning in {**meanings, "fixed": "fixed, part of the container"}.items() if name in states}
    spans = [f'<span class={name} style="background-color:{FILLS[name]}"></span>{meaning}' for name, meaning in meanings.items()]
    return f"<p class=key>{''.join(spans)}</p>"


def end_views(results, layout, worlds):
    """The load as it lies at the end of the world in which most boxes leave the container, with those on the ground; nothing where
    none leaves, or where the file does not say how boxes have turned."""
    left = {world: len(results.sides_left(world)) for world in worlds}
    world = max(left, key=left.get, default=None)
    if not left.get(world) or np.isnan(results.end_turn[results.rows_of(world)]).any():
        return ""
    rows = results.rows_of(world)
    span = results.span_of(layout)
    openings, fixed = results.loads.openings(layout), results.loads.is_fixed[span]
    states = np.where(results.is_beyond(world), "later", np.where(fixed, "fixed", "still")).astype(object)
    if (first := first_box(results, world)) is not None:
        states[first] = "first"
    loaded = results.initial[rows]
    boxes = list(zip(results.low[span] - loaded, results.high[span] - loaded, results.end_turn[rows], results.end[rows]))
    far = [box for box, centre in enumerate(results.end[rows]) if not is_near(centre, openings)]
    figures = ""
    for view, caption in (("top", CAPTIONS["top"]), ("corner", "from the corner")):
        faces = [(box, faces) for box, faces in turned_faces(boxes, view) if box not in far]
        figures += figure(draw(faces, states, openings, view, ROOM_OF_END), caption)
    key = colour_key({"first": "first to go", "later": "beyond a limit at some time", "still": "stayed"}, states)
    if far:
        key += (f"<p class=note>More than {SURROUNDINGS:g} m from the container, and not drawn: {numbers_text(far, MOST_ON_MATS)}.</p>")
    return part(f"At the end under {results.under(world)}", f"<div class=views>{figures}</div>", key)


def centre_text(results, layout, world):
    """Where the centre of gravity of a load is, and where it may lie."""
    free = ~results.loads.is_fixed[results.span_of(layout)]
    mass = results.box_mass[results.rows_of(world)][free].astype(float)
    if not mass.sum() > 0:
        return "-"
    openings = results.loads.openings(layout)
    x, y, z = mass @ results.initial[results.rows_of(world)][free] / mass.sum()
    length = openings.container[0]
    where = f"{x:.2f} m from the front wall ({percent(x / length)} of the length), {y:.2f} m from the left side, {z:.2f} m above the floor"
    if results.loads.type_of(layout).startswith(NO_CONTAINER):
        return f"{where}. Axle loads are not calculated."
    low, high = ((0.5 + sign * ECCENTRICITY) * length for sign in (-1, 1))
    may = f"It may lie from {low:.2f} m to {high:.2f} m from the front wall ({ECCENTRICITY_SOURCE})"
    return f"{where}. " + (f"{may}: it does." if low <= x <= high else f"<span class=bad>{may}: it does not.</span>")


def run_facts(results):
    """How a run was made, by name."""
    attributes, settings = results.attributes, results.settings
    norm = str(settings.get("Screening/Norm", ""))
    accuracy = f" {settings.get('Native/Accuracy', '')}" if attributes["engine"] == "native" else ""
    made = str(attributes["created_utc"]).replace("T", " ").replace("Z", " UTC")
    return {"norm": f"{norm}: {results.norm_source}" if results.norm_source else norm or "none: accelerations of files",
            "friction": friction_text(settings), "of materials": friction_of_materials(settings), "limits": limits_of(results),
            "simulated": f"{attributes['software']}, {attributes['engine']}{accuracy}, {made}"}


def facts_table(results, layout, world):
    openings = results.loads.openings(layout)
    container = [f"{results.loads.type_of(layout)}, {size_text(openings.container)}".removeprefix(", "), openings.text()]
    facts = {"container": html.escape("; ".join(filter(None, container))), "centre of gravity": centre_text(results, layout, world),
             **{name: html.escape(text) for name, text in run_facts(results).items()}}
    return table(["", ""], [[name, text] for name, text in facts.items() if text], text=(1,), kind="wrap")


def ranges_text(boxes):
    """Numbers of boxes, those that follow each other together."""
    ranges = []
    for box in boxes:
        if ranges and ranges[-1][1] == box - 1:
            ranges[-1][1] = box
        else:
            ranges.append([box, box])
    texts = [f"{first + 1}" if first == last else f"{first + 1}{', ' if last == first + 1 else ' to '}{last + 1}" for first, last in ranges]
    return ", ".join(texts[:MOST_RANGES]) + (", …" if len(texts) > MOST_RANGES else "")


def items_of(results, layout, world):
    """Boxes by name and size, each with its mass; nothing where boxes have no names and hardly two are alike: such a list says nothing that the
    drawings do not."""
    loads, span, rows = results.loads, results.span_of(layout), results.rows_of(world)
    items = {}
    for box in np.flatnonzero(~loads.is_fixed[span]):
        own = span.start + box
        name = re.sub(r"[\s_#.-]*\d+$", "", loads.name(own)) or loads.name(own) or loads.materials.get(own, "")
        size = " × ".join(f"{round(100 * part, 1):g}" for part in results.high[own] - results.low[own])
        items.setdefault((name, size), {})[int(box)] = float(results.box_mass[rows][box])
    return items if len(items) <= MOST_UNNAMED or any(name for name, _ in items) else {}


def items_table(items, most):
    """What is loaded."""
    if not items:
        return ""
    lines = []
    for (name, size), boxes in list(items.items())[:most]:
        masses = list(boxes.values())
        each = " to ".join(dict.fromkeys([weight(min(masses)), weight(max(masses))]))
        lines.append([html.escape(name) or "box", len(masses), size, f"{each} kg", f"{weight(sum(masses))} kg", ranges_text(boxes)])
    heads = ["item", "number", "length × width × height, cm", "each", "together", "boxes"]
    return part("What is loaded", table(heads, lines, text=(5,), kind="wrap items"), more_boxes(sum(map(len, list(items.values())[most:]))))


def hashes(results, layout, worlds):
    """How worlds of a layout ended, to the bit."""
    told = [f"{html.escape(results.acceleration_names[results.worlds['acceleration'][world]])} {results.state_hash[world]:016x}" for world in worlds]
    return f"<p class=note>{html.escape(results.layout_names[layout])}, hashes of the ends: {', '.join(told)}.</p>"


def page(results, layout):
    worlds = results.worlds_of(layout)
    failing = [world for world in worlds if results.fails(world)]
    simulated = [world for world in worlds if results.worlds["box_count"][world] > 0]
    span, openings = results.span_of(layout), results.loads.openings(layout)
    boxes = list(zip(results.low[span], results.high[span]))
    fixed = results.loads.is_fixed[span]
    states = ["fixed" if of_container else "still" for of_container in fixed]
    for world in simulated:
        for box in np.flatnonzero(results.is_beyond(world)):
            states[box] = "later" if states[box] == "still" else states[box]
    for world in simulated:
        if (first := first_box(results, world)) is not None:
            states[first] = "first"
    size = sum(np.prod(high - low) for (low, high), of_container in zip(boxes, fixed) if not of_container) / np.prod(openings.container)
    rooms = rooms_of_views(openings)
    names = [results.loads.name(span.start + box) for box in range(len(boxes))]
    captions = CAPTIONS if openings.is_full("rear") else {**CAPTIONS, "corner": "from above the rear"}

    def view_of(view):
        return figure(draw(packed_faces(boxes, view), states, openings, view, rooms[view], names), captions[view])

    views = "".join(f"<div class=views>{''.join(map(view_of, row))}</div>" for row in (("top", "corner"), ("side", "rear", "front"))) if boxes else ""
    key = colour_key({"first": "first to go under some acceleration", "later": "beyond a limit", "still": "stayed under all"}, states)
    if text := mats_text(results, layout):
        key += f"<p class=note>{text}</p>"
    if not openings.is_closed:
        text = openings.text()
        key += f"<p class=note>{text[0].upper() + text[1:]}. The floor is dashed where no wall stands on it.</p>"
    also = f", and {fixed.sum()} fixed" if fixed.any() else ""
    found = farthest_boxes(results, simulated)
    items = items_of(results, layout, simulated[0]) if simulated else {}
    left, end = departures(results, layout, simulated), end_views(results, layout, simulated)
    beside = [margins_table(results, layout), walls_table(results, layout, worlds) if simulated else ""]
    limited = limited_boxes(results, layout)
    room = (LINES - lines_beside(beside) - (LINES_OF_END if end else 0) - left.count("<p>") - max(0, len(worlds) - 4)
            - lines_of_caveats([results.caveats[world] for world in worlds])
            + int(HIGHEST - rooms["top"][1] - rooms["side"][1]) // LINE_HEIGHT)
    rows = rows_for(room, [len(found), len(limited), len(items)])
    tables = ((boxes_table(results, layout, found, rows[0]) if found else "") + bearing_table(results, layout, limited, rows[1])
              + items_table(items, rows[2]))
    mass = "" if np.isnan(results.mass_of(layout)) else f" of {weight(results.mass_of(layout))} kg"
    holds = all(results.world_summary["verdict"][world] == STAYED for world in worlds)
    every = counted(len(worlds), "acceleration")
    verdict = (f"<span class=good>holds under {'its acceleration' if len(worlds) == 1 else f'all {every}'}</span>" if holds
               else f"<span class=bad>fails under {len(failing)} of {every}</span>")
    return (f"<section><h2>{html.escape(results.layout_names[layout])}</h2><p>{counted(np.sum(~fixed), 'box')}{mass}, {percent(size)} of the "
            f"container's volume{also}; {verdict}.</p>{views}"
            f"{key if boxes else ''}{facts_table(results, layout, simulated[0]) if simulated else ''}{worlds_table(results, layout, worlds)}{left}{end}<div class=beside>{''.join(beside)}</div>"
            f"{tables}{hashes(results, layout, simulated) if simulated else ''}</section>")


def figure(picture, caption):
    return f"<figure>{picture}<figcaption>{caption}</figcaption></figure>"


def numbers_text(boxes, most):
    """Boxes by their numbers: "boxes 1, 2 and 3 more"."""
    return f"{'box' if len(boxes) == 1 else 'boxes'} {listed([str(box + 1) for box in boxes], most)}"


def mats_text(results, layout):
    """Which boxes stand on anti-slip mats, as a sentence; nothing where none does."""
    mats = results.loads.mat[results.span_of(layout)]
    told = []
    for mat in np.unique(mats[np.isfinite(mats)]):
        told.append(f"on a mat of {number(mat)}: {numbers_text(np.flatnonzero(mats == mat), MOST_ON_MATS)}")
    return f"{'; '.join(told).capitalize()}." if told else ""


def limits_of(results):
    move, drop, tilt = (results.limits[f"{name}_threshold"] for name in ("move", "drop", "tilt"))
    return f"displaced by {100 * move:g} cm, lowered by {100 * drop:g} cm, tilted by {tilt:g}°, {'at the end' if results.judged_at_end else 'at any time'}"


def friction_text(settings):
    """The coefficients of friction that act, in the words of the program."""
    if settings.get("Contact/FrictionModel") == "pairs":
        box, floor, walls = (float(settings.get(f"Contact/Box{other}", "nan")) for other in ("Box", "Floor", "Wall"))
        return f"box on box {box:.3g}, on the floor {floor:.3g}, on walls {walls:.3g}"
    box, container = (float(settings.get(f"Simulation Settings/{name}Friction", "nan")) for name in ("Box", "Container"))
    return f"box on box {box * box:.3g}, on floor and walls {box * container:.3g}"


def friction_of_materials(settings):
    """The coefficients of materials that have their own; nothing where none has."""
    if settings.get("Contact/FrictionModel") == "pairs":
        return listed([f"{key.removeprefix('Friction/')} {float(value):.3g}" for key, value in settings.items() if key.startswith("Friction/")],
                      between="; ")
    container = float(settings.get("Simulation Settings/ContainerFriction", "nan"))
    own = {match[1]: float(value) for key, value in settings.items() if (match := re.fullmatch(r"Material (.+)/Friction", key)) and str(value)}
    return listed([f"{name} on {name} {factor * factor:.3g}, on floor and walls {factor * container:.3g}" for name, factor in own.items()],
                  between="; ")


def front_page(results, order, shown):
    names = {**run_facts(results), "container": results.loads.run_text(), "command": str(results.attributes["command_line"])}
    facts = table(["run", ""], [[key, html.escape(value)] for key, value in names.items() if value], text=(1,), kind="wrap")
    rows = [[html.escape(results.layout_names[layout]), ", ".join(
        f"{html.escape(results.acceleration_names[results.worlds['acceleration'][world]])}: {results.verdict_of(world)}"
        for world in results.worlds_of(layout) if results.fails(world)) or "holds"] for layout in order[:shown]]
    failing = sum(any(map(results.fails, results.worlds_of(layout))) for layout in order)
    told = f"{failing} of {counted(len(order), 'layout')} {'does' if failing == 1 else 'do'} not hold.{' ' + ORDER if failing > 1 else ''}"
    if failing == 0:
        told = "The layout holds." if len(order) == 1 else "All layouts hold."
    if shown < len(order):
        told += f" The worst {shown} have a page here." if shown > 1 else " The worst one has a page here."
    return (f"<h1>How loads stand</h1><p>{told}</p>{note(results, {})}{facts}"
            + (table(["layout", "fails under"], rows, text=(1,), kind="wrap") if rows else ""))


def worst_first(results):
    """Layouts in the order that ORDER says, and then those that hold, in the order of the file."""
    counts = {FELL: ("fallen_boxes",), UNSTABLE: ("unstable_boxes",), MOVED: ("moved_boxes", "tilted_boxes")}
    ranks, holding = [], []
    for layout in range(len(results.layout_names)):
        failing = [world for world in results.worlds_of(layout) if results.fails(world)]
        if failing:
            boxes = Counter()
            for world in failing:
                verdict = results.world_summary["verdict"][world]
                boxes[verdict] += max((int(results.world_summary[name][world]) for name in counts.get(verdict, ())), default=0)
            ranks.append((*(-boxes[verdict] for verdict in WORST), layout))
        else:
            holding.append(layout)
    return [layout for *_, layout in sorted(ranks)] + holding


def write(text, path):
    """Written beside and renamed, so that an interrupted report leaves the old one."""
    if path.endswith(".pdf"):
        try:
            import weasyprint
        except ImportError:
            sys.exit("a PDF needs WeasyPrint, Debian's package weasyprint; a browser can also print the report as HTML")
        content = weasyprint.HTML(string=text).write_pdf()
    else:
        content = text.encode()
    target = os.path.realpath(path)  # a link stays, and what it leads to is replaced
    try:
        with tempfile.NamedTemporaryFile(dir=os.path.dirname(target), prefix=".report-", delete=False) as beside:
            try:
                beside.write(content)
                beside.flush()
                os.fchmod(beside.fileno(), 0o666 & ~current_umask())
                os.replace(beside.name, target)
            except OSError:
                os.unlink(beside.name)
                raise
    except OSError as error:
        sys.exit(f"{path}: cannot be written: {error.strerror}")


def current_umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", help="results file of holdfast screen")
    parser.add_argument("output", help="report to write, .html or .pdf")
    parser.add_argument("--bearing", help="JSON with the least and the largest load on each box of layouts by number, kg")
    parser.add_argument("--norm-source", default="", help="where the numbers of the run's norm are from")
    parser.add_argument("--most", type=int, default=50, help="most layouts that get a page, the worst ones (default: %(default)s)")
    options = parser.parse_args()
    try:
        signal.setitimer(signal.ITIMER_PROF, READING_SECONDS)
        with h5py.File(options.results) as file:
            results = Results(file)
        results.norm_source = options.norm_source
        if options.bearing:
            with open(options.bearing, encoding="utf-8") as file:
                results.bearing = {int(layout): ranges for layout, ranges in json.load(file).items()}
        signal.setitimer(signal.ITIMER_PROF, 0)
        make_report(results, options)
    except MemoryError:
        sys.exit(f"{options.results}: takes more memory than a report may take; if the file is to be trusted, --memory allows more")
    except Exception as error:  # whatever is in a file that somebody else made
        sys.exit(f"{options.results}: cannot be drawn: {' '.join(str(error).split()) or type(error).__name__}")


def make_report(results, options):
    order = worst_first(results)
    shown = min(len(order), options.most)
    pages = "".join(page(results, layout) for layout in order[:shown])
    write(f'<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="generator" content="holdfast report">'
          f"<title>How loads stand</title><style>{STYLE.read_text(encoding='utf-8')}</style></head><body class=report>{front_page(results, order, shown)}{pages}</body></html>\n",
          options.output)
    all_of = counted(len(order), "layout")
    told = f"{shown} of {all_of}; --most {len(order)} writes all" if shown < len(order) else all_of
    print(f"{options.output}: {told}")


if __name__ == "__main__":
    main()
