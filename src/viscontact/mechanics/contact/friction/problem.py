"""Frictional problem of one time step: what is prescribed, and a traction with what it causes."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Flags, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.discs import ON_CIRCLE, divided
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift, ShiftConstraints
from viscontact.mechanics.halfspace.shear_filter import PairFilter


@dataclass(frozen=True, eq=False)
class SlipProblem:
    """Coulomb friction in a step: slip w = J T q + D q + past - motion, w = -λ q, |q| <= μ p.

    Of a cell in contact the traction q minimises 1/2 q·(J T + D) q + q·past over the discs, under
    prescribed resultants, whose multipliers are the motion.
    """

    in_contact: Bools  # at the end of the step, (nx, ny)
    bound: Floats  # μ p there, 0 elsewhere [Pa], (nx, ny)
    past: Floats | None  # displacement in the step by earlier tractions [m], (2, nx, ny)
    compliance: float  # contact compliance J of the new traction [1/Pa]
    entry: Floats  # compliance D of cells that enter, xx, xy and yy [m/Pa], (3, nx, ny)
    constraints: ShiftConstraints
    displacement_scale: float  # least displacement that errors are relative to [m]
    # Tractions that displace the surface as earlier ones do in the step, but for `past` [Pa].
    earlier: Floats | None = None

    def displaced(self, operator: PairFilter, traction: Floats) -> Floats:
        """Displacement by a traction and the earlier ones per unit compliance [Pa m]."""
        loads = traction if self.earlier is None else traction + self.earlier
        return operator.apply(loads) if loads.any() else np.zeros(loads.shape)

    def slip_before_shift(self, traction: Floats, unit_displacement: Floats) -> Floats:
        """Slip of the surface under a body that does not move [m], (2, nx, ny)."""
        found: Floats = self.compliance * unit_displacement
        if self.past is not None:
            found += self.past
        if self.enters:
            x, y = traction
            xx, xy, yy = self.entry
            found[0] += xx * x + xy * y
            found[1] += xy * x + yy * y
        return found

    @cached_property
    def enters(self) -> bool:
        """True if any cell enters."""
        return bool(self.entry.any())

    @cached_property
    def held(self) -> Floats:
        """1 in cells in contact, 0 elsewhere."""
        return self.in_contact.astype(np.float64)

    @cached_property
    def inverse_bound(self) -> Floats:
        """Inverse of the bound, 0 where that is [1/Pa]."""
        return divided(self.held, self.bound, self.bound > 0)

    @cached_property
    def reaching(self) -> Floats:
        """Square of the traction at which a cell in contact has reached its circle [Pa²]."""
        least = self.bound * (1 - ON_CIRCLE)
        return np.where(self.in_contact, least * least, np.inf)


@dataclass(frozen=True, eq=False)
class ShearBlock:
    """Operators of a block of cells."""

    convolution: PairFilter  # T, traction to displacement per unit compliance
    search: PairFilter  # the same in single precision
    preconditioner: PairFilter
    shift: RigidShift
    edge: float  # longer edge of a cell [m]


@dataclass(frozen=True, eq=False)
class SlipSolution:
    """Traction and motion of a step, with the error of the friction law."""

    traction: Floats  # [Pa], (2, nx, ny)
    motion: Floats  # shifts [m] and rotation [rad] in the step
    slip: Floats  # of the surface under the body in the step, 0 where cells stick [m], (2, nx, ny)
    way: Floats  # of the surface under the body in the step, of all cells [m], (2, nx, ny)
    state: Flags  # 0 open, 1 stick, 2 slip
    residual: float  # largest deviation of slip from the friction law over the displacement [-]
    duality_gap: float  # bound of the energy of the error over that of the step [-]
    displacement: float  # largest displacement in the step [m]
    iterations: int  # search directions
    convolutions: int  # of pairs of fields
    converged: bool
