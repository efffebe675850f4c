"""Loads: a container and the boxes in it, with names, masses and whatever else is known of them."""

from __future__ import annotations

import json
import math
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import Error, Problem
from .spreadsheets import read_sheet, text_of_rows

if TYPE_CHECKING:
    import pandas

_Triple = tuple[float, float, float]

#: Metres of a unit: lengths are divided where it is a decimal part, as the readers of files do it.
_DIVISORS = {"m": 1.0, "dm": 10.0, "cm": 100.0, "mm": 1000.0}
_FACTORS = {"in": 0.0254, "ft": 0.3048}


class LoadWarning(UserWarning):
    """What is to be known of a file of loads though it can be used: items without a place, overlaps that were trimmed."""


@dataclass(frozen=True)
class Box:
    """A box of a :class:`Load` as it is loaded. What is absent is as its material and the settings say (docs/start/loads.md).

    >>> Box((0, 0, 0), (1.2, 0.8, 1.4), name="Pump", mass=412.5).corner_max
    (1.2, 0.8, 1.4)

    :raises Error: a value cannot be used
    """

    corner_min: _Triple  #: corner with the smallest coordinates, m
    corner_max: _Triple  #: corner with the largest coordinates, m
    name: str = ""  #: shown in messages and results
    material: Union[int, str] = 1  #: a number or a name: ``[Material pallet]`` of the settings describes it
    mass: Optional[float] = None  #: kg
    mat: Optional[float] = None  #: coefficient of friction on whatever it stands on: an anti-slip mat
    centre_of_mass: Optional[_Triple] = None  #: offset from the middle of the box, m
    fixed: bool = False  #: part of the container
    order: Optional[int] = None  #: when it is loaded; None: in the order of the boxes
    bearing_limit: Optional[float] = None  #: most that may rest on it, kg

    def __post_init__(self) -> None:
        _set(self, "corner_min", _triple(self.corner_min, "corner_min"))
        _set(self, "corner_max", _triple(self.corner_max, "corner_max"))
        _set(self, "name", _text(self.name, "name"))
        if not isinstance(self.material, str):
            _set(self, "material", _whole(self.material, "material"))
        if self.centre_of_mass is not None:
            _set(self, "centre_of_mass", _triple(self.centre_of_mass, "centre_of_mass"))
        for name in ("mass", "mat", "bearing_limit"):
            if getattr(self, name) is not None:
                _set(self, name, _number(getattr(self, name), name))
        if self.order is not None:
            _set(self, "order", _whole(self.order, "order"))
        if not isinstance(self.fixed, (bool, np.bool_)):
            raise _wrong("fixed is neither true nor false", self.fixed, "True or False")
        _set(self, "fixed", bool(self.fixed))


@dataclass(frozen=True)
class Container:
    """The container of a :class:`Load`. What is absent is as the type says, or, without a type, as the settings do.

    >>> Container("trailer-curtain", drop_sides={"rear": 0.6}).type
    'trailer-curtain'
    """

    type: str = ""  #: name of one of :func:`containers`; empty: none of them
    size: Optional[_Triple] = None  #: inner length, width and height, m
    open_sides: Optional[tuple[str, ...]] = None  #: without a wall: "front", "rear", "left", "right", "roof"
    drop_sides: Optional[Mapping[str, float]] = None  #: walls that are lower than the container, and their heights, m
    bed_height: Optional[float] = None  #: of the floor above the ground, m

    def __post_init__(self) -> None:
        _set(self, "type", _text(self.type, "type"))
        if self.size is not None:
            _set(self, "size", _triple(self.size, "size"))
        if self.open_sides is not None:
            if isinstance(self.open_sides, str):
                raise _wrong("open_sides is not a list", self.open_sides, 'such as ["left", "right"]')
            _set(self, "open_sides", tuple(_text(side, "a side") for side in self.open_sides))
        if self.drop_sides is not None:
            if not isinstance(self.drop_sides, Mapping):
                raise _wrong("drop_sides are not by side", self.drop_sides, 'such as {"left": 0.6}')
            _set(self, "drop_sides",
                 {_text(side, "a side"): _number(height, "the height of a drop side") for side, height in self.drop_sides.items()})
        if self.bed_height is not None:
            _set(self, "bed_height", _number(self.bed_height, "bed_height"))

    def __hash__(self) -> int:
        drops = None if self.drop_sides is None else tuple(self.drop_sides.items())
        return hash((self.type, self.size, self.open_sides, drops, self.bed_height))


class ContainerType(NamedTuple):
    """A type of container, vehicle body or pallet."""

    name: str  #: as :class:`Container` takes it
    sentence: str  #: what it is
    size: _Triple  #: inner length, width and height, m
    payload: float  #: kg
    open_sides: tuple[str, ...]  #: as of :class:`Container`
    bed_height: float  #: of the floor above the ground, m


def containers() -> list[ContainerType]:
    """The types of containers that are known by name (docs/reference/containers.md).

    >>> [one.size for one in containers() if one.name == "40hc"]
    [(12.032, 2.352, 2.698)]
    """
    return [ContainerType(*one) for one in _core.container_types()]


@dataclass(frozen=True)
class Load:
    """A container and the boxes in it. A :class:`Screen` takes it wherever it takes an array. Lengths are metres, whatever
    the unit of the screen.

    :param boxes: :class:`Box`, or dictionaries with its members, or rows of seven numbers: two corners and a material
    :param container: a :class:`Container`, or the name of a type; None: that of the screen's settings
    :param name: labels results and messages
    :raises Error: a value cannot be used; places and sizes are checked by the screen

    >>> import holdfast
    >>> load = Load([Box((2, 1, 0), (2.5, 1.5, 0.5), name="Pump", mass=80)], container="20", name="Tour 7")
    >>> with holdfast.Screen([[[0.0, 1.0, 7.0, 0.0, 0.0]]], accuracy="screening") as screen:
    ...     verdicts = screen.evaluate([load])
    >>> verdicts, verdicts.critical_box_name
    (<holdfast.Verdicts of shape (1, 1): 1 moved>, array([['Pump']], dtype=object))
    """

    boxes: tuple[Box, ...]
    container: Optional[Container] = None
    name: str = ""
    _core_load: Optional[_core.Load] = field(default=None, init=False, repr=False, compare=False)

    # As it may be given.
    if TYPE_CHECKING:
        def __init__(self, boxes: Union[Sequence[Union[Box, Mapping[str, Any], Sequence[float]]], npt.NDArray[Any]],
                     container: Union[Container, str, Mapping[str, Any], None] = None, name: str = "") -> None: ...

    def __post_init__(self) -> None:
        given: Any = self.boxes
        if isinstance(given, (str, bytes, Mapping)) or not isinstance(given, (Iterable, np.ndarray)):
            raise _wrong("the boxes are no list", type(given).__name__, "a list of boxes")
        if isinstance(given, np.ndarray) and given.dtype.kind in "iuf":
            given = given.tolist()
        _set(self, "boxes", tuple(_box(box, i) for i, box in enumerate(given)))
        _set(self, "container", _container(self.container))
        _set(self, "name", _text(self.name, "name"))

    @classmethod
    def read(cls, path: Union[str, os.PathLike[str]], *, format: Optional[str] = None, unit: Optional[str] = None,
             axes: Optional[str] = None, columns: Optional[str] = None, container: Optional[str] = None, config: str = "",
             sheet: Union[int, str, None] = None) -> list[Load]:
        """All loads of a file: StableCargo's text, a table of text, JSON, or a sheet of a spreadsheet (docs/start/loads.md).

        What is to be known of it, such as items without a place, is a :class:`LoadWarning`.

        :param format: a known format of tables, such as "planner"
        :param unit: of lengths: "m", "dm", "cm", "mm", "in" or "ft"; None: that of the file, else cm
        :param axes: of the file that are length, width and height, such as "-z x y"
        :param columns: words of a header and what they mean, such as "Artikel = name"
        :param container: type that all loads get, whatever the file says
        :param config: text of a config.ini: loads without a container of their own are checked in its [Container]
        :param sheet: of a spreadsheet, by index or name; None: the first one, with a warning where there are others; .xlsx needs
                      the package openpyxl, .ods pandas and odfpy
        :raises Error: a load cannot be used, with every problem of every load; or the file cannot be read
        """
        name = os.fspath(path)
        options = _options(unit, axes, format, columns, container, config)
        read = read_sheet(name, 0 if sheet is None else sheet)
        if read is None:
            return _loads_of(cls, *_core.read_loads(name, **options))
        if sheet is None and len(read.names) > 1:
            warnings.warn(f"{name}: has {len(read.names)} sheets, and only the first one, {read.names[0]!r}, is read; others take "
                          f"sheet={read.names[1]!r}", LoadWarning, stacklevel=2)
        return _loads_of(cls, *_core.parse_loads(text_of_rows(read.rows), name, **options))

    @classmethod
    def from_dataframe(cls, frame: pandas.DataFrame, name: str = "table", *, format: Optional[str] = None,
                       unit: Optional[str] = None, axes: Optional[str] = None, columns: Optional[str] = None,
                       container: Optional[str] = None, config: str = "") -> list[Load]:
        """All loads of a data frame, whose columns are named as those of a table of text: ``x``, ``Length (mm)``, ``weight``.

        :param name: begins the names of the loads, and labels messages, in which line 2 is the first row
        :param format: as of :meth:`read`, as are all others
        :raises Error: a load cannot be used

        >>> import pandas
        >>> frame = pandas.DataFrame({"x": [0, 80], "y": 0, "z": 0, "length": 80, "width": 60, "height": 100, "weight": [120, 80.5]})
        >>> [box.mass for load in Load.from_dataframe(frame) for box in load.boxes]
        [120.0, 80.5]
        """
        rows = [list(map(str, frame.columns)), *frame.itertuples(index=False, name=None)]
        return _loads_of(cls, *_core.parse_loads(text_of_rows(rows), name, **_options(unit, axes, format, columns, container, config)))

    @classmethod
    def from_dict(cls, load: Mapping[str, Any]) -> Load:
        """The load of an object as JSON has it: name, container, boxes, and a unit of lengths (docs/start/loads.md).

        >>> Load.from_dict({"boxes": [[0, 0, 0, 80, 60, 100, 1]], "unit": "cm"}).boxes[0].corner_max
        (0.8, 0.6, 1.0)
        """
        _check_keys(load, ("name", "container", "unit", "boxes"), "a load")
        boxes = load.get("boxes")
        if not isinstance(boxes, (list, tuple)) or not boxes:
            raise _wrong("the load has no boxes", boxes, "a list with at least one box")
        made = cls(boxes, load.get("container"), load.get("name", ""))
        return _scaled(made, load.get("unit", "m"))

    def to_dict(self) -> dict[str, Any]:
        """The load as an object of JSON: what :meth:`from_dict` takes. What is absent is left out."""
        made: dict[str, Any] = {}
        if self.name:
            made["name"] = self.name
        if self.container is not None:
            container = _given(self.container)
            made["container"] = self.container.type if list(container) == ["type"] else container
        made["boxes"] = [{**_given(box), "material": box.material} for box in self.boxes]
        return made

    def to_json(self) -> str:
        """The text of a file with this load, which :meth:`read` and the program read (docs/start/loads.md)."""
        return json.dumps({"holdfast": 1, "loads": [self.to_dict()]}, ensure_ascii=False) + "\n"

    @property
    def box_names(self) -> tuple[str, ...]:
        """Names of the boxes, "" where one has none."""
        return tuple(box.name for box in self.boxes)

    def _as_core(self) -> _core.Load:
        """The same in the library, made once."""
        if self._core_load is None:
            container = None
            if (given := self.container) is not None:
                drops = None if given.drop_sides is None else list(given.drop_sides.items())
                container = (given.type, given.size, given.open_sides, drops, given.bed_height)
            _set(self, "_core_load", _core.Load(self.name, container, [
                (box.corner_min, box.corner_max, box.name, box.material, box.mass, box.mat, box.centre_of_mass, box.fixed, box.order,
                 box.bearing_limit) for box in self.boxes]))
        assert self._core_load is not None
        return self._core_load

    def __len__(self) -> int:
        return len(self.boxes)

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        container = f", container {self.container.type or 'of its own'}" if self.container is not None else ""
        return f"<holdfast.Load {name}{len(self.boxes)} box{'' if len(self.boxes) == 1 else 'es'}{container}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.boxes, self.container, self.name)


def _set(made: Any, name: str, value: Any) -> None:
    """Sets a member of what is frozen."""
    object.__setattr__(made, name, value)


def _wrong(what: str, value: Any, accepted: str, box: Optional[int] = None) -> Error:
    shown = str(value)[:60]
    return Error([Problem(f"{what}: {shown}; {accepted}", what, shown, accepted, box=box)])


def _number(value: Any, name: str) -> float:
    if type(value) is float and math.isfinite(value):
        return value
    is_number = isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)
    if not is_number or not math.isfinite(value):
        raise _wrong(f"{name} is no number", repr(value), "a finite number")
    return float(value)


def _whole(value: Any, name: str) -> int:
    if _number(value, name) != int(value):
        raise _wrong(f"{name} is no whole number", repr(value), "a whole number")
    return int(value)


def _text(value: Any, name: str) -> str:
    if not isinstance(value, str):
        raise _wrong(f"{name} is no text", repr(value), "a text")
    return str(value)


def _triple(value: Any, name: str) -> _Triple:
    if type(value) in (list, tuple) and len(value) == 3:
        x, y, z = value
        if type(x) is type(y) is type(z) is float and math.isfinite(x + y + z):
            return x, y, z
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, (Sequence, np.ndarray)) or len(value) != 3:
        raise _wrong(f"{name} is not three numbers", value, "a list of three numbers")
    x, y, z = (_number(number, f"a number of {name}") for number in value)
    return x, y, z


def _check_keys(given: Any, keys: Sequence[str], of: str) -> None:
    if not isinstance(given, Mapping):
        raise _wrong(f"{of} is no object", type(given).__name__, "a dictionary with " + ", ".join(keys))
    for key in given:
        if key not in keys:
            raise _wrong(f"unknown key of {of}", key, "accepted are " + ", ".join(keys))


def _members(kind: Any) -> tuple[str, ...]:
    return tuple(one.name for one in fields(kind))


def _box(given: Any, index: int) -> Box:
    """A box that is given as one, as an object or as a row."""
    if isinstance(given, Box):
        return given
    try:
        if isinstance(given, Mapping):
            _check_keys(given, _members(Box), "a box")
            for corner in ("corner_min", "corner_max"):
                if corner not in given:
                    raise _wrong(f"the box has no {corner}", dict(given), "two corners, each a list of three numbers")
            return Box(**given)
        if isinstance(given, (str, bytes)) or not isinstance(given, (Sequence, np.ndarray)) or len(given) != 7:
            raise _wrong("no box", given, "an object with two corners, or seven numbers: two corners and a material")
        return Box(given[0:3], given[3:6], material=_whole(given[6], "material"))  # type: ignore[arg-type]
    except Error as error:
        first = error.problems[0]
        raise Error([first._replace(message=f"box {index + 1}: {first.message}", box=index)]) from None


def _container(given: Any) -> Optional[Container]:
    if given is None or isinstance(given, Container):
        return given
    if isinstance(given, str):
        return Container(given)
    _check_keys(given, _members(Container), "a container")
    return Container(**given)


def _given(made: Any) -> dict[str, Any]:
    """The members that are not at their defaults."""
    given = {}
    for one in fields(made):
        value = getattr(made, one.name)
        if value != one.default:
            given[one.name] = list(value) if isinstance(value, tuple) else value
    return given


def _scaled(load: Load, unit: Any) -> Load:
    """The load, whose lengths are in that unit, in metres."""
    if unit == "m":
        return load
    if unit not in _DIVISORS and unit not in _FACTORS:
        raise _wrong("no unit of length", unit, "m, dm, cm, mm, in or ft")

    def metres(length: float) -> float:
        return length / _DIVISORS[unit] if unit in _DIVISORS else length * _FACTORS[unit]

    def all_metres(lengths: Optional[_Triple]) -> Optional[_Triple]:
        return None if lengths is None else (metres(lengths[0]), metres(lengths[1]), metres(lengths[2]))

    boxes = [{**{name: getattr(box, name) for name in _members(Box)}, "corner_min": all_metres(box.corner_min),
              "corner_max": all_metres(box.corner_max), "centre_of_mass": all_metres(box.centre_of_mass)} for box in load.boxes]
    container = load.container
    if container is not None:
        drops = None if container.drop_sides is None else {side: metres(height) for side, height in container.drop_sides.items()}
        bed = None if container.bed_height is None else metres(container.bed_height)
        container = Container(container.type, all_metres(container.size), container.open_sides, drops, bed)
    return type(load)(boxes, container, load.name)


def _options(unit: Optional[str], axes: Optional[str], format: Optional[str], columns: Optional[str], container: Optional[str],
             config: str) -> dict[str, Any]:
    return {"unit": unit, "axes": axes, "format": format, "columns": columns, "container": container, "config": config}


def _loads_of(kind: type[Load], read: list[tuple[_core.Load, str, Any, list[Any]]], notes: tuple[Problem, ...]) -> list[Load]:
    """The loads of a file, as the library has read them."""
    for note in notes:
        warnings.warn(note.message, LoadWarning, stacklevel=3)
    loads = []
    for core, name, container, boxes in read:
        if container is not None:
            type_name, size, open_sides, drops, bed = container
            container = Container(type_name, size, open_sides, None if drops is None else dict(drops), bed)
        load = kind([Box(*box) for box in boxes], container, name)
        _set(load, "_core_load", core)
        loads.append(load)
    return loads
