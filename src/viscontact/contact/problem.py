"""The contact problem of one instant, in words: what is given, and a pressure with its effects."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.domain import Patch
from viscontact.contact.rigid_balance import Constraints


@dataclass(frozen=True, eq=False)
class ContactProblem:
    """One instant's problem: gap = open_gap + compliance K p - approach - tilts.

    Attributes
    ----------
    open_gap : ndarray, shape (nx, ny)
        Gap without new pressure and rigid motion: the indenter's shape plus the displacement
        owed to the past [m]; +inf where the body has no surface.
    compliance : float
        Contact compliance that meets the pressure [1/Pa].
    constraints : Constraints
        What holds the body: resultants or motions.
    displacement_scale : float
        Smallest displacement that errors are measured against [m].
    """

    open_gap: NDArray[np.float64]
    compliance: float
    constraints: Constraints
    displacement_scale: float

    def within(self, patch: Patch) -> ContactProblem:
        """The same problem on a patch."""
        return replace(self, open_gap=patch.cut(self.open_gap))

    def coarsened(self) -> ContactProblem:
        """The same problem in cells twice as long and wide, with the mean gap of the four."""
        nx, ny = self.open_gap.shape
        fours = self.open_gap.reshape(nx // 2, 2, ny // 2, 2)
        return replace(self, open_gap=fours.mean(axis=(1, 3)))


@dataclass(frozen=True, eq=False)
class Guess:
    """A pressure, what it does, and the body's rigid motion.

    Attributes
    ----------
    pressure : ndarray, shape (nx, ny)
        Pressure [Pa].
    unit_displacement : ndarray, shape (nx, ny)
        ``K pressure`` of that pressure [Pa m].
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad] along x and y.
    """

    pressure: NDArray[np.float64]
    unit_displacement: NDArray[np.float64]
    motion: NDArray[np.float64]

    def within(self, patch: Patch) -> Guess:
        """The part on a patch."""
        return Guess(patch.cut(self.pressure), patch.cut(self.unit_displacement), self.motion)
