"""What geometry alone says of layouts, as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from .errors import Problem
from .notebook import counted

if TYPE_CHECKING:
    import pandas


class Indicators:
    """What geometry alone says of each layout; nothing is simulated. NaN, and no boxes, where a layout cannot be used."""

    __slots__ = ("centre_of_gravity", "centre_offset", "fill", "badly_based", "badly_braced", "base_support",
                 "supported_sides", "problems", "layout_names")

    def __init__(self, of_layouts: npt.NDArray[np.float64], base_support: list[npt.NDArray[np.float32]],
                 supported_sides: list[npt.NDArray[np.uint8]], problems: tuple[Problem, ...],
                 layout_names: Sequence[str]) -> None:
        #: Of the load, m, of shape (layouts, 3).
        self.centre_of_gravity = of_layouts[:, 0:3]
        #: From the middle of the container to the centre of gravity, over its inner size, of shape (layouts, 3).
        self.centre_offset = of_layouts[:, 3:6]
        #: Volume of the boxes over that of the container, one number per layout.
        self.fill = of_layouts[:, 6]
        #: Share of the boxes with a base support below 0.75, one number per layout.
        self.badly_based = of_layouts[:, 7]
        #: Share of the boxes with fewer than 3 supported sides, one number per layout.
        self.badly_braced = of_layouts[:, 8]
        #: Per layout, an array with one number per box: share of its bottom face on the floor or on other boxes.
        self.base_support = base_support
        #: Per layout, an array with one number per box: how many of its four sides touch a wall or a box.
        self.supported_sides = supported_sides
        #: With ``errors="mark"``: what is wrong with the layouts, see :class:`Problem`.
        self.problems = problems
        #: Names of the layouts of the call, in their order; empty when none were given.
        self.layout_names = tuple(layout_names)

    def frame(self) -> pandas.DataFrame:
        """A data frame with one row per layout, to merge with :meth:`Verdicts.frame` on ``layout``."""
        import pandas

        frame = pandas.DataFrame({
            "layout": np.arange(len(self)),
            **{f"centre_{axis}": self.centre_of_gravity[:, i] for i, axis in enumerate("xyz")},
            **{f"centre_offset_{axis}": self.centre_offset[:, i] for i, axis in enumerate("xyz")},
            "fill": self.fill,
            "badly_based": self.badly_based,
            "badly_braced": self.badly_braced,
        })
        if self.layout_names:
            frame.insert(1, "name", list(self.layout_names))
        return frame

    def __len__(self) -> int:
        return len(self.fill)

    def __repr__(self) -> str:
        return f"<holdfast.Indicators of {counted(len(self), 'layout')}>"
