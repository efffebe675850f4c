"""What the numbers in a table of verdicts mean."""

import enum


class Verdict(enum.IntEnum):
    """What became of a world as a whole, by the worst that happened in it."""

    STAYED = 0  #: no box fell, moved or tilted, nor was any unstable
    MOVED = 1  #: a box moved or tilted at the end, and none fell
    FELL = 2  #: a box had fallen at the end
    UNSTABLE = 3  #: a box fell or moved while settling, before any acceleration, and all stayed since
    FAILED = 4  #: the status is not 0, or the world was cancelled: nothing can be said
    GAVE_WAY = 5  #: with ``StopWhen``: a box left its place, and the world ended there
    NOT_NEEDED = 6  #: with ``FirstFailure``: the layout failed another acceleration; not simulated


class ReplicaVerdict(enum.IntEnum):
    """What the replicas of a world say of it, with ``Replicas`` in the config."""

    NONE = 0  #: there are no replicas
    HOLDS = 1  #: the share that fails is surely below 1/8
    FAILS = 2  #: it is surely above 1/2
    UNCERTAIN = 3  #: neither


class StopReason(enum.IntEnum):
    """Why a world ended."""

    NOT_RUN = 0  #: it was not simulated: a bad input, or cancelled
    TIMEOUT = 1  #: the simulated time was up
    SLEEPING = 2  #: all boxes had come to rest
    FAILED = 3  #: the status says why
    DECIDED = 4  #: with ``StopWhen``: the verdict is ``GAVE_WAY``


class Status(enum.IntFlag):
    """What went wrong with a world: bits."""

    OK = 0
    BAD_LAYOUT = 1  #: the layout cannot be used; not simulated
    BAD_ACCELERATION = 2  #: the acceleration cannot be used; not simulated
    NON_FINITE = 4  #: a state became infinite or undefined
    NOT_CONVERGED = 8  #: the solver's residual stayed above its bound
    CAPACITY = 16  #: a device had no room for all contacts, or failed
    TOO_LARGE = 32  #: its series would take too much memory; not simulated
    NOT_NEEDED = 64  #: with ``FirstFailure``: no problem, see :class:`Verdict`
