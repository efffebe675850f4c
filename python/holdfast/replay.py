"""One world over time."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .verdicts import Verdicts


class Replay(NamedTuple):
    """One layout under one acceleration over time: a sample every ``ResultsIntervalInSeconds``, and at the end. A world that
    is unstable is not accelerated: its samples are those of settling, at negative times."""

    time: npt.NDArray[np.float64]  #: s, shape (samples,)
    displacement: npt.NDArray[np.float32]  #: of the centres of mass, m, shape (samples, boxes, 3)
    orientation: npt.NDArray[np.float32]  #: quaternions w x y z, container from body, shape (samples, boxes, 4)
    angular_velocity: npt.NDArray[np.float32]  #: rad/s, shape (samples, boxes, 3)
    verdict: Verdicts  #: of the world, shape ()
    box_outcomes: npt.NDArray[Any]  #: what became of the boxes, shape (boxes,), see :meth:`Verdicts.box_outcomes`

    def __repr__(self) -> str:
        samples, boxes = self.displacement.shape[:2]
        return f"<holdfast.Replay of {boxes} boxes, {samples} samples>"
