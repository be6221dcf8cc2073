"""Tractions of a body that rolls in steady motion, by a semismooth Newton method.

In coordinates of the body the material comes in at the leading edge. In the way d of one cell along
the motion a cell slips by

    w = A q + c,    A q = T q - (T q one cell ahead) + D q,    c = creepages times d,

along the motion and, of a body that is askew or spins, across it, with the displacement T q of
tractions that move (`moving_shear`) and the compliance D of cells that enter (`entry`). Coulomb's
law is q = P(q - w/r), with the projection P on the discs |q| <= μ p and any r > 0 in each cell:
that of its own displacement, with D. Newton's method on this equation finds sticking cells, whose
slip is brought to zero, and slipping ones, which stay on their circles, at once. A is not
symmetric: its waves are shifted by a quarter of their length. GMRES solves the linear systems. It
is preconditioned by the sum of the residuals over sticking cells from the cell
ahead of them on, which is the inverse of the difference, and the inverse of T.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Field, Flags, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.discs import lengths
from viscontact.mechanics.contact.krylov import gmres, norm
from viscontact.mechanics.halfspace.shear_filter import PairFilter

#: Newton steps from one start.
MAX_STEPS = 40

#: Vectors of GMRES, and the part of the residual that it leaves.
MAX_VECTORS, LEFT = 80, 1e-2

#: Parts of a step that are tried in turn until one lowers the norm of the deviation from the law by
#: some of what the step promises; without them sets of cells may go around in circles.
PARTS, LEAST_GAIN = (1.0, 0.5, 0.25, 0.12, 0.06, 0.03), 0.1

#: Residual within the circles over that of the search, which has been accepted.
ACCEPTED = 10.0

#: Residual of the linear system that is accurate enough, as a part of the tolerance.
INNER_TOLERANCE = 0.1


@dataclass(frozen=True, eq=False)
class RollingProblem:
    """Coulomb friction under a body that rolls, on a block of cells around the contact."""

    in_contact: Bools  # cells that carry tractions, (nx, ny)
    bound: Floats  # μ p there, 0 elsewhere [Pa], (nx, ny)
    entry: Floats  # compliance D of cells that enter, xx, xy and yy [m/Pa], (3, nx, ny)
    own: float  # displacement of a cell by its own unit traction [m/Pa]
    way: float  # of one cell along the motion [m]
    axis: int  # of the motion, towards +
    convolution: PairFilter  # T [m/Pa]
    preconditioner: PairFilter  # approximate inverse of T
    #: Slip over the way of a cell by the pressure of coupled bodies [m], (2, nx, ny).
    stretch: Floats | None = None
    #: Further slip over the way of a body without tractions, as across it and by spin [-].
    askew: Floats | None = None  # (2, 1, 1) or of cells

    @cached_property
    def reference(self) -> Floats:
        """Compliance r that slip is compared with tractions by [m/Pa]."""
        return np.asarray(self.own + self.entry[0] + self.entry[2])

    def ahead(self, field: Field) -> Field:
        """Values one cell ahead; the last cells of a block are open."""
        return np.roll(field, -1, axis=field.ndim - 2 + self.axis)

    def difference(self, traction: Floats) -> Floats:
        """Slip by tractions over the way of a cell, without creepage and entry [m], (2, nx, ny)."""
        moved = self.convolution.apply(traction)
        return np.asarray(moved - self.ahead(moved))

    def entering(self, traction: Floats) -> Floats:
        """Slip of cells that enter that is left out, as they were free: D q [m], (2, nx, ny)."""
        (x, y), (xx, xy, yy) = traction, self.entry
        return np.stack([xx * x + xy * y, xy * x + yy * y])

    def change(self, traction: Floats) -> Floats:
        """A q [m], (2, nx, ny)."""
        return self.difference(traction) + self.entering(traction)

    def drift(self, creepage: float) -> Floats:
        """Slip over the way of a cell of a body without tractions [m], (2, 1, 1) or of cells."""
        found = np.asarray(self.way * self.creep(creepage))
        return found if self.stretch is None else found + self.stretch

    def creep(self, creepage: float) -> Floats:
        """Slip over the way of a body without tractions [-], (2, 1, 1) or of cells."""
        found = creepage * np.eye(2)[self.axis][:, None, None]
        return np.asarray(found if self.askew is None else found + self.askew)

    def summed(self, field: Floats, sticks: Bools) -> Floats:
        """Sums over sticking cells, from the next cell ahead that does not stick on."""
        lines = np.flip(np.moveaxis(field * sticks, 1 + self.axis, -1), -1)
        held = np.flip(np.moveaxis(sticks, self.axis, -1), -1)
        total = np.cumsum(lines, axis=-1)
        last = np.maximum.accumulate(np.where(held, -1, np.arange(held.shape[-1])), axis=-1)
        before = np.take_along_axis(total, np.broadcast_to(np.maximum(last, 0), total.shape), -1)
        found = (total - np.where(last < 0, 0.0, before)) * held
        return np.moveaxis(np.flip(found, -1), -1, 1 + self.axis)


@dataclass(frozen=True, eq=False)
class RollingSolution:
    """Tractions under a creepage, with the slip in the way of one cell."""

    traction: Floats  # [Pa], (2, nx, ny)
    slip: Floats  # of cells that slip, 0 elsewhere [m], (2, nx, ny)
    change: Floats  # of the displacement of the surface over the way [m], (2, nx, ny)
    state: Flags  # 0 open, 1 stick, 2 slip
    residual: float  # of the friction law, over the largest slip [-]
    iterations: int
    convolutions: int
    converged: bool


def solve_rolling(
    problem: RollingProblem, creepage: float, start: Floats, *, tolerance: float
) -> RollingSolution:
    """Solve for the tractions under a creepage, from a guess; else from none and from sliding."""
    creep = problem.creep(creepage)
    size = lengths(creep)
    slid = -creep / np.where(size > 0, size, 1.0) * problem.bound
    best: RollingSolution | None = None
    for guess in (start, np.zeros(start.shape), slid):
        found = _search(problem, creepage, guess, tolerance)
        if best is None or found.residual < best.residual:
            best = found
        if found.converged:
            break
    assert best is not None
    return best


@dataclass(frozen=True, eq=False)
class _Judged:
    """Deviation F = q - P(q - w/r) of a traction from the friction law."""

    slip: Floats  # w [m]
    traction: Floats  # P(q - w/r) [Pa]
    deviation: Floats  # F [Pa]
    normal: Floats  # directions of cells that slip, 0 elsewhere
    excess: Floats  # |q - w/r|/(μ p) - 1 of cells that slip [-]
    slips: Bools
    norm: float  # of r F [m]
    residual: float  # largest r |F| over the largest slip [-]


def _judge(problem: RollingProblem, traction: Floats, slip: Floats, creep: float) -> _Judged:
    wanted = traction - slip / problem.reference
    size, held, bound = lengths(wanted), problem.in_contact, problem.bound
    slips = held & (size >= bound)
    none = np.zeros(wanted.shape)
    normal = np.divide(wanted, size, out=none, where=slips)
    excess = np.divide(size, bound, out=np.ones(bound.shape), where=slips) - 1
    projected = np.where(slips, normal * bound, wanted * held)
    deviation = (traction - projected) * held
    largest = max(float(lengths(slip).max(initial=0.0, where=held)), creep)
    off = lengths(deviation) * problem.reference
    residual = float(off.max()) / largest
    return _Judged(slip, projected, deviation, normal, excess, slips, norm(off.ravel()), residual)


def _search(
    problem: RollingProblem, creepage: float, start: Floats, tolerance: float
) -> RollingSolution:
    """Newton's method from one guess."""
    drift = problem.drift(creepage)
    creep = float(lengths(problem.creep(creepage)).max()) * problem.way
    if problem.stretch is not None:
        creep = float(lengths(drift).max())
    traction = start * problem.in_contact
    found = _judge(problem, traction, problem.change(traction) + drift, creep)
    steps, convolutions = 0, 1
    while found.residual > tolerance and steps < MAX_STEPS:
        goal = max(LEFT, INNER_TOLERANCE * tolerance / found.residual)
        step, spent = _newton_step(problem, found, goal)
        # Tractions are not cut off at their circles: what is beyond tells the next cells that slip.
        moved, norm_before = problem.change(step), found.norm
        trials = []
        for part in PARTS:
            trial = traction + part * step
            judged = _judge(problem, trial, found.slip + part * moved, creep)
            trials.append((judged.norm, part, trial, judged))
            if judged.norm < (1 - LEAST_GAIN * part) * norm_before:
                break
        _, _, traction, found = min(trials, key=lambda each: each[:2])
        steps, convolutions = steps + 1, convolutions + spent + 1
    # By fresh convolutions, of what lies within the circles.
    traction, slips = found.traction, found.slips
    change = problem.difference(traction)
    slip = change + problem.entering(traction) + drift
    residual = _judge(problem, traction, slip, creep).residual
    return RollingSolution(
        traction,
        slip * slips,
        change,
        (problem.in_contact.astype(np.int8) + slips).astype(np.int8),
        residual,
        steps,
        convolutions + 1,
        found.residual <= tolerance and residual <= ACCEPTED * tolerance,
    )


def _newton_step(problem: RollingProblem, found: _Judged, goal: float) -> tuple[Floats, int]:
    """Change of the traction that solves the linearised law, and the convolutions spent."""
    # Normal to its circle a slipping cell returns to it. Sticking cells, and tangents of slipping
    # ones, follow from A dq + λ dq = -w there, with λ = r (|q - w/r|/(μ p) - 1).
    normal, slips = found.normal, found.slips
    sticks = problem.in_contact & ~slips
    curvature = problem.reference * found.excess

    def free(field: Floats) -> Floats:
        return np.asarray((field - normal * (normal * field).sum(axis=0)) * problem.in_contact)

    back = -normal * (normal * found.deviation).sum(axis=0)
    wanted = np.where(
        slips, -(problem.reference * (1 + found.excess)) * found.deviation, -found.slip
    )
    right = free(wanted - problem.change(back))

    def preconditioned(field: Floats) -> Floats:
        held = problem.preconditioner.apply(problem.summed(field, sticks)) * sticks
        return free(held + np.where(slips, field / (curvature + problem.own), 0.0))

    step, vectors = _solved(
        lambda each: free(problem.change(each) + curvature * each), preconditioned, right, goal
    )
    return step + back, vectors + 1


def _solved(
    apply: Callable[[Floats], Floats],
    preconditioned: Callable[[Floats], Floats],
    right: Floats,
    goal: float,
) -> tuple[Floats, int]:
    """Solution of a linear system to a part of its right side, and the number of vectors."""
    directions: list[Floats] = []

    def image(vector: Floats) -> Floats:
        direction = preconditioned(vector.reshape(right.shape))
        directions.append(direction)
        return apply(direction).ravel()

    flat = right.ravel()
    factors, number = gmres(image, flat, goal * norm(flat), MAX_VECTORS)
    step = np.zeros(right.shape)
    for factor, direction in zip(factors, directions, strict=False):
        step += factor * direction
    return step, number
