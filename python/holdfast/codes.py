# Written by tools/outcome_types.py from include/holdfast/outcome_fields.h.
"""What the numbers in a table of verdicts mean."""

import enum


class Verdict(enum.IntEnum):
    """What became of a world as a whole: the worst that ever happened in it. docs/guide/verdicts.md"""

    STAYED = 0  #: no box was ever beyond a limit
    MOVED = 1  #: a box was displaced or tilted beyond its limit at some time, and none fell
    FELL = 2  #: a box was lower than before by more than DropThreshold at some time
    UNSTABLE = 3  #: a box was beyond a limit while the load settled under gravity alone; it was not accelerated
    #: the status is not 0 and no box was beyond a limit before, or the world was cancelled: nothing can be said
    FAILED = 4
    NOT_NEEDED = 6  #: with FirstFailure: the layout failed another acceleration; not simulated


class StopReason(enum.IntEnum):
    """Why a world ended."""

    NOT_RUN = 0  #: it was not simulated: a bad input, or cancelled
    TIMEOUT = 1  #: the simulated time was up
    SLEEPING = 2  #: all boxes had come to rest
    FAILED = 3  #: the status says why
    #: a box was beyond a limit, with StopWhen or while the load settled: the verdict is at least what it says
    DECIDED = 4


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


class Caveat(enum.IntFlag):
    """Bits of what a reader has to know beside the verdict, which they do not change."""

    OK = 0
    NOT_AT_REST = 1  #: the load was still moving after SettleSeconds, when the acceleration began
    STILL_MOVING = 2  #: a box was still moving when the world ended
    #: a friction coefficient is within 2 % of what the acceleration asks for: what is not known so exactly decides
    MARGINAL = 4


class ReplicaVerdict(enum.IntEnum):
    """What the replicas of a world say of it: docs/guide/confidence.md."""

    NONE = 0  #: there are no replicas
    HOLDS = 1  #: the share that fails is surely below 1/8
    FAILS = 2  #: it is surely above 1/2
    UNCERTAIN = 3  #: neither
