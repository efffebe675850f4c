"""One row per layout, one column per direction, a bar in each: what plot_margins.py and plot_walls.py draw."""
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

GOOD, BAD, LINE = "#4c8c4a", "#c0392b", "#222222"
DIRECTIONS = ("front", "rear", "left", "right")


def round_ticks(largest):
    """Round numbers from 0 to the first that is as large as a number, or from 0 to 1."""
    ticks = MaxNLocator(nbins=3, steps=[1, 2, 5, 10]).tick_values(0, largest if largest > 0 else 1)
    return [float(tick) for tick in ticks if tick >= 0]


def draw_bars(names, values, good, lines, ticks, unit, title, inner=None):
    """Draws the picture.

    :param values: one per layout and direction
    :param good: the same, whether a bar is as it should be
    :param lines: value at which each direction has a line, or None
    :param ticks: round numbers at each axis, from 0; values from the last one on are drawn as long as that, with an arrow
    :param inner: smaller values, which are drawn as a thin bar inside
    """
    figure = Figure(figsize=(10, 1.6 + 0.24 * len(names)), layout="constrained")
    figure.suptitle(title)
    cap = ticks[-1]
    # The last number is that of all larger ones, where there are any.
    digits = 0 if all(tick == round(tick) for tick in ticks) else 2
    labels = [f"{tick:.{digits}f}" for tick in ticks[:-1]] + [f"{cap:.{digits}f}" + ("+" if (values >= cap).any() else "")]
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
        axis.set_xticks(ticks, labels)
        axis.spines[["top", "right"]].set_visible(False)
    return figure
