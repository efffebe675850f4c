"""Layouts that a screen has in flight for a stream."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Optional

import numpy.typing as npt

from .errors import Error, Problem
from .loads import Load
from .usage import Usage

_END = object()


@dataclass(frozen=True)
class Landed:
    """A layout that is finished."""

    index: int  #: among the layouts of the stream
    table: npt.NDArray[Any]  #: of shape (accelerations,)
    messages: dict[tuple[int, int], str]  #: by (index, acceleration)
    problems: tuple[Problem, ...]
    boxes: Optional[dict[int, npt.NDArray[Any]]]  #: by index
    box_names: dict[int, tuple[str, ...]]  #: of a load, by index


class Flight:
    """Takes layouts from an iterator as a screen has room for them, and gives them back as they are finished."""

    def __init__(self, usage: Usage, layouts: Iterator[Any], names: Optional[Iterator[str]]) -> None:
        self._usage = usage
        self._layouts: Iterator[Any] = layouts
        self._given_names = names
        self._waiting: Any = None  # the layout to be submitted next, once `_taken` says that it was taken
        self._taken = 0
        self._submitted = 0
        self._places: dict[int, tuple[int, tuple[Problem, ...]]] = {}  # by ticket
        self._box_names: dict[int, tuple[str, ...]] = {}  # of loads in flight, by index
        self.names: list[str] = []  #: of the layouts that were taken, where there are any

    def fill(self) -> None:
        """Submits layouts until there is no room, or no layout."""
        while self._take() and self._submit():
            pass

    def _take(self) -> bool:
        """Whether a layout is there to be submitted."""
        if self._taken == self._submitted and self._waiting is not _END:
            self._waiting = next(self._layouts, _END)
            if self._waiting is not _END:
                self._taken += 1
                if self._given_names is not None:
                    self.names.append(next(self._given_names, ""))
                elif self.names or (isinstance(self._waiting, Load) and self._waiting.name):
                    self._add_own_name()
        return self._waiting is not _END

    def _add_own_name(self) -> None:
        """Adds the name of a load, and of those before it that have none."""
        self.names.extend(f"layout {i}" for i in range(len(self.names), self._taken - 1))
        name = self._waiting.name if isinstance(self._waiting, Load) else ""
        self.names.append(name or f"layout {self._taken - 1}")

    def _submit(self) -> bool:
        """Whether there was room."""
        index = self._submitted
        name = self.names[index] if self.names else ""
        with self._usage as core:
            try:
                submitted = core.submit(self._waiting, name or f"layout {index}")
            except Error as error:
                raise error.at_layout(index) from None
        if submitted is None:
            return False
        ticket, problems = submitted
        self._places[ticket] = index, tuple(problem._replace(layout=index) for problem in problems)
        if isinstance(self._waiting, Load) and any(self._waiting.box_names):
            self._box_names[index] = self._waiting.box_names
        self._submitted += 1
        return True

    def land(self, ordered: bool, on_main_thread: bool) -> Optional[Landed]:
        """A layout that is finished, for which it waits; None when all are back."""
        with self._usage as core:
            polled = core.poll(ordered, on_main_thread)
        if polled is None:
            if self._places:
                raise RuntimeError("the stream is one of the process that this one was forked from")
            return None
        ticket, table, messages, boxes = polled
        index, problems = self._places.pop(ticket)
        table["layout"] = index
        return Landed(index, table, {(index, world): text for (_, world), text in messages.items()}, problems,
                      None if boxes is None else {index: boxes[0]},
                      {index: self._box_names.pop(index)} if index in self._box_names else {})
