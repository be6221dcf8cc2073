"""Errors of the time steps that coarser runs have not shown."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.simulation.accuracy.coarser_results import History
from viscontact.simulation.accuracy.refinement_levels import RefinementLevels, moving_maximum
from viscontact.simulation.accuracy.rim_cells import recedes
from viscontact.simulation.transient.setup import RunSetup

#: Estimated time error of the pressure that counts only in excess, at the instants that a third run
#: with divided steps has left out.
SHOWN_TIME_ERROR = 0.01

#: Part of the estimated time error of the pressure that counts in a receding contact at instants
#: that coarser runs share: they may take the step before as the run does.
SHOWN_RECEDING = 0.3


def while_receding(run: RunSetup, left_out: Bools, history: History) -> Floats:
    """Relative error of a contact that recedes, by the time error of its pressure [-]."""
    # A rim that loses contact within a step is loaded too long in it. Runs with other steps show
    # this at the instants that they share.
    parts = np.where(left_out, 1.0, SHOWN_RECEDING) * history["time_error"]
    return np.where(recedes(history) & run.problem.motion.stands, parts, 0.0)


def estimated_by_steps(name: str, levels: RefinementLevels, history: History) -> Floats:
    """Changes of a scalar by the time error of the pressure, where no third run has shown it."""
    own = np.abs(levels.values[0])
    largest = moving_maximum(history["time_error"])
    if levels.steps_shown.any():
        # At the instants that it has left out, those next to them have shown the smaller ones.
        largest = np.fmax(history["time_error"] - SHOWN_TIME_ERROR, 0.0)
    # What a step has added to the work keeps its error.
    added = np.abs(np.diff(levels.values[0], prepend=0.0))
    kept = np.nancumsum(largest * added) if name == "work" else largest * own
    return np.where(levels.steps_shown, 0.0, np.fmax(kept, largest * own))
