"""The one exception of the library, and what it is made of."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, Optional


class Problem(NamedTuple):
    """One thing that is wrong with an input. Text that does not apply is empty, a number that does not is None.

    The box is at fault at ``layouts[layout][box, column]``.
    """

    message: str  #: all of it in one line
    what: str  #: what is wrong
    value: str  #: the offending value
    accepted: str  #: what would be accepted
    layout: Optional[int] = None  #: index into the layouts of the call
    box: Optional[int] = None  #: row of that layout
    column: Optional[int] = None  #: column of that row
    file: str = ""  #: path of the file, or name of the layout or acceleration
    line: Optional[int] = None  #: in the file, from 1
    character: Optional[int] = None  #: in the line, from 1


class Error(ValueError):
    """Input that cannot be used, a file that cannot be written, memory that has run out.

    It has every problem that was found; ``layout``, ``box``, ``column``, ``what``, ``value`` and ``accepted`` are those of
    the first.

    >>> import holdfast
    >>> screen = holdfast.Screen([holdfast.Acceleration("rest", [[0, 1, 0, 0, 0]])])
    >>> box = [2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1]
    >>> try:
    ...     screen.evaluate([[box], [box, [0.0, 0.0, 0.0, 1.0, 1.0, float("nan"), 1]]])
    ... except holdfast.Error as error:
    ...     print(error)
    ...     print(error.layout, error.box, error.column)
    layout 1: box 2 has a corner that is not finite
    1 1 5
    """

    def __init__(self, problems: Iterable[Problem]) -> None:
        #: All problems, in the order of the input; never empty.
        self.problems: tuple[Problem, ...] = tuple(Problem(*problem) for problem in problems)
        if not self.problems:
            self.problems = (Problem("unknown problem", "unknown problem", "", ""),)
        super().__init__(self.problems)

    def at_layout(self, layout: int) -> Error:
        """The same of a layout that has another index."""
        return Error(problem._replace(layout=layout) for problem in self.problems)

    def __str__(self) -> str:
        more = len(self.problems) - 1
        return self.problems[0].message + (f" (and {more} more)" if more else "")

    @property
    def layout(self) -> Optional[int]:
        """Index into the layouts of the call, or None."""
        return self.problems[0].layout

    @property
    def box(self) -> Optional[int]:
        """Row of that layout, or None."""
        return self.problems[0].box

    @property
    def column(self) -> Optional[int]:
        """Column of that row, or None."""
        return self.problems[0].column

    @property
    def what(self) -> str:
        """What is wrong."""
        return self.problems[0].what

    @property
    def value(self) -> str:
        """The offending value, or an empty text."""
        return self.problems[0].value

    @property
    def accepted(self) -> str:
        """What would be accepted, or an empty text."""
        return self.problems[0].accepted
