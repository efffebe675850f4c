"""One row per layout, one column per direction, a bar in each: what plot_margins.py and plot_walls.py draw."""
from matplotlib.figure import Figure

GOOD, BAD, LINE = "#4c8c4a", "#c0392b", "#222222"
DIRECTIONS = ("front", "rear", "left", "right")


def draw_bars(names, values, good, lines, cap, unit, title, inner=None):
    """Draws the picture.

    :param values: one per layout and direction
    :param good: the same, whether a bar is as it should be
    :param lines: value at which each direction has a line, or None
    :param cap: values from here on are drawn as long as this, with an arrow
    :param inner: smaller values, which are drawn as a thin bar inside
    """
    figure = Figure(figsize=(10, 1.6 + 0.24 * len(names)), layout="constrained")
    figure.suptitle(title)
    rows = range(len(names))
    for axis, direction in zip(figure.subplots(1, len(DIRECTIONS), sharey=True), range(len(DIRECTIONS))):
        lengths = values[:, direction].clip(min=0, max=cap)
        axis.barh(rows, lengths, color=[GOOD if fine else BAD for fine in good[:, direction]])
        if inner is not None:
            axis.barh(rows, inner[:, direction].clip(min=0, max=cap), height=0.25, color=LINE)
        for row in rows:
            if values[row, direction] >= cap:
                axis.annotate("", (1.04 * cap, row), (0.97 * cap, row), arrowprops={"arrowstyle": "->"})
            elif values[row, direction] < 0:
                axis.text(0.02 * cap, row, "unstable", color=BAD, fontsize="small", va="center")
        if lines[direction] is not None:
            axis.axvline(lines[direction], color=LINE, linewidth=1.2)
        axis.set(title=DIRECTIONS[direction], xlabel=unit, xlim=(0, 1.06 * cap), ylim=(len(names) - 0.4, -0.6))
        axis.set_yticks(rows, names)
        axis.spines[["top", "right"]].set_visible(False)
    return figure
