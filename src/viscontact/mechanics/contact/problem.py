"""Contact problem of one time step: what is prescribed, and a pressure with its displacement."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.rigid_balance import Constraints


@dataclass(frozen=True, eq=False)
class ContactProblem:
    """Contact problem: gap = open_gap + compliance K p - approach - tilts."""

    #: Indenter's gap plus the displacement from the load history, +inf outside the body [m]; shape
    #: (nx, ny).
    open_gap: Floats
    compliance: float  # contact compliance of the new pressure [1/Pa]
    constraints: Constraints  # resultants or prescribed motions
    displacement_scale: float  # smallest displacement that errors are relative to [m]

    def within(self, patch: Patch) -> ContactProblem:
        """Same problem on a patch."""
        others = self.compliance, self.constraints, self.displacement_scale
        return ContactProblem(patch.cut(self.open_gap), *others)

    def coarsened(self) -> ContactProblem:
        """Same problem in doubled cells, but for an axis of one, with the mean gap."""
        nx, ny = self.open_gap.shape
        pair_x, pair_y = min(nx, 2), min(ny, 2)
        fours = self.open_gap.reshape(nx // pair_x, pair_x, ny // pair_y, pair_y)
        return replace(self, open_gap=fours.mean(axis=(1, 3)))


@dataclass(frozen=True, eq=False)
class Guess:
    """Pressure, its unit displacement, and the body's rigid motion."""

    #: Pressure [Pa] and unit displacement K p of it [Pa m]; shape (2, nx, ny).
    values: Floats
    motion: Floats  # approach [m] and tilts along x and y [rad]

    @classmethod
    def of(
        cls,
        pressure: Floats,
        unit_displacement: Floats,
        motion: Floats,
    ) -> Guess:
        """Guess from a pressure [Pa] and its unit displacement [Pa m], which are copied."""
        return cls(np.stack([pressure, unit_displacement]), motion)

    @property
    def pressure(self) -> Floats:
        """Pressure [Pa]."""
        pressure: Floats = self.values[0]
        return pressure

    @property
    def unit_displacement(self) -> Floats:
        """Unit displacement K p of that pressure [Pa m]."""
        displacement: Floats = self.values[1]
        return displacement

    def within(self, patch: Patch) -> Guess:
        """The part on a patch, in the same memory."""
        return Guess(self.values[:, patch.rows, patch.columns], self.motion)
