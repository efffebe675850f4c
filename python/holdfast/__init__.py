"""What becomes of a container loading when the container brakes, corners or changes lane.

A :class:`Screen` is made once from accelerations and settings, and then evaluates layouts, thousands of times: arrays in,
a table of verdicts out. It gives the bits that the program ``holdfast screen`` gives.

>>> import numpy as np
>>> import holdfast
>>> brake = holdfast.Acceleration("brake", [[0.0, 1.0, 7.848, 0.0, 0.0]])
>>> rest = holdfast.Acceleration("rest", [[0.0, 1.0, 0.0, 0.0, 0.0]])
>>> box = np.array([[2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1]])
>>> with holdfast.Screen([brake, rest], accuracy="screening") as screen:
...     verdicts = screen.evaluate([box, box + [0.5, 0, 0, 0.5, 0, 0, 0]])
>>> verdicts.holds
array([[False,  True],
       [False,  True]])
>>> verdicts.peak_displacement[:, 0].round(2)
array([2.  , 2.35], dtype=float32)

A layout is an array of shape (boxes, 7): x, y, z of the corner with the smallest coordinates, x, y, z of that with the
largest, and the material, a whole number; or a :class:`Load`, whose boxes may have names, masses and more. The frame is that of the container, right-handed: x along its length from the
front wall to the door, y across, z up; the origin is the lower corner at the front wall with the smallest coordinates.
Units are SI, unless stated.
"""

from ._core import version as _version
from .accelerations import Acceleration, norm_accelerations, read_acceleration
from .codes import Caveat, ReplicaVerdict, Status, StopReason, Verdict
from .engines import Engine, engines
from .errors import Error, Problem
from .indicators import Indicators
from .loads import Box, Container, ContainerType, Load, LoadWarning, containers
from .margins import Margins
from .replay import Replay
from .screen import Screen
from .verdicts import Verdicts

__version__ = _version()

__all__ = [
    "Acceleration",
    "Box",
    "Caveat",
    "Container",
    "ContainerType",
    "Engine",
    "Error",
    "Indicators",
    "Load",
    "LoadWarning",
    "Margins",
    "Problem",
    "Replay",
    "ReplicaVerdict",
    "Screen",
    "Status",
    "StopReason",
    "Verdict",
    "Verdicts",
    "containers",
    "engines",
    "norm_accelerations",
    "read_acceleration",
]
