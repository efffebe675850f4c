"""What the container does."""

from __future__ import annotations

import os
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _core


class Acceleration:
    """An acceleration of the container over time.

    ``segments`` has shape (segments, 5): start (s), duration (s), and the acceleration of the container along x, y, z
    (m/s²; a vehicle that brakes has +x). Segments go by rising time, without overlap; between and after them the container
    has no acceleration. The array is a copy that cannot be written to. The name labels results and messages. ``purpose`` is what a
    norm states the acceleration for alone, "sliding" or "tipping", and else empty; worlds under such a one never end early.

    >>> Acceleration("brake", [[0.5, 1.0, 7.848, 0.0, 0.0]])
    Acceleration('brake', 1 segment of 1.5 s)
    """

    __slots__ = ("name", "segments", "purpose")

    def __init__(self, name: str, segments: npt.ArrayLike, purpose: str = "") -> None:
        self.name = str(name)
        self.segments: npt.NDArray[np.float64] = np.array(_core.numbers(segments, f"acceleration {name}"))
        self.segments.flags.writeable = False
        self.purpose = str(purpose)

    def __repr__(self) -> str:
        count = len(self.segments) if self.segments.ndim else 0
        end = float(self.segments[-1, :2].sum()) if self.segments.ndim == 2 and self.segments.shape[1:] >= (2,) and count else 0
        return f"Acceleration({self.name!r}, {count} segment{'' if count == 1 else 's'} of {end:g} s)"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Acceleration):
            return NotImplemented
        return (self.name, self.purpose) == (other.name, other.purpose) and np.array_equal(self.segments, other.segments)

    def __hash__(self) -> int:
        return hash((self.name, self.segments.tobytes(), self.purpose))

    def __reduce__(self) -> tuple[Any, ...]:
        return Acceleration, (self.name, np.array(self.segments), self.purpose)


#: What a screen takes for an acceleration: one, the path of a file, or segments.
AccelerationLike = Union[Acceleration, str, "os.PathLike[str]", npt.ArrayLike]


def read_acceleration(path: str | os.PathLike[str]) -> Acceleration:
    """Reads an acceleration file: a header line, then one segment per line, ``start duration x y z``.

    :raises Error: the file cannot be read or used; every problem names line and character.
    """
    return Acceleration(*_core.read_acceleration(os.fspath(path)))


def norm_accelerations(name: str) -> list[Acceleration]:
    """The accelerations of a norm, such as "road" (docs/reference/norms.md).

    >>> [one.name for one in norm_accelerations("road")]
    ['road-front-0g8', 'road-rear-0g5', 'road-left-0g5', 'road-right-0g5']

    :raises Error: there is no such norm; it says which there are
    """
    return [Acceleration(*made) for made in _core.norm_accelerations(name)]


def acceleration_of(given: AccelerationLike, index: int) -> Acceleration:
    """The acceleration that the caller means, which has that index."""
    if isinstance(given, Acceleration):
        return given
    if isinstance(given, (str, os.PathLike)):
        return read_acceleration(given)
    return Acceleration(f"acceleration {index}", given)
