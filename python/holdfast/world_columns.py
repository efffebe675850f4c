# Written by tools/outcome_types.py from include/holdfast/outcome_fields.h.
"""The columns of a table of verdicts that say what became of a world."""

from .column import Column


class WorldColumns:
    """What became of a world, one column per field. In a world that was not simulated, counts and measures are 0."""

    __slots__ = ()

    layout = Column("Index of the layout: row of /inputs/layouts.")
    acceleration = Column("Index of the acceleration: row of /inputs/accelerations.")
    verdict = Column(
        "The worst that happened: 0 stayed, 1 moved, 2 fell, 3 unstable (before any acceleration), 4 failed, 5 "
        "gave_way (ended early by StopWhen), 6 not_needed (left out by FirstFailure). See :class:`Verdict`."
    )
    status = Column(
        "What went wrong, one bit per cause; 0: nothing; the bits are listed in docs/results_file.md. See "
        ":class:`Status`."
    )
    stop_reason = Column(
        "Why the world ended: 0 not run, 1 timeout, 2 sleeping, 3 failed, 4 decided (by StopWhen). See "
        ":class:`StopReason`."
    )
    boxes = Column("Boxes of the world; 0 when it was not run.")
    fallen = Column("Boxes that had fallen at the end.")
    unstable = Column("Boxes that fell or moved while settling, before any acceleration.")
    moved = Column("Boxes displaced by more than the move threshold at the end.")
    tilted = Column("Boxes rotated by more than the tilt threshold at the end.")
    total_kinetic_energy = Column("Kinetic energy of all boxes together at the end, J.")
    peak_kinetic_energy = Column("Largest kinetic energy of all boxes together, over all steps, J.")
    max_displacement = Column("Largest displacement of a box at the end, m.")
    peak_displacement = Column("Largest displacement of a box, over all steps, m.")
    end_time = Column("Simulated time at which the world ended, s.")
    steps = Column("Steps that the simulated time is divided into.")
    steps_skipped = Column("Those of them that were not computed, because all islands were in static equilibrium.")
    max_residual = Column(
        "Largest change of a contact's velocity in the last iteration of a step, in the step in which it is largest "
        "relative to residual_scale, m/s."
    )
    residual_scale = Column(
        "Velocity added in that step: the norm of g - a (native) or g (others), times the step, m/s; 0 if there is no "
        "residual."
    )
    max_penetration = Column(
        "Largest penetration of a box into another or a side, over all steps, m; 0 if the engine does not measure it."
    )
    cpu_seconds = Column("Processor time to build and simulate the world, s.")
    state_hash = Column("Hash of the bits of the final state: equal results have equal hashes.")


#: What the columns of :meth:`Verdicts.box_outcomes` say, by their names.
BOX_COLUMNS = {
    "displacement": "displacement x, y, z of the centre of mass from the reference pose, at the end, m",
    "tilt": "angle of the rotation from the reference pose, at the end, degree",
    "kinetic_energy": "kinetic energy in the container's frame, at the end, J",
    "peak_displacement": "largest length of the displacement, over all steps, m",
    "peak_kinetic_energy": "largest kinetic energy, over all steps, J",
    "peak_speed": "largest speed of the centre of mass in the container, over all steps, m/s; NaN in a file of an earlier version",
    "fallen": "1 when drop exceeds the drop threshold, else 0",
    "moved": "1 when the displacement at the end is longer than the move threshold, else 0",
    "tilted": "1 when tilt exceeds the tilt threshold, else 0",
    "unstable": "1 when the box fell or moved while settling, else 0",
}
