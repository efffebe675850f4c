"""Evaluates layouts under a set of accelerations."""

from __future__ import annotations

import atexit
import operator
import os
import threading
import weakref
from collections.abc import Iterable, Iterator, Sequence
from types import TracebackType
from typing import Any, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from .accelerations import Acceleration, AccelerationLike, acceleration_of
from .errors import Error, Problem
from .flight import Flight
from .indicators import Indicators
from .loads import Load
from .margins import Margins
from .replay import Replay
from .usage import Usage
from .verdicts import BoxNames, Verdicts

#: A layout: an array of shape (boxes, 7), or a load.
LayoutLike = Union[npt.ArrayLike, Load]

#: Layouts: one each; with offsets one array of shape (boxes of all layouts, 7).
Layouts = Union[Sequence[LayoutLike], npt.NDArray[Any]]


class Screen:
    """Evaluates layouts under a set of accelerations.

    It is used by one thread at a time: a second one waits. Python's lock is released while it works. Ctrl-C ends the work
    and raises KeyboardInterrupt. As a context manager it is closed at the end of the block.

    It starts no thread before it needs one, and may be pickled, which keeps its accelerations and options, and sent to other
    processes. In a forked process :meth:`evaluate` works on one thread, if the parent has used several.

    :param accelerations: at least one, unless there is a norm: :class:`Acceleration`, path of a file, or array of shape
        (segments, 5)
    :param norm: name of a norm, such as "road" (docs/reference/norms.md), whose accelerations come first
    :param accuracy: of the native engine: "screening", "standard" (default), "reference"
    :param engine: such as "native" (default), see :func:`engines`
    :param threads: worlds that are simulated at the same time; 0: one per core (default)
    :param unit: of arrays: "m", or "cm" as in layout files; a :class:`Load` is in metres in any case
    :param errors: "raise": a bad layout is an :class:`Error`, before anything is simulated; "mark": its worlds have a status
        and a message, and the others are simulated; what is neither an array nor a sequence is an :class:`Error` in any case
    :param keep_boxes: whether verdicts have :meth:`Verdicts.box_outcomes`
    :param config: text of a config.ini, for all that is not a parameter here (docs/reference/config.md)
    :param scheduler: "tbb", "openmp" or "serial"; never changes a result
    :param most_in_flight: layouts that :meth:`stream` has in flight at once; 0: 16 per thread
    :raises Error: a setting or an acceleration cannot be used

    >>> with Screen([[[0.0, 1.0, 7.0, 0.0, 0.0]]], accuracy="screening") as screen:
    ...     screen.evaluate([[[2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1]]])
    <holdfast.Verdicts of shape (1, 1): 1 moved>
    """

    def __init__(
        self,
        accelerations: Iterable[AccelerationLike] = (),
        *,
        norm: Optional[str] = None,
        accuracy: Optional[str] = None,
        engine: Optional[str] = None,
        threads: Optional[int] = None,
        unit: Literal["m", "cm"] = "m",
        errors: Literal["raise", "mark"] = "raise",
        keep_boxes: bool = False,
        config: str = "",
        scheduler: Optional[str] = None,
        most_in_flight: int = 0,
    ) -> None:
        if isinstance(accelerations, (str, os.PathLike, Acceleration)):
            raise TypeError("accelerations go into a list, also a single one")
        if unit not in ("m", "cm"):
            raise ValueError(f"unit is {unit!r}, not 'm' or 'cm'")
        if errors not in ("raise", "mark"):
            raise ValueError(f"errors is {errors!r}, not 'raise' or 'mark'")
        self._given = tuple(acceleration_of(given, i) for i, given in enumerate(accelerations))
        self._options: dict[str, Any] = {
            "norm": norm, "accuracy": accuracy, "engine": engine, "threads": threads, "unit": unit, "errors": errors,
            "keep_boxes": bool(keep_boxes), "config": config, "scheduler": scheduler, "most_in_flight": most_in_flight,
        }
        self._streaming = False
        self._usage = Usage(self._make)
        with self._usage as core:
            self._accelerations = tuple(Acceleration(*one) for one in core.accelerations())
        if not self._accelerations:
            raise ValueError("a screen needs at least one acceleration, or a norm")
        _open_screens.add(self)

    def _make(self, only: Optional[Acceleration] = None, keep_series: bool = False) -> _core.Screen:
        options = self._options
        core = _core.Screen(
            config=options["config"], norm=options["norm"] if only is None else "", engine=options["engine"],
            accuracy=options["accuracy"], scheduler=options["scheduler"], threads=options["threads"],
            centimetres=options["unit"] == "cm", mark=options["errors"] == "mark" and not keep_series, keep_boxes=options["keep_boxes"] or keep_series,
            keep_series=keep_series, most_in_flight=options["most_in_flight"])
        for acceleration in self._given if only is None else (only,):
            core.add_acceleration(acceleration.name, acceleration.segments, acceleration.purpose)
        return core

    @property
    def accelerations(self) -> tuple[Acceleration, ...]:
        """The accelerations, in the order of the columns of a table of verdicts."""
        return self._accelerations

    @property
    def closed(self) -> bool:
        """Whether the screen was closed."""
        return self._usage.closed

    def _verdicts(self, table: npt.NDArray[Any], messages: dict[tuple[int, int], str], problems: tuple[Problem, ...],
                  names: Sequence[str], boxes: Optional[dict[int, npt.NDArray[Any]]], box_names: BoxNames) -> Verdicts:
        return Verdicts(table, messages, problems, [one.name for one in self._accelerations], names, boxes, box_names)

    def evaluate(self, layouts: Layouts, *, offsets: Optional[npt.ArrayLike] = None,
                 names: Optional[Iterable[str]] = None) -> Verdicts:
        """Evaluates every layout under every acceleration.

        Arrays of float64, row after row, are read where they are; others are copied.

        :param layouts: one array of shape (boxes, 7), or one :class:`Load`, per layout; or with ``offsets`` one array of shape (boxes of all
            layouts, 7), in which layout i has the rows offsets[i], ..., offsets[i + 1] - 1
        :param names: one per layout, for messages and results; without, those of loads, or "layout" and its index
        :return: verdicts of shape (layouts, accelerations); worlds that :meth:`cancel` ended have
            :attr:`StopReason.NOT_RUN`
        :raises Error: a layout cannot be used; it names layout, box and column

        >>> with Screen([[[0.0, 1.0, 7.0, 0.0, 0.0]]], threads=1) as screen:
        ...     flat = np.array([[2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1], [3.0, 1.0, 0.0, 3.5, 1.5, 0.5, 1]])
        ...     verdicts = screen.evaluate(flat, offsets=[0, 1, 2])
        >>> verdicts.moved
        array([[1],
               [1]], dtype=uint32)
        """
        layouts, given, box_names = _taken(layouts, offsets, names)
        with self._usage as core:
            table, messages, problems, boxes = core.evaluate(layouts, offsets, given, _is_main_thread())
        return self._verdicts(table, messages, problems, given, None if boxes is None else dict(enumerate(boxes)), box_names)

    def holds(self, layouts: Layouts, *, offsets: Optional[npt.ArrayLike] = None,
              names: Optional[Iterable[str]] = None) -> npt.NDArray[np.bool_]:
        """Whether each layout stays under every acceleration: the same as ``evaluate(layouts).holds.all(axis=1)``, sooner. A
        world ends when its verdict is decided, and a layout with the first world that rejects it.

        :param layouts: as for :meth:`evaluate`, as are ``offsets`` and ``names``
        :return: of shape (layouts,); False too for a layout that cannot be used, with ``errors="mark"``, and for those that
            :meth:`cancel` ended
        :raises Error: a layout cannot be used

        >>> with Screen([[[0.0, 1.0, 7.0, 0.0, 0.0]]]) as screen:
        ...     screen.holds([[[0.0, 1.0, 0.0, 0.5, 1.5, 0.5, 1]], [[2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1]]])
        array([ True, False])
        """
        layouts, given, _ = _taken(layouts, offsets, names)
        with self._usage as core:
            return core.holds(layouts, offsets, given, _is_main_thread())

    def indicators(self, layouts: Layouts, *, offsets: Optional[npt.ArrayLike] = None,
                   names: Optional[Iterable[str]] = None) -> Indicators:
        """What geometry alone says of each layout: base support, supported sides, centre of gravity, fill. Nothing is
        simulated, and the accelerations of the screen play no part.

        :param layouts: as for :meth:`evaluate`, as are ``offsets`` and ``names``
        :raises Error: a layout cannot be used

        >>> with Screen([[[0.0, 1.0, 7.0, 0.0, 0.0]]]) as screen:
        ...     indicators = screen.indicators([[[0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1], [0.0, 0.0, 0.5, 1.0, 0.5, 1.0, 1]]])
        >>> indicators.base_support[0], indicators.supported_sides[0]
        (array([1. , 0.5], dtype=float32), array([2, 2], dtype=uint8))
        """
        layouts, given, _ = _taken(layouts, offsets, names)
        with self._usage as core:
            found = core.indicators(layouts, offsets, given)
        return Indicators(*found, given)

    def margins(self, layouts: Layouts, *, offsets: Optional[npt.ArrayLike] = None,
                names: Optional[Iterable[str]] = None) -> Margins:
        """How many g each layout stands in its place and within the limits, pushed to the front, the rear, the left and the
        right. The accelerations of the screen play no part.

        :param layouts: as for :meth:`evaluate`, as are ``offsets`` and ``names``
        :raises Error: a layout cannot be used, or the engine cannot find margins; native can

        >>> with Screen([[[0.0, 1.0, 7.0, 0.0, 0.0]]]) as screen:
        ...     margins = screen.margins([[[2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1]]])
        >>> margins.margin_within_limits.round(2)
        array([[0.5, 0.5, 0.5, 0.5]])
        """
        layouts, given, box_names = _taken(layouts, offsets, names)
        with self._usage as core:
            found = core.margins(layouts, offsets, given, _is_main_thread())
        return Margins(*found, given, box_names)

    def stream(self, layouts: Iterable[LayoutLike], *, ordered: bool = False,
               names: Optional[Iterable[str]] = None) -> Iterator[tuple[int, Verdicts]]:
        """Evaluates layouts as they are asked for, and gives each with its index as it finishes.

        Layouts are taken from the iterable as there is room for them (``most_in_flight``), so that there may be any number.
        A screen has one stream at a time; leaving the loop early drops what is in flight.

        :param ordered: give them in the order of the layouts
        :return: pairs of index and verdicts of shape (accelerations,)
        :raises Error: a layout cannot be used; those before it that are in flight are dropped
        """
        return self._stream(iter(layouts), ordered, None if names is None else iter(names))

    def _stream(self, layouts: Iterator[LayoutLike], ordered: bool,
                names: Optional[Iterator[str]]) -> Iterator[tuple[int, Verdicts]]:
        with self._usage:
            if self._streaming:
                raise RuntimeError("the screen has a stream already, which is not at its end")
            self._streaming = True
        flight = Flight(self._usage, layouts, names)
        try:
            while True:
                flight.fill()
                landed = flight.land(ordered, _is_main_thread())
                if landed is None:
                    return
                verdicts = self._verdicts(landed.table, landed.messages, landed.problems, flight.names, landed.boxes,
                                          landed.box_names)
                yield landed.index, verdicts
        finally:
            self._end_stream()

    def _end_stream(self) -> None:
        """Drops what is in flight."""
        self._streaming = False
        try:
            with self._usage as core:
                while core.in_flight():
                    core.cancel()
                    core.poll(False, False)
        except ValueError:
            if not self.closed:
                raise

    def record(self, layouts: Layouts, path: str | os.PathLike[str], *, offsets: Optional[npt.ArrayLike] = None,
               names: Optional[Iterable[str]] = None, series: bool = True, resume: bool = False,
               overwrite: bool = False, command_line: str = "") -> bool:
        """Evaluates layouts into a results file, as ``holdfast screen`` writes it (docs/reference/results_file.md).

        What is finished survives whatever ends the process.

        :param layouts: as for :meth:`evaluate`, as are ``offsets`` and ``names``
        :param series: write time series too
        :param resume: continue a run of the same layouts that was stopped or killed
        :param overwrite: replace the results of an earlier run; not together with ``resume``
        :param command_line: noted in the file
        :return: False when :meth:`cancel` ended it: the finished worlds are kept for ``resume``
        :raises Error: a layout cannot be used, or the file cannot be written, or exists
        """
        layouts, given, _ = _taken(layouts, offsets, names)
        with self._usage as core:
            return core.record(layouts, offsets, given, os.fspath(path),
                               series=series, resume=resume, overwrite=overwrite, command_line=command_line,
                               on_main_thread=_is_main_thread())

    def replay(self, layout: LayoutLike, acceleration: int | str | Acceleration = 0) -> Replay:
        """One layout under one acceleration over time, with the bits of :meth:`evaluate`.

        :param layout: array of shape (boxes, 7), or :class:`Load`
        :param acceleration: index or name of one of the screen's, or another one
        :raises Error: the layout cannot be used, or its series would take too much memory

        >>> with Screen([[[0.0, 1.0, 7.0, 0.0, 0.0]]]) as screen:
        ...     replay = screen.replay([[2.0, 1.0, 0.0, 2.5, 1.5, 0.5, 1]], 0)
        >>> replay.displacement.shape
        (16, 1, 3)
        >>> round(float(replay.displacement[-1, 0, 0]), 2)
        -1.49
        """
        chosen = self._acceleration(acceleration)
        with self._usage:
            core = self._usage.also(self._make(chosen, keep_series=True))
            try:
                table, messages, boxes, series = core.replay(layout, _is_main_thread())
            finally:
                self._usage.no_more(core)
        assert boxes is not None
        if not len(series[0]):
            text = messages.get((0, 0), "the world was not simulated")
            raise Error([Problem(text, text, "", "")])
        names: BoxNames = {0: layout.box_names} if isinstance(layout, Load) else {}
        return Replay(*series, Verdicts(table.reshape(()), messages, (), [chosen.name], (), None, names), boxes[0][0])

    def _acceleration(self, wanted: int | str | Acceleration) -> Acceleration:
        if isinstance(wanted, Acceleration):
            return wanted
        if isinstance(wanted, str):
            found = [one for one in self._accelerations if one.name == wanted]
            if not found:
                known = ", ".join(one.name for one in self._accelerations)
                raise ValueError(f"no acceleration is called {wanted!r}; there are {known}")
            return found[0]
        return self._accelerations[operator.index(wanted)]

    def read_layout(self, path: str | os.PathLike[str]) -> npt.NDArray[np.float64]:
        """Reads a layout file: an array of shape (boxes, 7), in the unit of this screen.

        :raises Error: the file cannot be read or used; every problem names line and character
        """
        with self._usage as core:
            return core.read_layout(os.fspath(path))

    def cancel(self) -> None:
        """Ends what the screen does, and drops what is in flight. May be called by any thread."""
        self._usage.cancel()

    def close(self) -> None:
        """Cancels what the screen does, and waits until it has ended. Every other method then raises ValueError; closing
        again does nothing. May be called by any thread."""
        self._usage.close()

    def __enter__(self) -> Screen:
        if self.closed:
            raise ValueError("the screen is closed")
        return self

    def __exit__(self, kind: Optional[type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, (self._given, self._options)

    def __repr__(self) -> str:
        given = "".join(f", {name}={value!r}" for name, value in self._options.items()
                        if value not in (None, "", False, 0) and (name, value) not in (("unit", "m"), ("errors", "raise")))
        names = ", ".join(one.name for one in self._accelerations)
        return f"<holdfast.Screen of {names}{given}{', closed' if self.closed else ''}>"


def _made(accelerations: tuple[Acceleration, ...], options: dict[str, Any]) -> Screen:
    return Screen(accelerations, **options)


def _taken(layouts: Any, offsets: Optional[npt.ArrayLike], names: Optional[Iterable[str]]) -> tuple[Any, list[str], BoxNames]:
    """The layouts of a call as something that has a length and indices, names of layouts, if there are any, and names of the
    boxes of loads."""
    given = list(names) if names is not None else []
    if offsets is not None or isinstance(layouts, np.ndarray):
        return layouts, given, {}
    if isinstance(layouts, Load):
        raise TypeError("loads go into a list, also a single one")
    if not isinstance(layouts, (list, tuple)):
        layouts = list(layouts)
    loads = {i: layout for i, layout in enumerate(layouts) if isinstance(layout, Load)}
    if not loads:
        return layouts, given, {}
    if names is None and any(load.name for load in loads.values()):
        given = [loads[i].name if i in loads and loads[i].name else f"layout {i}" for i in range(len(layouts))]
    return layouts, given, {i: load.box_names for i, load in loads.items() if any(load.box_names)}


def _is_main_thread() -> bool:
    """Whether this is the thread that gets Python's signals."""
    return threading.current_thread() is threading.main_thread()


_open_screens: weakref.WeakSet[Screen] = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    """No thread works on when the interpreter ends."""
    for screen in list(_open_screens):
        screen.close()
