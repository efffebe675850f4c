"""The engines that move boxes."""

from __future__ import annotations

from typing import NamedTuple

from . import _core


class Engine(NamedTuple):
    """An engine that moves boxes."""

    name: str  #: as :class:`Screen` takes it
    sentence: str  #: what it is
    missing: str  #: why it cannot be used here; empty when it can


def engines() -> list[Engine]:
    """All engines that this build knows, the default first.

    >>> engines()[0].name
    'native'
    """
    return [Engine(*engine) for engine in _core.engines()]
