"""Frictional problem of one time step: what is prescribed, and a traction with what it causes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.mechanics.contact.friction.discs import on_circle
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift, ShiftConstraints
from viscontact.mechanics.halfspace.mirrored_shear import MirroredShearFilter
from viscontact.mechanics.halfspace.shear_filter import ShearFilter

AnyShearFilter = ShearFilter | MirroredShearFilter

#: Traction that would hold a cell, over what friction carries, at which it is turned.
FAR_BEYOND = 1.5

#: Part of the friction of all cells that those have which are turned at once.
FEW = 0.05


@dataclass(frozen=True, eq=False)
class SlipProblem:
    """Coulomb friction in a step: slip w = J T q + D q + past - motion, w = -λ q, |q| <= μ p.

    Of a cell in contact the traction q minimises 1/2 q·(J T + D) q + q·past over the discs, under
    prescribed resultants, whose multipliers are the motion.
    """

    bound: Floats  # μ p at the end of the step [Pa], (nx, ny)
    past: Floats  # displacement in the step by earlier tractions [m], (2, nx, ny)
    compliance: float  # contact compliance J of the new traction [1/Pa]
    entry: Floats  # compliance D of cells that enter, xx, xy and yy [m/Pa], (3, nx, ny)
    constraints: ShiftConstraints
    displacement_scale: float  # least displacement that errors are relative to [m]

    def slip_before_shift(self, traction: Floats, unit_displacement: Floats) -> Floats:
        """Slip of the surface under a body that does not move [m], (2, nx, ny)."""
        x, y = traction
        xx, xy, yy = self.entry
        found: Floats = self.compliance * unit_displacement + self.past
        found[0] += xx * x + xy * y
        found[1] += xy * x + yy * y
        return found


@dataclass(frozen=True, eq=False)
class ShearBlock:
    """Operators of a block of cells."""

    convolution: AnyShearFilter  # T, traction to displacement per unit compliance
    search: AnyShearFilter  # the same in single precision
    preconditioner: AnyShearFilter
    shift: RigidShift
    edge: float  # longer edge of a cell [m]


@dataclass(frozen=True, eq=False)
class Directions:
    """Directions in which the traction of each cell may change at first order."""

    # Both in cells that stick, the tangent of the circle in those that slip, none without pressure.
    slips: Bools
    normal: Floats  # unit vectors along the traction of cells that slip, 0 elsewhere; (2, nx, ny)
    sticks: Bools
    pull: Floats  # λ of cells that slip [m], (nx, ny)

    def projected(self, fields: Floats) -> Floats:
        """Components along free directions."""
        along = (self.normal * fields).sum(axis=0)
        found = fields - self.normal * along
        found *= self.sticks | self.slips
        return np.asarray(found)

    @property
    def matrix(self) -> tuple[Floats, Floats, Floats]:
        """Entries xx, xy and yy of the projector of each cell."""
        x, y = self.normal
        held = self.sticks | self.slips
        return held - x * x, -x * y, held - y * y


def directions_of(problem: SlipProblem, traction: Floats, slip: Floats) -> Directions:
    """Free directions of a traction: cells on the circle that slip against it are held there."""
    reached = on_circle(traction, problem.bound)
    normal = np.divide(traction, problem.bound, out=np.zeros(traction.shape), where=reached)
    pull = -(normal * slip).sum(axis=0)
    slips = reached & (pull >= 0)
    return Directions(slips, normal * slips, (problem.bound > 0) & ~slips, pull * slips)


def turned(
    problem: SlipProblem, traction: Floats, slip: Floats, directions: Directions, own: Floats
) -> tuple[Floats, Directions]:
    """Turn tractions of few cells that slip far against what they hold; `own` is in [m/Pa].

    Where a cell has little pressure the traction that would hold it lies far beyond its circle, as
    judged by the compliance `own` of the cell alone. It is put on the circle in that direction.
    """
    bound = problem.bound
    holding = traction - slip / own
    size = np.hypot(*holding)
    turns = directions.sticks & (size > FAR_BEYOND * bound)
    # Many cells move each other: then their own compliance says nothing.
    if not turns.any() or bound[turns].sum() > FEW * bound.sum():
        return traction, directions
    normal = np.divide(holding, size, out=np.zeros(holding.shape), where=turns)
    pull = np.where(turns, (size - bound) * own, directions.pull)
    found = Directions(
        directions.slips | turns, directions.normal + normal, directions.sticks & ~turns, pull
    )
    return np.where(turns, normal * bound, traction), found


@dataclass(frozen=True, eq=False)
class SlipSolution:
    """Traction and motion of a step, with the error of the friction law."""

    traction: Floats  # [Pa], (2, nx, ny)
    motion: Floats  # shifts [m] and rotation [rad] in the step
    slip: Floats  # of the surface under the body in the step, 0 where cells stick [m], (2, nx, ny)
    state: Integers  # 0 open, 1 stick, 2 slip
    residual: float  # largest deviation of slip from the friction law over the displacement [-]
    duality_gap: float  # bound of the energy of the error over that of the step [-]
    displacement: float  # largest displacement in the step [m]
    iterations: int  # search directions
    convolutions: int  # of pairs of fields
    converged: bool
