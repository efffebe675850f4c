# What the compiled part of the package declares. The modules of the package wrap all of it.
from collections.abc import Sequence
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from .errors import Problem

_Table = npt.NDArray[Any]
_Messages = dict[tuple[int, int], str]
_Acceleration = tuple[str, npt.NDArray[np.float64], str]  # name, segments, purpose

_Triple = tuple[float, float, float]
_Box = tuple[
    _Triple,
    _Triple,
    str,
    Union[int, str],
    Optional[float],
    Optional[float],
    Optional[_Triple],
    bool,
    Optional[int],
    Optional[float],
]  # corner_min, corner_max, name, material, mass, mat, centre_of_mass, fixed, order, bearing_limit
_Container = tuple[
    str, Optional[_Triple], Optional[Sequence[str]], Optional[Sequence[tuple[str, float]]], Optional[float]
]  # type, size, open_sides, drop_sides, bed_height

def version() -> str: ...
def engines() -> list[tuple[str, str, str]]: ...
def analysis_numbers() -> list[tuple[str, str]]: ...
def numbers(values: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]: ...
def read_acceleration(path: str) -> _Acceleration: ...
def norm_accelerations(name: str) -> list[_Acceleration]: ...

def read_loads(
    path: str,
    *,
    unit: Optional[str],
    axes: Optional[str],
    format: Optional[str],
    columns: Optional[str],
    container: Optional[str],
    config: str,
) -> tuple[list[tuple[Load, str, Optional[_Container], list[_Box]]], tuple[Problem, ...]]: ...
def parse_loads(
    text: str,
    name: str,
    *,
    unit: Optional[str],
    axes: Optional[str],
    format: Optional[str],
    columns: Optional[str],
    container: Optional[str],
    config: str,
) -> tuple[list[tuple[Load, str, Optional[_Container], list[_Box]]], tuple[Problem, ...]]: ...
def container_types() -> list[tuple[str, str, _Triple, float, tuple[str, ...], float]]: ...

class Load:
    def __init__(self, name: str, container: Optional[_Container], boxes: Sequence[_Box]) -> None: ...

class Screen:
    def __init__(
        self,
        *,
        config: str,
        norm: Optional[str],
        engine: Optional[str],
        accuracy: Optional[str],
        scheduler: Optional[str],
        threads: Optional[int],
        centimetres: bool,
        mark: bool,
        keep_boxes: bool,
        keep_series: bool,
        most_in_flight: int,
    ) -> None: ...
    def add_acceleration(self, name: str, segments: npt.ArrayLike, purpose: str) -> None: ...
    def accelerations(self) -> list[_Acceleration]: ...
    def evaluate(
        self, layouts: Any, offsets: Optional[npt.ArrayLike], names: Sequence[str], on_main_thread: bool
    ) -> tuple[_Table, _Messages, tuple[Problem, ...], Optional[list[_Table]]]: ...
    def holds(
        self, layouts: Any, offsets: Optional[npt.ArrayLike], names: Sequence[str], on_main_thread: bool
    ) -> npt.NDArray[np.bool_]: ...
    def indicators(
        self, layouts: Any, offsets: Optional[npt.ArrayLike], names: Sequence[str]
    ) -> tuple[
        npt.NDArray[np.float64],
        list[npt.NDArray[np.float32]],
        list[npt.NDArray[np.uint8]],
        tuple[Problem, ...],
    ]: ...
    def margins(
        self, layouts: Any, offsets: Optional[npt.ArrayLike], names: Sequence[str], on_main_thread: bool
    ) -> tuple[
        npt.NDArray[np.float64],
        npt.NDArray[np.uint32],
        npt.NDArray[np.float64],
        npt.NDArray[np.uint32],
        npt.NDArray[np.float64],
        npt.NDArray[np.uint32],
        npt.NDArray[np.float64],
        tuple[Problem, ...],
    ]: ...
    def replay(
        self, layout: Any, on_main_thread: bool
    ) -> tuple[
        _Table,
        _Messages,
        Optional[list[_Table]],
        tuple[npt.NDArray[np.float64], npt.NDArray[np.float32], npt.NDArray[np.float32], npt.NDArray[np.float32]],
    ]: ...
    def record(
        self,
        layouts: Any,
        offsets: Optional[npt.ArrayLike],
        names: Sequence[str],
        path: str,
        *,
        series: bool,
        resume: bool,
        overwrite: bool,
        command_line: str,
        on_main_thread: bool,
    ) -> bool: ...
    def submit(self, layout: Any, name: str) -> Optional[tuple[int, tuple[Problem, ...]]]: ...
    def poll(
        self, ordered: bool, on_main_thread: bool
    ) -> Optional[tuple[int, _Table, _Messages, Optional[list[_Table]]]]: ...
    def cancel(self) -> None: ...
    def in_flight(self) -> int: ...
    def read_layout(self, path: str) -> npt.NDArray[np.float64]: ...
