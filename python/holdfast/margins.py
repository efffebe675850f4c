"""How many g layouts stand, as arrays."""

from __future__ import annotations

import html
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import Problem
from .notebook import MOST_SHOWN, counted, more_layouts
from .verdicts import BoxNames, names_of_boxes

if TYPE_CHECKING:
    import pandas

#: Directions in which the load is pushed, in the order of all arrays.
DIRECTIONS = ("front", "rear", "left", "right")
#: g: margins are not sought beyond it.
_LARGEST = 1.5


class Margins:
    """How many g each layout stands in each direction. Arrays have shape (layouts, 4); columns are :data:`DIRECTIONS`.

    There are two margins: up to ``margin`` every box stays in its place, and up to ``margin_within_limits``, by which layouts are
    judged as verdicts are, within the limits. A critical box is a position in the layout, from 1; 0: none goes up to 1.5 g.
    """

    __slots__ = ("margin", "critical_box", "margin_within_limits", "critical_box_within_limits", "low", "median", "high", "trials",
                 "cpu_seconds", "problems", "layout_names", "_box_names")

    def __init__(self, margin: npt.NDArray[np.float64], critical_box: npt.NDArray[np.uint32],
                 margin_within_limits: npt.NDArray[np.float64], critical_box_within_limits: npt.NDArray[np.uint32],
                 spread: npt.NDArray[np.float64], trials: npt.NDArray[np.uint32], cpu_seconds: npt.NDArray[np.float64],
                 problems: tuple[Problem, ...], layout_names: Sequence[str], box_names: Optional[BoxNames] = None) -> None:
        #: Largest constant acceleration, for as long as anything moves, under which every box stays in its place, within
        #: 5 mm, g, up to 1.5. Negative where the layout is unstable under gravity alone; NaN where it cannot be used, or
        #: :meth:`Screen.cancel` came before.
        self.margin = margin
        #: The box that leaves its place first above the margin.
        self.critical_box = critical_box
        #: The same where every box stays within the limits of the verdict.
        self.margin_within_limits = margin_within_limits
        #: The box that is beyond a limit first above that margin.
        self.critical_box_within_limits = critical_box_within_limits
        #: With ``[Screening] Replicas``: margins within limits that 5 %, half and 95 % of the layout's replicas do not reach, g;
        #: NaN without.
        self.low, self.median, self.high = spread
        #: Accelerations that were tried, one number per layout.
        self.trials = trials
        #: Processor time, s, one number per layout.
        self.cpu_seconds = cpu_seconds
        #: With ``errors="mark"``: what is wrong with the layouts, see :class:`Problem`.
        self.problems = problems
        #: Names of the layouts of the call, in their order; empty when none were given.
        self.layout_names = tuple(layout_names)
        self._box_names = box_names or {}

    @property
    def critical_box_name(self) -> npt.NDArray[Any]:
        """Names of the critical boxes: texts, "" where there is no critical box or it has no name."""
        return self._names(self.critical_box)

    @property
    def critical_box_within_limits_name(self) -> npt.NDArray[Any]:
        """The same of the critical boxes within limits."""
        return self._names(self.critical_box_within_limits)

    def _names(self, boxes: npt.NDArray[np.uint32]) -> npt.NDArray[Any]:
        return names_of_boxes(np.arange(len(self))[:, None], boxes, self._box_names)

    @property
    def least(self) -> npt.NDArray[np.float64]:
        """The margin within limits in the weakest direction, g, of shape (layouts,)."""
        least: npt.NDArray[np.float64] = self.margin_within_limits.min(axis=1)
        return least

    @property
    def weakest(self) -> list[str]:
        """The weakest direction of each layout by the margins within limits, the first of several."""
        return [DIRECTIONS[i] for i in self.margin_within_limits.argmin(axis=1)]

    def over(self, needed: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """How often a layout stands what is needed, in the worst direction: the least of margin within limits / needed, of shape
        (layouts,). A fitness: 1 or more where the layout stands all of it.

        :param needed: g, one number per direction, such as (0.8, 0.5, 0.5, 0.5) for the road; 0 where nothing is needed
        """
        needed = _core.numbers(needed, "needed")
        if needed.shape != (len(DIRECTIONS),) or not (needed >= 0).all() or not needed.any():
            raise ValueError("needed is one number per direction, front, rear, left and right, and not negative")
        asked = needed > 0
        worst: npt.NDArray[np.float64] = (self.margin_within_limits[:, asked] / needed[asked]).min(axis=1)
        return worst

    def frame(self) -> pandas.DataFrame:
        """A data frame with one row per layout and direction: both margins and critical boxes, and with replicas low, median,
        high."""
        import pandas

        count = len(self)
        frame = pandas.DataFrame({
            "layout": np.repeat(np.arange(count), len(DIRECTIONS)),
            "direction": pandas.Categorical.from_codes(np.tile(range(len(DIRECTIONS)), count), list(DIRECTIONS)),
            "margin": self.margin.ravel(),
            "critical_box": self.critical_box.ravel(),
            "margin_within_limits": self.margin_within_limits.ravel(),
            "critical_box_within_limits": self.critical_box_within_limits.ravel(),
        })
        if not np.isnan(self.median).all():
            frame = frame.assign(low=self.low.ravel(), median=self.median.ravel(), high=self.high.ravel())
        if self._box_names:
            for name, column in (("critical_box", self.critical_box_name),
                                 ("critical_box_within_limits", self.critical_box_within_limits_name)):
                frame.insert(frame.columns.get_loc(name) + 1, f"{name}_name", column.ravel())
        if self.layout_names:
            frame.insert(1, "name", [self.layout_names[i] for i in frame["layout"]])
        return frame

    def __len__(self) -> int:
        return len(self.margin)

    def __repr__(self) -> str:
        known = self.margin_within_limits[~np.isnan(self.margin_within_limits)]
        least = float(known.min()) if known.size else np.nan
        found = f", the least {_text(least)}{' g within limits' if least >= 0 else ''}" if known.size else ""
        return f"<holdfast.Margins of {counted(len(self), 'layout')}{found}>"

    def _repr_html_(self) -> str:
        heads = "".join(f"<th>{direction}</th>" for direction in DIRECTIONS)
        caption = f"{html.escape(repr(self)[1:-1])}; in place / within limits"
        lines = [f"<table><caption>{caption}</caption><tr><th>layout</th>{heads}</tr>"]
        for i, rows in enumerate(zip(self.margin[:MOST_SHOWN], self.margin_within_limits)):
            name = self.layout_names[i] if self.layout_names else str(i)
            cells = "".join(f"<td>{_text(in_place)} / {_text(within)}{' g' if within >= 0 else ''}</td>" for in_place, within in zip(*rows))
            lines.append(f"<tr><th>{html.escape(name)}</th>{cells}</tr>")
        return "\n".join(lines + more_layouts(len(self), len(DIRECTIONS) + 1)) + "</table>"


def _text(margin: float) -> str:
    """A margin without its unit, rounded down: a load stands what is told. The largest that is tried has a plus."""
    if np.isnan(margin):
        return "not known"
    if margin < 0:
        return "unstable"
    # Times 100, a number of two digits may lie a little below a whole one.
    return f"{np.floor(100 * margin + 1e-6) / 100:.2f}" if margin < _LARGEST else f"{_LARGEST:.2f}+"
