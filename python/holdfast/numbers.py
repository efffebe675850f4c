"""Arrays of numbers that callers give."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .errors import Error, Problem


def numbers(values: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]:
    """A copy as float64. Text, dates, complex numbers and masked arrays are refused: NumPy would make of them numbers that
    nobody meant.

    :param name: what messages call it
    :raises Error: they are none
    """
    array = np.asanyarray(values)
    if isinstance(array, np.ma.MaskedArray) or (array.size > 0 and array.dtype.kind not in "iuf"):
        what, value = f"{name} is no array of numbers", f"{type(array).__name__} of {array.dtype}"
        accepted = "whole or decimal numbers without a mask are needed"
        raise Error([Problem(f"{what}: {value}; {accepted}", what, value, accepted)])
    return np.array(array, dtype=np.float64)
