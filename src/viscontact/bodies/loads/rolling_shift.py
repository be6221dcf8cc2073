"""Shift of a body that rolls with a creepage over the surface."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.motion import Motion
from viscontact.bodies.loads.tangential import TangentialLoad, TangentialPoint


@dataclass(frozen=True, eq=False)
class RollingShift(TangentialLoad):
    """Surface of a rolling body, which moves by -creepage times its way, without turning.

    Where the surface speed of the body exceeds its travel by the creepage, as that of a driven
    wheel does, its surface moves backwards over the half-space.
    """

    motion: Motion

    def at(self, time: float, *, side: str = "right") -> TangentialPoint:
        """Return the shift at an instant [s]; it does not jump."""
        start, here = self.motion.position_at(np.array([0.0, time]))
        creepage = self.motion.creepage or 0.0
        along_x, along_y = (-creepage * (here - start)).tolist()
        return TangentialPoint((None, None, None), (along_x, along_y, 0.0))

    @property
    def kinks(self) -> Floats:
        """Kinks of the path [s]."""
        return self.motion.kinks

    @property
    def jumps(self) -> Floats:
        """No times, as a position does not jump [s]."""
        return np.empty(0)

    @property
    def acts(self) -> tuple[bool, bool, bool]:
        """True along the axes of the motion."""
        return *self.motion.moves, False

    @property
    def longest_step(self) -> float:
        """Longest step on which the path is nearly straight in time [s]."""
        return self.motion.longest_step

    @property
    def whole_cycles(self) -> tuple[tuple[float, float], ...]:
        """No cycles: those of the motion are its own."""
        return ()
