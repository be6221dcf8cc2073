"""Solution of one step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.state import Outcome


@dataclass(frozen=True, eq=False)
class StepSolution:
    """Equilibrium at the end of a step, as the solver left it.

    Attributes
    ----------
    pressure : ndarray, shape (nx, ny)
        Pressure [Pa].
    gap, displacement : ndarray, shape (nx, ny)
        Gap and total displacement of the surface [m].
    twin : ndarray, shape (2, mx, my)
        ∫ J dp, the pressure whose deflection the displacement is [-], and that displacement [m], on
        the cells that are worked with.
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad].
    resultants : ndarray, shape (3,)
        Force [N] and moments [N m] of the pressure about the origin.
    energy : float
        Elastic energy of this pressure in a half-space of unit compliance [J Pa].
    residual : float
        Relative violation of the contact conditions [-].
    iterations : int
        Search directions of the solver.
    outcome : Outcome
        How it ended.
    resolved : bool
        Whether the step was short enough for the law.
    time_error : float
        Estimated relative error of the pressure owed to the steps so far.
    """

    pressure: NDArray[np.float64]
    gap: NDArray[np.float64]
    displacement: NDArray[np.float64]
    twin: NDArray[np.float64]
    motion: NDArray[np.float64]
    resultants: NDArray[np.float64]
    energy: float
    residual: float
    iterations: int
    outcome: Outcome
    resolved: bool
    time_error: float = 0.0
