"""Lower limits of the error bars of moving contacts."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.simulation.accuracy.coarser_results import History
from viscontact.simulation.transient.setup import RunSetup

#: Scalars that vanish for an elastic body.
RESISTANCES = ("resistance_x", "resistance_y", "friction_coefficient", "motion_work")

TINY = float(np.finfo(np.float64).tiny)


def least_resistance_bar(run: RunSetup, name: str, history: History) -> Floats:
    """Effect of the tolerance of the gap over times [N]: force times slope of the indentation."""
    motion = run.problem.motion
    extent = np.fmax(history["contact_length"], history["contact_width"])
    slope = np.abs(np.nan_to_num(history["approach"])) / np.maximum(np.nan_to_num(extent), TINY)
    coefficient = np.where(extent > 0, run.problem.solver_error * slope, 0.0)
    if name == "friction_coefficient":
        return np.asarray(coefficient)
    force = np.nan_to_num(history["force"]) * coefficient
    if name != "motion_work":
        return np.asarray(force)
    ways = np.hypot(*np.diff(motion.position_at(history["time"]), axis=0, prepend=np.nan).T)
    return np.asarray(np.cumsum(force * np.nan_to_num(ways)))


def entry_rise(run: RunSetup, times: Floats) -> Floats:
    """Possible relative rise of a peak at the leading edge of a contact on finer cells [-]."""
    # The material in the first cell has been in contact for the time in which the body passes a
    # cell, and is as compliant as then; it is stiffer on finer cells, up to its instant modulus.
    # The largest pressure of such a layer grows with the root of its stiffness.
    motion, compliance = run.problem.motion, run.problem.compliance
    if motion.stands or not compliance.instant > 0:
        return np.zeros(len(times))
    speeds = np.array([np.hypot(*motion.velocity_at(float(time))) for time in times])
    passing = min(run.grid.cell_size) / np.maximum(speeds, TINY)
    passing = np.minimum(passing, times[-1])
    rises = np.sqrt(np.asarray(compliance(passing)) / compliance.instant) - 1
    return np.where(speeds > 0, rises, 0.0)
