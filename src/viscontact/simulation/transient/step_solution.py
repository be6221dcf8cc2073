"""Solution of one step."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viscontact.backend.arrays import Bools, Floats
from viscontact.mechanics.state import Outcome


@dataclass(frozen=True, eq=False)
class StepSolution:
    """Equilibrium at the end of a step.

    Fields over the whole grid, shape (nx, ny): pressure [Pa], gap and displacement [m], and the
    cells in contact.
    `reference` holds ∫ J dp [-] and its displacement [m] on the computed cells, shape (2, mx, my);
    `motion` approach [m] and tilts [rad]; `resultants` force [N] and moments about the origin
    [N m]; `energy` the elastic energy of the pressure on a half-space of unit compliance [J Pa];
    `residual` the relative violation of the contact conditions [-]. `resolved` is False where the
    step was long against the law; `time_error` estimates the relative error of the pressure from
    all steps so far [-]. `heat` [J] is the energy that the bodies lose in the step of a moving
    contact, `power` [W] the rate at its end; NaN where they are not known.
    """

    pressure: Floats
    gap: Floats
    displacement: Floats
    in_contact: Bools
    reference: Floats
    motion: Floats
    resultants: Floats
    energy: float
    residual: float
    iterations: int
    outcome: Outcome
    resolved: bool
    time_error: float = 0.0
    heat: float = math.nan
    power: float = math.nan
