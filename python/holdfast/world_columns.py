# Written by tools/outcome_types.py from include/holdfast/outcome_fields.h.
"""The columns of a table of verdicts that say what became of a world."""

from .column import Column


class WorldColumns:
    """What became of a world, one column per field. In a world that was not simulated, counts and measures are 0."""

    __slots__ = ()

    layout = Column("Index of the layout: row of /inputs/layouts.")
    acceleration = Column("Index of the acceleration: row of /inputs/accelerations.")
    verdict = Column(
        "The worst that ever happened: 0 stayed, 1 moved, 2 fell, 3 unstable (while settling, before any "
        "acceleration), 4 failed, 6 not_needed (left out by FirstFailure). See :class:`Verdict`."
    )
    status = Column(
        "What went wrong, one bit per cause; 0: nothing; the bits are listed in docs/reference/results_file.md. See "
        ":class:`Status`."
    )
    status_time = Column(
        "End of the last step before the first bit of the status was set: peaks are up to here, s; NaN where the "
        "status is 0, or nothing was simulated."
    )
    caveats = Column(
        "What has to be known beside the verdict, one bit each; 0: nothing; the bits are listed in "
        "docs/reference/results_file.md. See :class:`Caveat`."
    )
    stop_reason = Column(
        "Why the world ended: 0 not run, 1 timeout, 2 sleeping, 3 failed, 4 decided (a box was beyond a limit, with "
        "StopWhen or while settling). See :class:`StopReason`."
    )
    boxes = Column("Boxes of the world, with those that are fixed to the container; 0 when it was not run.")
    fallen = Column("Boxes that were ever lowered by more than DropThreshold.")
    unstable = Column("Boxes that were beyond a limit while settling, before any acceleration.")
    moved = Column("Boxes that were ever displaced by more than MoveThreshold.")
    tilted = Column("Boxes that were ever rotated by more than TiltThreshold.")
    fallen_at_end = Column("Boxes that are lower by more than DropThreshold at the end.")
    critical_box = Column(
        "Box that was beyond a limit first, or, where none was, came nearest to one: position in the layout, from 1; 0"
        " where no box used up a hundredth of a limit."
    )
    peak_displacement = Column("Largest displacement of a box, over all steps, m.")
    peak_drop = Column("By how much a box was lowered at most, over all steps, m.")
    peak_tilt = Column("Largest angle of rotation of a box, over all steps, degree.")
    end_displacement = Column("Largest displacement of a box at the end, m.")
    peak_kinetic_energy = Column("Largest kinetic energy of all boxes together, over all steps, J.")
    end_kinetic_energy = Column("Kinetic energy of all boxes together at the end, J.")
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
    "peak_displacement": "largest length of the displacement, over all steps, m",
    "peak_drop": "by how much the centre of mass was lower at most, over all steps, m; never negative",
    "peak_tilt": "largest angle of the rotation, over all steps, degree",
    "peak_kinetic_energy": "largest kinetic energy, over all steps, J",
    "peak_speed": "largest speed of the centre of mass in the container, over all steps, m/s; NaN in a file of an earlier version",
    "end_displacement": "displacement x, y, z of the centre of mass, at the end, m",
    "end_tilt": "angle of the rotation, at the end, degree",
    "end_kinetic_energy": "kinetic energy in the container's frame, at the end, J",
    "settling_peak_displacement": "largest length of the displacement while settling, before t = 0, m",
    "settling_peak_drop": "by how much the centre of mass was lower at most while settling, m",
    "settling_peak_tilt": "largest angle of the rotation while settling, degree",
    "fallen": "1 when peak_drop exceeds DropThreshold, else 0",
    "moved": "1 when peak_displacement exceeds MoveThreshold, else 0",
    "tilted": "1 when peak_tilt exceeds TiltThreshold, else 0",
    "unstable": "1 when a peak while settling exceeds one of the three, else 0",
    "fallen_at_end": "1 when the box is lower by more than DropThreshold at the end, else 0",
    "first_beyond": "end of the first step in which the box was beyond a limit, negative while settling, s; NaN if it never was, or by other limits than those of the run",
}
