"""Residual of the friction law, and the duality gap, which bounds the error of the traction."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.directions import Directions, reached_circles
from viscontact.mechanics.contact.friction.discs import lengths
from viscontact.mechanics.contact.friction.problem import SlipProblem
from viscontact.mechanics.contact.friction.rigid_shift import (
    RigidShift,
    ShiftConstraints,
    pseudo_inverse,
)


@dataclass(frozen=True, eq=False)
class SlipResidual:
    """Slip under a traction with the rigid motion that fits best, and its errors."""

    traction: Floats  # q [Pa], (2, nx, ny)
    motion: Floats
    unit_displacement: Floats  # T q, that of a unit compliance, with earlier tractions [Pa m]
    before: Floats  # slip under a body that does not move [m], (2, nx, ny)
    slip: Floats  # w [m], (2, nx, ny)
    along: Floats  # its components along free directions [m]
    directions: Directions
    error: float  # largest deviation from the friction law over the largest displacement [-]
    given: float  # work of the resultants on prescribed motions over the area of a cell [Pa m]
    displacement: float  # largest displacement, which errors are relative to [m]

    def rise_since(self, other: SlipResidual) -> float:
        """What the solution minimises, less that of another traction [Pa m]."""
        # Exact for a quadratic function, whose gradient is the slip under a body at rest.
        change = _product(self.traction - other.traction, self.before + other.before)
        return change / 2 - (self.given - other.given)

    @property
    def work(self) -> float:
        """Size of what the solution minimises, about [Pa m]."""
        return abs(_product(self.traction, self.before) / 2 - self.given)


def slip_residual(
    problem: SlipProblem,
    shift: RigidShift,
    traction: Floats,
    unit_displacement: Floats,
    guess: Floats | None = None,
) -> SlipResidual:
    """Fit the motion by least squares over the free directions, and judge the slip that is left.

    A guess of the motion tells which cells slip; without one all do that have reached their circle.
    """
    before = problem.slip_before_shift(traction, unit_displacement)
    constraints = problem.constraints
    motion = constraints.motions if guess is None else guess
    circles = reached_circles(problem, traction)
    slip = before - shift.field(motion)
    if constraints.free.any():
        directions = circles.directions(-traction if guess is None else slip)
        motion = motion + _fitting(constraints, shift, slip, directions)
    rigid = shift.field(motion)
    slip = before - rigid
    directions = circles.directions(slip)
    along = directions.projected(slip)
    held = problem.held
    largest = max(_largest(before, held), _largest_shift(motion, rigid, held))
    scale = max(problem.displacement_scale, largest)
    given = 0.0
    if constraints.motions.any():
        given = float(shift.resultants(traction) @ constraints.motions) / shift.cell_area
    return SlipResidual(
        traction,
        motion,
        unit_displacement,
        before,
        slip,
        along,
        directions,
        error=_largest(along) / scale,
        given=given,
        displacement=scale,
    )


def _fitting(
    constraints: ShiftConstraints, shift: RigidShift, slip: Floats, directions: Directions
) -> Floats:
    """Change of the motion that leaves the least slip along free directions."""
    gram = shift.gram(*directions.matrix) * shift.cell_area
    lacking = shift.resultants(directions.projected(slip))
    # As a correction, so that a motion that no cell determines is unchanged.
    return pseudo_inverse(gram, constraints.free, constraints.arm) @ lacking


def _largest_shift(motion: Floats, rigid: Floats, cells: Floats) -> float:
    """Largest length of a rigid motion in some cells."""
    if motion[2] or not cells.any():
        return _largest(rigid, cells)
    return float(lengths(motion[:2]))


def _largest(pairs: Floats, cells: Floats | None = None) -> float:
    """Largest length of pairs in some cells, of which a field is 1."""
    x, y = pairs
    squares = x * x + y * y
    return math.sqrt(float((squares if cells is None else squares * cells).max()))


def _product(one: Floats, other: Floats) -> float:
    """Sum of products over all components and cells."""
    # Not as a product of vectors: BLAS would start threads.
    return float(np.einsum("kij,kij->", one, other))


def duality_gap(problem: SlipProblem, traction: Floats, slip: Floats, scale: float) -> float:
    """Σ (μ p |w| + q·w) over the work of all friction on the largest displacement [-]."""
    # Primal less dual objective of the convex problem: it is not negative, is zero at the solution
    # only, and bounds 1/2 (q - q*)·(J T + D) (q - q*).
    found = float((problem.bound * lengths(slip)).sum()) + _product(traction, slip)
    most = float(problem.bound.sum()) * scale
    return max(found, 0.0) / most if most > 0 else 0.0
