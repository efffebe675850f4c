# Written by tools/outcome_types.py from include/holdfast/outcome_fields.h.
"""What the numbers in a table of verdicts mean."""

import enum


class Verdict(enum.IntEnum):
    """What became of a world as a whole, by the worst that happened in it."""

    STAYED = 0  #: no box fell, moved or tilted, nor was any unstable
    MOVED = 1  #: a box moved or tilted at the end, and none fell
    FELL = 2  #: a box had fallen at the end
    UNSTABLE = 3  #: a box fell or moved while settling, before any acceleration, and no box did later
    FAILED = 4  #: the status is not 0, or the world was cancelled: nothing can be said
    GAVE_WAY = 5  #: with StopWhen: a box was beyond a threshold, and the world ended there
    NOT_NEEDED = 6  #: with FirstFailure: the layout failed another acceleration; not simulated


class StopReason(enum.IntEnum):
    """Why a world ended."""

    NOT_RUN = 0  #: it was not simulated: a bad input, or cancelled
    TIMEOUT = 1  #: the simulated time was up
    SLEEPING = 2  #: all boxes had come to rest
    FAILED = 3  #: the status says why
    DECIDED = 4  #: with StopWhen: a box was beyond a threshold, and the verdict is gave_way


class Status(enum.IntFlag):
    """Bits of a status: what went wrong with a world, and what to do."""

    OK = 0
    BAD_LAYOUT = 1  #: the layout could not be used; not simulated, no boxes. The message says why
    BAD_ACCELERATION = 2  #: the acceleration could not be used; not simulated. The message says why
    NON_FINITE = 4  #: a state became infinite or NaN; the samples end before that. Use a smaller step
    NOT_CONVERGED = 8  #: the solver's residual stayed above its limit. Allow more iterations or accuracy
    CAPACITY = 16  #: a device had too little memory for all contacts of the world, or failed. Use another engine
    #: the series would take too much memory, more than 20 million rows; not simulated. Use a longer interval, or none
    TOO_LARGE = 32
    #: with ``FirstFailure``: the layout does not hold another acceleration, which the message names; not simulated.
    #: This is no problem, and the verdict is not_needed
    NOT_NEEDED = 64


class ReplicaVerdict(enum.IntEnum):
    """What the replicas of a world say of it: docs/confidence.md."""

    NONE = 0  #: there are no replicas
    HOLDS = 1  #: the share that fails is surely below 1/8
    FAILS = 2  #: it is surely above 1/2
    UNCERTAIN = 3  #: neither
