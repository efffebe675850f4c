"""Draws a load as SVG: from above, from the left side, from the rear, from the front, and from a corner."""
import html

import numpy as np

from load_openings import SIDES

FILLS = {"still": "#e9edf2", "later": "#f3c58b", "first": "#d9534f", "fixed": "#949da8"}
LINE, FRAME, BRIGHT = "#5a6470", "#222831", "#ffffff"
BED, GROUND = "#dfe2e6", "#f3f4f6"
PAGE_WIDTH = 684  # pixels
GAP = 12  # pixels between two pictures
# Pixels: a page has room for pictures that are so high, of the load from above and from the side together, and of its corner.
HIGHEST, HIGHEST_CORNER = 250, 130
LETTER, LETTER_WIDTH, LINE_HEIGHT = 7, 0.56, 1.15  # pixels of letters of labels, and shares of that: width of one, height of a line
MOST_LINES = 3  # of a label
MOST_ORDERED = 1500  # boxes of which it is found which one hides which; more are painted by distance
GROUND_MARGIN = 0.5  # m around the container that the ground is drawn for
SURROUNDINGS = 5.0  # m around the container in which boxes are drawn that have left it
# Where a point of the container goes on the page, per view: rows are the page's right and up.
PROJECTIONS = {"top": np.array([[1.0, 0, 0], [0, 1, 0]]), "side": np.array([[1.0, 0, 0], [0, 0, 1]]),
               "rear": np.array([[0.0, 1, 0], [0, 0, 1]]), "front": np.array([[0.0, -1, 0], [0, 0, 1]]),
               "corner": np.array([[0.87, 0.5, 0], [-0.3, 0.4, 0.85]])}  # seen from above the door, on the left
# Faces that a view sees: axis, and whether the one with the larger coordinate.
FACES = {"top": [(2, True)], "side": [(1, False)], "rear": [(0, True)], "front": [(0, False)],
         "corner": [(0, True), (1, False), (2, True)]}
# Corners of a face, in units of the box, in the two other axes.
SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))
SHADES = {0: 0.86, 1: 0.93, 2: 1.0}


def rooms_of_views(openings):
    """Width and height of the picture of a load in each view, in pixels. Those that look along an axis have one scale, and three of
    them fit beside each other."""
    length, width, height = openings.container
    height += 0 if openings.is_closed else openings.bed_height
    scale = min((PAGE_WIDTH - 2 * GAP - 6) / (length + 2 * width), HIGHEST / (width + height))
    sizes = {"top": (length, width), "side": (length, height), "rear": (width, height), "front": (width, height)}
    rooms = {view: (scale * across + 2, scale * up + 2) for view, (across, up) in sizes.items()}
    rooms["corner"] = (PAGE_WIDTH - GAP - rooms["top"][0], max(HIGHEST_CORNER, rooms["top"][1]))
    return rooms


def face_corners(low, high, axis, far):
    others = [i for i in range(3) if i != axis]
    corners = np.tile(low, (4, 1))
    corners[:, axis] = (high if far else low)[axis]
    for corner, square in zip(corners, SQUARE):
        for i, part in zip(others, square):
            corner[i] = (high if part else low)[i]
    return corners


def is_behind(a, b, view):
    """Whether box a can be hidden by box b, and never the other way round: on some axis it lies on the far side of it."""
    (low_a, high_a), (low_b, high_b) = a, b
    tolerance = 1e-4
    return any((high_a[axis] <= low_b[axis] + tolerance) if far else (high_b[axis] <= low_a[axis] + tolerance)
               for axis, far in FACES[view])


def back_to_front(boxes, view):
    """Indices of boxes in the order in which they are painted. Boxes that do not overlap have one, but for rare rings."""
    if view != "corner":
        [(axis, far)] = FACES[view]
        return sorted(range(len(boxes)), key=lambda i: boxes[i][1][axis] if far else -boxes[i][0][axis])
    if len(boxes) > MOST_ORDERED:
        return sorted(range(len(boxes)), key=lambda i: boxes[i][1][0] - boxes[i][0][1] + boxes[i][1][2])
    left, order = set(range(len(boxes))), []
    before = {i: {j for j in left if j != i and is_behind(boxes[j], boxes[i], view)
                  and not is_behind(boxes[i], boxes[j], view)} for i in left}
    while left:
        ready = [i for i in left if not before[i] & left] or [min(left, key=lambda i: len(before[i] & left))]
        order += ready
        left -= set(ready)
    return order


def shaded(colour, shade):
    parts = [round(shade * int(colour[i:i + 2], 16)) for i in (1, 3, 5)]
    return "#" + "".join(f"{part:02x}" for part in parts)


def polygon(points, **attributes):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polygon points="{path}" ' + " ".join(f'{name.replace("_", "-")}="{value}"' for name, value in attributes.items()) + "/>"


def openings_drawn(openings, view, place):
    """A container with open or low sides: the ground, what else is drawn before the boxes in it, and what over them."""
    length, width, height = openings.container
    bed = np.array([[0.0, 0, -openings.bed_height], [length, width, 0]])
    ground, behind, over = [], [], []
    if openings.bed_height > 0 and view != "top":
        if view == "corner":
            margin = np.array([GROUND_MARGIN, GROUND_MARGIN, 0])
            ground.append(polygon(place(face_corners(bed[0] - margin, bed[1] + margin, 2, False)), fill=GROUND, stroke="none"))
        behind += [polygon(place(face_corners(*bed, axis, far)), fill=shaded(BED, SHADES[axis]), stroke=LINE, stroke_width=0.6)
                   for axis, far in FACES[view] if axis != 2]
    room = np.array([np.zeros(3), [length, width, height]])
    behind.append(polygon(place(face_corners(*room, 2, False)), fill="#ffffff", stroke=LINE, stroke_width=0.6, stroke_dasharray="4 3"))
    if openings.has_roof and view not in ("top", "corner"):
        behind.append(polygon(place(face_corners(*room, 2, True)), fill="none", stroke=FRAME, stroke_width=1))
    for name, (axis, far) in SIDES.items():
        top = openings.walls[name]
        is_near = (axis, far) in FACES[view]
        if top == 0 or (is_near and openings.is_full(name)):
            continue
        line = {"stroke": FRAME, "stroke_width": 1} if openings.is_full(name) else {"stroke": LINE, "stroke_width": 1}
        (over if is_near else behind).append(polygon(place(face_corners(room[0], [length, width, top], axis, far)), fill="none", **line))
    return ground, behind, over


def is_beyond_hidden_side(faces, container, view):
    """Whether a box lies beside the container where a view does not look: the floor can hide it."""
    centre = np.mean([corners.mean(axis=0) for corners, _ in faces], axis=0)
    return any(centre[axis] < 0 if far else centre[axis] > container[axis] for axis, far in FACES[view] if axis != 2)


def packed_faces(boxes, view):
    """The faces that a view sees, as they are painted, of boxes that stand upright: per box its index, and corners and shade of each.

    :param boxes: pairs of the corners with the smallest and the largest coordinates, m
    """
    return [(i, [(face_corners(*boxes[i], axis, far), SHADES[axis] if view == "corner" else 1) for axis, far in FACES[view]])
            for i in back_to_front(boxes, view)]


def turned_faces(boxes, view):
    """The same of boxes that have turned, by the distances of their centres.

    :param boxes: per box its corners as loaded, from its centre of mass, the quaternion w, x, y, z, and where that centre is, m
    """
    to_viewer = sum(np.eye(3)[axis] * (1 if far else -1) for axis, far in FACES[view])
    found = []
    for i, (low, high, turn, centre) in enumerate(boxes):
        rotation = rotation_of(turn)
        faces = []
        for axis in range(3):
            for far in (False, True):
                normal = rotation[:, axis] * (1 if far else -1)
                if normal @ to_viewer > 1e-6:
                    shade = SHADES[int(np.abs(normal).argmax())]
                    faces.append((face_corners(low, high, axis, far) @ rotation.T + centre, shade))
        found.append((float(centre @ to_viewer), i, faces))
    return [(i, faces) for _, i, faces in sorted(found, key=lambda one: one[:2])]


def rotation_of(quaternion):
    """The matrix of a quaternion w, x, y, z."""
    w, x, y, z = np.asarray(quaternion, dtype=float) / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def wrapped(text, letters):
    """The text in lines of so many letters at most, unless one of its words has more."""
    lines = []
    for word in text.split():
        if lines and len(lines[-1]) + 1 + len(word) <= letters:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


def fitting_label(name, number, width, height):
    """The lines of the label that fits into a face of so many pixels: the name, else the number, else none."""
    letters = int((width - 3) / (LETTER_WIDTH * LETTER))
    most = min(MOST_LINES, 1 + (height - 2 - LETTER) / (LINE_HEIGHT * LETTER))
    fitting = (lines for lines in (wrapped(name, letters), [str(number)])
               if lines and len(lines) <= most and max(map(len, lines)) <= letters)
    return next(fitting, [])


def label(lines, state, x, y):
    fill = BRIGHT if state == "first" else FRAME
    top = y - (len(lines) - 1) / 2 * LINE_HEIGHT * LETTER + 0.35 * LETTER
    return "".join(f'<text x="{x:.1f}" y="{top + i * LINE_HEIGHT * LETTER:.1f}" font-size="{LETTER}" text-anchor="middle" fill="{fill}">'
                   f'{html.escape(line)}</text>' for i, line in enumerate(lines))


def packed_labels(faces, states, names):
    """The labels of boxes, but those that a box which is painted later would cut in two, or the sign of what is fixed.

    :param faces: per box in the order in which they are painted, its index and its one face, on the page
    """
    lows, highs = (np.array([edge(corners, axis=0) for _, corners in faces]).reshape(-1, 2) for edge in (np.min, np.max))
    labels = []
    for at, (i, _) in enumerate(faces):
        lines = fitting_label(names[i], i + 1, *(highs[at] - lows[at])) if states[i] != "fixed" else []
        middle = (lows[at] + highs[at]) / 2
        half = np.array([LETTER_WIDTH * LETTER * max(map(len, lines), default=0), LINE_HEIGHT * LETTER * len(lines)]) / 2
        covered = ((lows[at + 1:] < middle + half) & (highs[at + 1:] > middle - half)).all(axis=1).any()
        labels.append("" if covered else label(lines, states[i], *middle))
    return labels


def painted(corners, state, shade):
    """A face of a box. Signs beside the colours tell those that go first, and what is fixed, on paper without colours."""
    line = {"stroke": FRAME, "stroke_width": 1.8} if state == "first" else {"stroke": LINE, "stroke_width": 0.6}
    face = polygon(corners, fill=shaded(FILLS[state], shade), stroke_linejoin="round", **line)
    if state != "fixed":
        return face
    (a, b), (c, d), (e, f), (g, h) = corners
    return face + f'<path d="M{a:.1f},{b:.1f} L{e:.1f},{f:.1f} M{c:.1f},{d:.1f} L{g:.1f},{h:.1f}" stroke="{LINE}" stroke-width="0.6"/>'


def is_near(centre, openings):
    """Whether a box with its centre there is so near to the container that it is drawn with it."""
    (x, y, _), (length, width, _) = centre, openings.container
    return max(-x, x - length, -y, y - width) < SURROUNDINGS


def draw(boxes, states, openings, view, most, names=None):
    """SVG of boxes in a container, with those that lie beside it.

    :param boxes: of packed_faces or turned_faces
    :param states: per box a key of FILLS
    :param openings: of the container
    :param most: width and height of the picture at most, in pixels
    :param names: per box, for labels of boxes in views along an axis; None: only those that go first have their numbers
    """
    projection = PROJECTIONS[view]
    room = np.array([np.zeros(3), np.asarray(openings.container, dtype=float)])
    shown = room.copy()
    if not openings.is_closed and openings.bed_height > 0:
        shown[0, 2] = -openings.bed_height
        if view == "corner":
            shown += [[-GROUND_MARGIN, -GROUND_MARGIN, 0], [GROUND_MARGIN, GROUND_MARGIN, 0]]
    points = [[shown[i][0], shown[j][1], shown[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    points += [corner for _, faces in boxes for corners, _ in faces for corner in corners]
    edges = np.array(points) @ projection.T
    low, high = edges.min(axis=0), edges.max(axis=0)
    across, up = high - low
    scale = min((most[0] - 2) / across, (most[1] - 2) / up)
    width, height = round(scale * across) + 2, scale * up + 2

    def place(points):
        flat = (np.asarray(points) @ projection.T - low) * scale + 1
        return np.column_stack([flat[:, 0], height - flat[:, 1]])

    def outline(faces):
        return [polygon(place(face_corners(*room, axis, far)), fill="none", stroke=FRAME, stroke_width=1) for axis, far in faces]

    hidden = [(axis, not far) for axis, far in FACES[view]]
    ground, frame, over = ([], outline(hidden), []) if openings.is_closed else openings_drawn(openings, view, place)
    parts = [[], []]  # of boxes: behind the floor, and before it
    labelled = names is not None and view != "corner"
    labels = packed_labels([(i, place(faces[0][0])) for i, faces in boxes], states, names) if labelled else []
    for at, (i, faces) in enumerate(boxes):
        drawn = parts[0 if is_beyond_hidden_side(faces, openings.container, view) else 1]
        for corners, shade in faces:
            drawn.append(painted(place(corners), states[i], shade))
        if labelled:
            drawn.append(labels[at])
        elif states[i] == "first":
            drawn.append(label([str(i + 1)], "first", *place(faces[min(1, len(faces) - 1) if view == "corner" else 0][0]).mean(axis=0)))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height:.0f}" width="{width}" height="{height:.0f}" '
            f'role="img" aria-label="{view}">'
            + "".join([*ground, *parts[0], *frame, *parts[1], *over]) + "</svg>")
