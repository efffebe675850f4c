"""What became of layouts, as arrays."""

from __future__ import annotations

import html
import operator
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from .codes import StopReason, Verdict
from .column import Column
from .errors import Problem
from .notebook import MOST_SHOWN, more_layouts
from .world_columns import BOX_COLUMNS, WorldColumns

if TYPE_CHECKING:
    import pandas

#: Of a cell, by its verdict; grey where the verdict says nothing of the layout.
_COLOURS = {
    Verdict.STAYED: "#dff0d8",
    Verdict.MOVED: "#fcf8e3",
    Verdict.FELL: "#f2dede",
    Verdict.UNSTABLE: "#fcf8e3",
}
_GREY = "#e0e0e0"


#: Names of the boxes of layouts that are loads with names, by index of the layout.
BoxNames = dict[int, tuple[str, ...]]


def names_of_boxes(layouts: npt.NDArray[Any], boxes: npt.NDArray[Any], names: BoxNames) -> npt.NDArray[Any]:
    """The names of boxes, counted from 1, of layouts; "" where there is none."""
    found = np.full(boxes.shape, "", dtype=object)
    if names:
        for place, (layout, box) in enumerate(zip(np.broadcast_to(layouts, boxes.shape).ravel().tolist(), boxes.ravel().tolist())):
            if box and layout in names:
                found.flat[place] = names[layout][box - 1]
    return found


def _name_of(world: Any) -> str:
    """The verdict on a world; "at least" where it ended when that was decided, while its load was moving on."""
    verdict = Verdict(world["verdict"])
    early = world["stop_reason"] == StopReason.DECIDED and verdict != Verdict.UNSTABLE
    return ("at least " if early else "") + verdict.name.lower()


class Verdicts(WorldColumns):
    """A table of verdicts. Its arrays have shape (layouts, accelerations), and indexing it gives a part:
    ``verdicts[3]`` is that of layout 3, of shape (accelerations,).

    ``table`` is the structured array that all columns are views of; ``pandas.DataFrame(verdicts.table.ravel())`` is a
    data frame of it, and :meth:`frame` one with names.
    """

    __slots__ = ("table", "problems", "acceleration_names", "layout_names", "_messages", "_boxes", "_box_names")

    def __init__(
        self,
        table: npt.NDArray[Any],
        messages: dict[tuple[int, int], str],
        problems: tuple[Problem, ...],
        acceleration_names: Sequence[str],
        layout_names: Sequence[str] = (),
        boxes: Optional[dict[int, npt.NDArray[Any]]] = None,
        box_names: Optional[BoxNames] = None,
    ) -> None:
        self.table = table
        #: With ``errors="mark"``: what is wrong with the layouts, see :class:`Problem`.
        self.problems = problems
        #: Names of the accelerations, in their order.
        self.acceleration_names = tuple(acceleration_names)
        #: Names of the layouts of the call, in their order; empty when none were given.
        self.layout_names = tuple(layout_names)
        self._messages = messages
        self._boxes = boxes
        self._box_names = box_names or {}

    if TYPE_CHECKING:
        # The columns of analyses, which are added below.
        def __getattr__(self, name: str) -> Any: ...

    @property
    def holds(self) -> npt.NDArray[np.bool_]:
        """Whether no box was ever beyond a limit; False also where nothing can be said."""
        stays: npt.NDArray[np.bool_] = self.table["verdict"] == int(Verdict.STAYED)
        return stays

    @property
    def shape(self) -> tuple[int, ...]:
        """Of every array: (layouts, accelerations), or what indexing has left of it."""
        return self.table.shape

    @property
    def messages(self) -> dict[tuple[int, int], str]:
        """Why the status of a world is not 0, and what to do; by (layout, acceleration), for worlds that have one."""
        if not self._messages:
            return {}
        here = zip(self.table["layout"].ravel().tolist(), self.table["acceleration"].ravel().tolist())
        return {world: self._messages[world] for world in here if world in self._messages}

    @property
    def critical_box_name(self) -> npt.NDArray[Any]:
        """Names of the critical boxes: texts, "" where there is no critical box or it has no name."""
        return names_of_boxes(self.table["layout"], self.table["critical_box"], self._box_names)

    def box_names(self, layout: int) -> tuple[str, ...]:
        """Names of the boxes of a layout, in its order; empty where it is no :class:`Load` with names.

        :param layout: index of the layout in the call
        """
        return self._box_names.get(operator.index(layout), ())

    def box_outcomes(self, layout: int) -> npt.NDArray[Any]:
        """What became of the boxes of a layout: a structured array of shape (accelerations, boxes).

        With ``Damage`` there are also peak_acceleration (m/s²), velocity_change (m/s) and beyond, whether both are above the
        damage boundary. Of a layout that was not simulated there are no boxes. Its columns:

        :param layout: index of the layout in the call
        :raises ValueError: the screen was made without ``keep_boxes=True``
        """
        if self._boxes is None:
            raise ValueError("the screen keeps no boxes: make it with keep_boxes=True")
        return self._boxes[operator.index(layout)]

    def frame(self) -> pandas.DataFrame:
        """A data frame with one row per world; verdicts and accelerations by name, and layouts where they have names."""
        import pandas

        frame = pandas.DataFrame(self.table.ravel())
        names = [verdict.name.lower() for verdict in Verdict]
        frame["verdict"] = pandas.Categorical.from_codes(np.searchsorted([*Verdict], frame["verdict"]), names)
        frame["acceleration"] = pandas.Categorical([self.acceleration_names[i] for i in frame["acceleration"]])
        if self.layout_names:
            frame.insert(1, "name", [self.layout_names[i] for i in frame["layout"]])
        if self._box_names:
            frame.insert(frame.columns.get_loc("critical_box") + 1, "critical_box_name", self.critical_box_name.ravel())
        return frame

    def __len__(self) -> int:
        return len(self.table)

    def __getitem__(self, index: Any) -> Verdicts:
        part = self.table[index]
        if not isinstance(part, np.ndarray):
            part = np.array(part, dtype=self.table.dtype)
        if part.dtype != self.table.dtype:
            raise TypeError("verdicts are indexed by layout and acceleration; a column is an attribute, such as .holds")
        layouts = set(part["layout"].ravel().tolist())
        problems = tuple(problem for problem in self.problems if problem.layout in layouts)
        return Verdicts(part, self._messages, problems, self.acceleration_names, self.layout_names, self._boxes, self._box_names)

    def _counts(self) -> dict[str, int]:
        return {code.name.lower(): int((self.table["verdict"] == int(code)).sum()) for code in Verdict}

    def __repr__(self) -> str:
        found = ", ".join(f"{count} {name}" for name, count in self._counts().items() if count)
        return f"<holdfast.Verdicts of shape {self.shape}: {found or 'none'}>"

    def _repr_html_(self) -> str:
        table = self.table.reshape(-1, self.table.shape[-1]) if self.table.ndim else self.table.reshape(1, 1)
        columns = table["acceleration"][0].tolist() if len(table) else range(len(self.acceleration_names))
        heads = "".join(f"<th>{html.escape(self.acceleration_names[i])}</th>" for i in columns)
        lines = [f"<table><caption>{html.escape(repr(self)[1:-1])}</caption><tr><th>layout</th>{heads}</tr>"]
        for row in table[:MOST_SHOWN]:
            index = int(row["layout"][0]) if len(row) else 0
            name = self.layout_names[index] if self.layout_names else str(index)
            cells = "".join(
                f"<td style='background: {_COLOURS.get(world['verdict'], _GREY)}; color: black'>"
                f"{_name_of(world)}, {world['peak_displacement']:.3g} m</td>" for world in row)
            lines.append(f"<tr><th>{html.escape(name)}</th>{cells}</tr>")
        return "\n".join(lines + more_layouts(len(table), len(columns) + 1)) + "</table>"


Verdicts.box_outcomes.__doc__ = str(Verdicts.box_outcomes.__doc__).replace(
    "Its columns:\n", "Its columns:\n" + "".join(f"\n        - {name}: {sentence}" for name, sentence in BOX_COLUMNS.items()) + "\n")
for _name, _sentence in _core.analysis_numbers():
    setattr(Verdicts, _name, Column(_sentence, _name))
