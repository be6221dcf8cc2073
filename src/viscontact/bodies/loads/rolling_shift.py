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
    wheel does, its surface moves backwards over the half-space. With a lateral creepage, as that of
    a wheel that is askew, it also moves to the right of the way by that times the way.
    """

    motion: Motion

    def at(self, time: float, *, side: str = "right") -> TangentialPoint:
        """Return the shift at an instant [s]; it does not jump."""
        start, here = self.motion.position_at(np.array([0.0, time]))
        creepage, lateral = self.motion.creepage or 0.0, self.motion.lateral_creepage or 0.0
        way_x, way_y = (here - start).tolist()
        shift = lateral * way_y - creepage * way_x, -lateral * way_x - creepage * way_y
        return TangentialPoint((None, None, None), (*shift, 0.0))

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
        """True along the axes of the motion, and with a lateral creepage across it."""
        along_x, along_y = self.motion.moves
        crosses = bool(self.motion.lateral_creepage)
        return along_x or crosses, along_y or crosses, False

    @property
    def longest_step(self) -> float:
        """Longest step on which the path is nearly straight in time [s]."""
        return self.motion.longest_step

    @property
    def whole_cycles(self) -> tuple[tuple[float, float], ...]:
        """No cycles: those of the motion are its own."""
        return ()
