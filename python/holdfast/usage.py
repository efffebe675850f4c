"""Who may use the compiled part of a screen, and when."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from types import TracebackType
from typing import Optional

from . import _core

#: Seconds after which a call that goes on is cancelled again.
_CANCEL_INTERVAL = 0.05

# Compiled screens of the process that this one was forked from. Their threads are not here, so that they are kept and left
# alone.
_of_parent: list[_core.Screen] = []


class Usage:
    """The compiled part of a screen, used by one thread at a time as a context manager. In a forked process it is made
    anew."""

    def __init__(self, make: Callable[[], _core.Screen]) -> None:
        self._make = make
        self._core: Optional[_core.Screen] = make()
        self._begin_process()

    def _begin_process(self) -> None:
        self._process = os.getpid()
        self._lock = threading.Lock()
        self._user: Optional[int] = None
        self._other: Optional[_core.Screen] = None

    @property
    def closed(self) -> bool:
        return self._core is None

    def __enter__(self) -> _core.Screen:
        if self._process != os.getpid() and self._core is not None:
            _of_parent.extend(core for core in (self._core, self._other) if core is not None)
            self._begin_process()
            self._core = self._make()
        if not self._lock.acquire(blocking=False):
            # A signal handler, or a finaliser, in the midst of a call.
            if self._user == threading.get_ident():
                raise RuntimeError("the screen is in use by this thread")
            self._lock.acquire()
        if self._core is None:
            self._lock.release()
            raise ValueError("the screen is closed")
        self._user = threading.get_ident()
        return self._core

    def __exit__(self, kind: Optional[type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self._user = None
        self._lock.release()

    def also(self, core: _core.Screen) -> _core.Screen:
        """Another one that works for the same call, for `cancel` to end too."""
        self._other = core
        return core

    def no_more(self, core: _core.Screen) -> None:
        """That one has ended."""
        self._other = None

    def cancel(self) -> None:
        if self._process != os.getpid():
            return
        for core in (self._core, self._other):
            if core is not None:
                core.cancel()

    def close(self) -> None:
        if self._process != os.getpid():
            if self._core is not None:
                _of_parent.append(self._core)
            self._core = None
            return
        if self._user == threading.get_ident():
            raise RuntimeError("the screen is in use by this thread")
        while True:
            self.cancel()
            if self._lock.acquire(timeout=_CANCEL_INTERVAL):  # a call that was about to begin has not heard of it
                break
        self._core = None
        self._lock.release()
