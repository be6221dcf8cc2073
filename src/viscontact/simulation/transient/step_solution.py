"""Solution of one step."""

from __future__ import annotations

import math

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.normal_contact import NormalContact
from viscontact.mechanics.state import Outcome


@dataclass(frozen=True, eq=False)
class StepSolution:
    """Equilibrium at the end of a step; fields over the whole grid, shape (nx, ny)."""

    pressure: Floats  # [Pa]
    gap: Floats  # [m]
    displacement: Floats  # [m]
    in_contact: Bools
    reference: Floats  # ∫ J dp [-] and its displacement [m] on the computed cells, (2, mx, my)
    motion: Floats  # approach [m], tilts [rad]
    peak: float  # largest pressure [Pa]
    resultants: Floats  # force [N], moments about the origin [N m]
    energy: float  # elastic, on a half-space of unit compliance [J Pa]
    residual: float  # relative violation of the contact conditions [-]
    iterations: int
    outcome: Outcome
    resolved: bool  # False where the step was long against the law
    #: Factor by which a small change of the attraction returns; NaN between reported states [-].
    stability: float = math.nan
    #: Work that separating the surfaces would take [J], 0 without adhesion.
    adhesion_energy: float = 0.0
    #: Work of the attraction up to this state in cells that the grid has gained since [J].
    work_beyond: float = 0.0
    #: True if it may be another state: found by descent, or in a step of the shortest length.
    jumped: bool = False
    time_error: float = 0.0  # estimated relative error of the pressure by the steps so far [-]
    # Energy that the bodies lose in the step of a moving contact [J]; NaN if unknown.
    heat: float = math.nan
    power: float = math.nan  # lost at the end of the step [W]; NaN if unknown

    @property
    def contact(self) -> NormalContact:
        """Normal contact that tractions act in."""
        largest = max(float(self.displacement.max()), -float(self.displacement.min()))
        force = float(self.resultants[0])
        return NormalContact(self.pressure, self.gap, self.in_contact, force, largest)
