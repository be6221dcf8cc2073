"""The contact problem of one instant: pressure >= 0, gap >= 0, one of them zero everywhere.

Minimise ½ p·Kc p + p·g over p >= 0 subject to the body's force and moment balances, by a
preconditioned conjugate-gradient iteration that treats bound and balances together. Multipliers
of the balances are the rigid motion: approach and tilts. The search runs on the contact's own
patch of the grid; what it finds is checked on the whole.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.balance import Support, restore_balance
from viscontact.bedding import settle_on_bedding
from viscontact.half_space import HalfSpace, Patch

#: Iterations without a new best error after which a search is called stagnant.
PATIENCE = 40

MAX_ITERATIONS = 400

#: Rounds of search and check. A second one is due where a contact outgrows its patch, or where the
#: tolerance asks for more than single precision gives in one.
MAX_ROUNDS = 20

#: Moments and force of a guess within this are as good as balanced.
BALANCED = 1e-12


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
    support : Support
        What holds the body: resultants or motions.
    displacement_scale : float
        Smallest displacement that errors are measured against [m].
    """

    open_gap: NDArray[np.float64]
    compliance: float
    support: Support
    displacement_scale: float

    def within(self, patch: Patch) -> ContactProblem:
        """The same problem on a patch."""
        return replace(self, open_gap=patch.cut(self.open_gap))


@dataclass(frozen=True, eq=False)
class Guess:
    """A pressure, what it does, and the body's rigid motion.

    Attributes
    ----------
    pressure : ndarray, shape (nx, ny)
        Pressure [Pa].
    deflection : ndarray, shape (nx, ny)
        ``K pressure`` of that pressure [Pa m].
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad] along x and y.
    """

    pressure: NDArray[np.float64]
    deflection: NDArray[np.float64]
    motion: NDArray[np.float64]

    def within(self, patch: Patch) -> Guess:
        """The part on a patch."""
        return Guess(patch.cut(self.pressure), patch.cut(self.deflection), self.motion)


@dataclass(frozen=True, eq=False)
class ContactSolution:
    """What a solve found.

    Attributes
    ----------
    found : Guess
        Pressure, deflection by a fresh convolution, and rigid motion.
    gap : ndarray, shape (nx, ny)
        Gap [m], +inf where the body has no surface.
    residual : float
        Largest gap under pressure or penetration elsewhere, over the largest displacement.
    iterations, convolutions : int
        Search directions used, and convolutions (on patches or the whole grid) spent.
    converged : bool
        Whether residual and balances are within the tolerance.
    """

    found: Guess
    gap: NDArray[np.float64]
    residual: float
    iterations: int
    convolutions: int
    converged: bool


def solve_contact(
    problem: ContactProblem,
    half_space: HalfSpace,
    guess: Guess | None = None,
    *,
    tolerance: float = 1e-6,
    max_iterations: int = MAX_ITERATIONS,
) -> ContactSolution:
    """Pressure and rigid motion that satisfy contact and balance.

    Parameters
    ----------
    problem : ContactProblem
        Gap, compliance and support.
    half_space : HalfSpace
        Grid and operators.
    guess : Guess, optional
        Start; its deflection must belong to its pressure. Negative pressure is cut off, balances
        are restored. A bedding of about the right stiffness when left out.
    tolerance : float
        Bound on the relative residual of the returned pressure, and on the balances.
    max_iterations : int
        Give up after this many search directions.

    Returns
    -------
    ContactSolution
        With ``converged`` False if the iteration stagnated or ran out.

    Notes
    -----
    After Polonsky & Keer (1999), with these departures: a preconditioner, Polak-Ribiere+
    directions that are not reset when the contact set changes, the deflection updated along the
    direction instead of convolved again, and both moments balanced (in pressure itself: scaled
    variables lose convergence).

    References
    ----------
    I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206.
    """
    starts = (guess, None) if guess is not None else (None,)
    for start in starts:
        # A guess can be worse than none, after a load has changed beyond recognition.
        first = _bedding(problem, half_space) if start is None else start
        solution = _solve_from(first, problem, half_space, tolerance, max_iterations)
        if solution.converged:
            break
    return solution


def _solve_from(
    start: Guess,
    problem: ContactProblem,
    half_space: HalfSpace,
    tolerance: float,
    max_iterations: int,
) -> ContactSolution:
    """Search on patches until the whole grid agrees."""
    cells = start.pressure > 0
    iterations = convolutions = 0
    error = np.inf
    for _ in range(MAX_ROUNDS):
        patch = half_space.patch_around(cells)
        search = Search(problem.within(patch), patch, start.within(patch))
        search.run(tolerance, max_iterations - iterations)
        iterations += search.iterations
        convolutions += search.convolutions + 1
        # Certify what is returned, by a fresh convolution: not what the recurrence believes.
        pressure = patch.embed(search.now.pressure, half_space.shape)
        start = replace(
            search.now, pressure=pressure, deflection=half_space.convolution.apply(pressure)
        )
        checked = measure(problem, half_space.whole, start)
        start = replace(start, motion=checked.motion)
        converged = checked.error <= tolerance and _is_balanced(
            problem, half_space, pressure, tolerance
        )
        stagnant = search.gave_up and checked.error > error / 2
        if converged or stagnant or iterations >= max_iterations:
            break
        error = checked.error
        cells = (pressure > 0) | (checked.gap < 0)
    return ContactSolution(start, checked.gap, checked.error, iterations, convolutions, converged)


def _is_balanced(
    problem: ContactProblem,
    half_space: HalfSpace,
    pressure: NDArray[np.float64],
    tolerance: float,
) -> bool:
    whole = half_space.whole
    off = problem.support.imbalance(whole.plane.sums(pressure) * whole.cell_area, whole.arm)
    return off <= tolerance


@dataclass(frozen=True, eq=False)
class Measure:
    """How far a pressure is from equilibrium.

    Attributes
    ----------
    contact : ndarray of bool
        Cells under pressure.
    inverse_gram : ndarray, shape (3, 3)
        Of the planes over these cells.
    motion : ndarray, shape (3,)
        Rigid motion that fits best.
    gap : ndarray
        Gap with that motion [m].
    gap_in_contact : ndarray
        The same under pressure, zero elsewhere [m].
    error : float
        Largest gap under pressure or penetration elsewhere, over the largest displacement.
    """

    contact: NDArray[np.bool_]
    inverse_gram: NDArray[np.float64]
    motion: NDArray[np.float64]
    gap: NDArray[np.float64]
    gap_in_contact: NDArray[np.float64]
    error: float


def measure(problem: ContactProblem, patch: Patch, now: Guess) -> Measure:
    """Step 1: rigid motion by least squares over the contact, the gap, and its errors.

    Parameters
    ----------
    problem : ContactProblem
        Gap, compliance and support.
    patch : Patch
        The cells.
    now : Guess
        Pressure and deflection.

    Returns
    -------
    Measure
        Gap and error.
    """
    contact = now.pressure > 0
    gap = problem.compliance * now.deflection
    scale = max(problem.displacement_scale, float(gap.max()))
    gap += problem.open_gap
    gap -= patch.plane.field(now.motion)
    gap_in_contact = np.where(contact, gap, 0.0)
    weight = contact.astype(float)
    inverse = patch.plane.inverse_gram(weight, problem.support.free)
    # A correction, so that a motion the contact does not determine stays as it was.
    correction = inverse @ patch.plane.sums(gap_in_contact)
    plane = patch.plane.field(correction)
    gap -= plane
    gap_in_contact -= np.multiply(plane, weight, out=plane)
    error = max(float(gap_in_contact.max()), -float(gap.min()), 0.0) / scale
    return Measure(contact, inverse, now.motion + correction, gap, gap_in_contact, error)


class Search:
    """The iteration on one patch, with its working state.

    Parameters
    ----------
    problem : ContactProblem
        The problem on the patch.
    patch : Patch
        The cells.
    start : Guess
        Where it starts, on the patch.
    """

    def __init__(self, problem: ContactProblem, patch: Patch, start: Guess) -> None:
        self.problem, self.patch = problem, patch
        self.iterations = self.convolutions = 0
        self.now = replace(start, motion=problem.support.with_prescribed(start.motion))
        self._active = np.zeros(0, dtype=bool)
        self._residual = self._direction = np.zeros(0)
        self._slope = 0.0
        self.gave_up = not (self._is_admissible() or self._make_admissible())

    def run(self, tolerance: float, max_iterations: int) -> None:
        """Iterate until the tolerance is met, or no progress is made.

        Parameters
        ----------
        tolerance : float
            Bound on the relative residual.
        max_iterations : int
            Most search directions.
        """
        best, since_best = np.inf, 0
        while not self.gave_up:
            checked = measure(self.problem, self.patch, self.now)
            self.now = replace(self.now, motion=checked.motion)
            if checked.error <= tolerance:
                return
            since_best = 0 if checked.error < best else since_best + 1
            best = min(best, checked.error)
            self.gave_up = self.iterations >= max_iterations or since_best > PATIENCE
            if not self.gave_up:
                self._advance(checked)

    def _advance(self, checked: Measure) -> None:
        """Steps 2 to 5: precondition, project, conjugate, step exactly, cut and rebalance."""
        released = checked.gap < 0
        released &= ~checked.contact
        active, residual, inverse = checked.contact, checked.gap_in_contact, checked.inverse_gram
        if released.any():
            active = active | released
            residual = np.where(active, checked.gap, 0.0)
            inverse = self.patch.plane.inverse_gram(active.astype(float), self.problem.support.free)
        direction = self._project(self.patch.preconditioner.apply(residual), active, inverse)
        slope = _inner(direction, residual)
        if self._slope > 0:
            change = slope - _inner(direction, self._residual)
            before = self._direction
            if not np.array_equal(active, self._active):
                before = self._project(before, active, inverse)
            # The sign: directions lead downhill, the preconditioned residual uphill.
            direction -= max(change / self._slope, 0.0) * before
        self._active, self._residual, self._slope = active, residual, slope
        self._direction = np.negative(direction, out=direction)
        self.iterations += 1
        self._step()

    def _project(
        self, vector: NDArray[np.float64], active: NDArray[np.bool_], inverse: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Remove from a direction what lies outside the active cells or changes resultants."""
        plane = self.patch.plane
        vector = np.where(active, vector, 0.0)
        rigid = plane.field(inverse @ plane.sums(vector))
        vector -= np.multiply(rigid, active, out=rigid)
        return vector

    def _step(self) -> None:
        """Step 4 and 5: to the least energy along the direction, then cut and rebalance."""
        direction, before = self._direction, self.now
        change = self.patch.convolution.apply(direction)
        self.convolutions += 1
        curvature = self.problem.compliance * _inner(direction, change)
        if curvature <= 0:
            self._slope = 0.0
            return
        length = -_inner(self._residual, direction) / curvature
        self.now = _moved(before, length, direction, change)
        if float(self.now.pressure.min()) >= 0 or self._make_admissible():
            return
        # What is left after the cut cannot be balanced: go only as far as nothing is cut.
        falling = length * direction < 0
        room = before.pressure[falling] / -(length * direction[falling])
        self.now = _moved(before, length * float(room.min()), direction, change)
        self._slope = 0.0

    def _is_admissible(self) -> bool:
        sums = self.patch.plane.sums(self.now.pressure) * self.patch.cell_area
        off = self.problem.support.imbalance(sums, self.patch.arm)
        return float(self.now.pressure.min()) >= 0 and off < BALANCED

    def _make_admissible(self) -> bool:
        """Cut off tension and restore the balances; whether that could be done."""
        problem, patch = self.problem, self.patch
        pressure = np.where(np.isfinite(problem.open_gap), self.now.pressure, 0.0)
        restored = restore_balance(
            np.maximum(pressure, 0.0), problem.support, patch.plane, patch.cell_area, patch.arm
        )
        if restored is None:
            return False
        change = patch.convolution.apply(restored - self.now.pressure)
        self.now = replace(self.now, pressure=restored, deflection=self.now.deflection + change)
        self.convolutions += 1
        return True


def _moved(
    now: Guess, length: float, direction: NDArray[np.float64], change: NDArray[np.float64]
) -> Guess:
    return replace(
        now,
        pressure=now.pressure + length * direction,
        deflection=now.deflection + length * change,
    )


def _inner(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    # Not a dot product of BLAS, which would put threads to work.
    return float(np.einsum("ij,ij->", a, b))


def _bedding(problem: ContactProblem, half_space: HalfSpace) -> Guess:
    whole = half_space.whole
    pressure, motion = settle_on_bedding(
        problem.open_gap, problem.compliance, problem.support, whole.plane, whole.cell_area
    )
    return Guess(pressure, half_space.convolution.apply(pressure), motion)
