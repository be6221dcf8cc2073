"""The contact problem of one instant: pressure >= 0, gap >= 0, one of them zero everywhere.

Minimise ½ p·Kc p + p·g over p >= 0 subject to the body's force and moment balances, by a
preconditioned conjugate-gradient iteration that treats bound and balances together. Multipliers
of the balances are the rigid motion: approach and tilts.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from viscontact.balance import RigidPlane, Support, bedding_pressure, restore_balance
from viscontact.convolution import Convolution, Preconditioner
from viscontact.grid import Grid

#: Iterations without a new best error after which a solve is called stagnant.
PATIENCE = 40

MAX_ITERATIONS = 400


@dataclass(frozen=True)
class HalfSpace:
    """A grid with the operators that live on it.

    Parameters
    ----------
    grid : Grid
        The cells that carry pressure and displacement.
    threads : int
        Threads of one transform.
    """

    grid: Grid
    threads: int = 1
    convolution: Convolution = field(init=False)
    preconditioner: Preconditioner = field(init=False)
    plane: RigidPlane = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "convolution", Convolution(self.grid, self.threads))
        object.__setattr__(self, "preconditioner", Preconditioner(self.grid, self.threads))
        object.__setattr__(self, "plane", RigidPlane(self.grid))


@dataclass(frozen=True)
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


@dataclass(frozen=True)
class Guess:
    """Where a solve starts.

    Attributes
    ----------
    pressure : ndarray, shape (nx, ny)
        Pressure [Pa]; negative values are cut off, balances restored.
    deflection : ndarray, shape (nx, ny)
        ``K pressure`` of that pressure, exactly [Pa m].
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad] along x and y.
    """

    pressure: NDArray[np.float64]
    deflection: NDArray[np.float64]
    motion: NDArray[np.float64]


@dataclass(frozen=True)
class ContactSolution:
    """What a solve found.

    Attributes
    ----------
    pressure, deflection : ndarray, shape (nx, ny)
        Pressure [Pa] and ``K pressure`` [Pa m], the latter by a fresh convolution.
    gap : ndarray, shape (nx, ny)
        Gap [m], +inf where the body has no surface.
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad].
    residual : float
        Largest gap under pressure or penetration elsewhere, over the largest displacement.
    iterations, convolutions : int
        Search directions used, and half-space convolutions spent.
    converged : bool
        Whether residual and balances are within the tolerance.
    """

    pressure: NDArray[np.float64]
    deflection: NDArray[np.float64]
    gap: NDArray[np.float64]
    motion: NDArray[np.float64]
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
        Start; an elastic bedding of about the right stiffness when left out.
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
    After Polonsky & Keer (1999), with these departures: a |q|/2 preconditioner, Polak-Ribiere+
    directions that are not reset when the contact set changes, the deflection updated along the
    direction instead of convolved again, and both moments balanced (in pressure itself: scaled
    variables lose convergence).

    References
    ----------
    I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206.
    """
    search = _Search(problem, half_space, guess)
    best, since_best = np.inf, 0
    while True:
        search.measure()
        good = search.error <= tolerance and search.imbalance <= tolerance
        if good and search.fresh:
            return search.solution(converged=True)
        if good:
            # Certify what is returned, not what the recurrence believes.
            search.convolve()
            continue
        since_best = 0 if search.error < best else since_best + 1
        best = min(best, search.error)
        if search.iterations >= max_iterations or since_best > PATIENCE:
            search.convolve()
            search.measure()
            return search.solution(converged=False)
        search.advance()


class _Search:
    """The iteration's working state; one pass of DESIGN's five steps is measure + advance."""

    def __init__(self, problem: ContactProblem, half_space: HalfSpace, guess: Guess | None) -> None:
        self.problem = problem
        self.half_space = half_space
        self.plane = half_space.plane
        self.cell_area = half_space.grid.cell_area
        self.iterations = 0
        self.convolutions = 0
        self.direction: NDArray[np.float64] | None = None
        self.residual: NDArray[np.float64] = np.zeros(half_space.grid.shape)
        self.slope = 1.0
        self._start(guess)

    def _start(self, guess: Guess | None) -> None:
        if guess is None:
            self.motion = self.problem.support.prescribed_motion()
            self.pressure = self._bedding()
            self.convolve()
            return
        self.motion = self.problem.support.with_prescribed(guess.motion)
        self.pressure, self.deflection, self.fresh = guess.pressure, guess.deflection, False
        self._keep_admissible()

    def _bedding(self) -> NDArray[np.float64]:
        problem = self.problem
        return bedding_pressure(
            problem.open_gap, problem.compliance, problem.support, self.half_space.grid, self.plane
        )

    def convolve(self) -> None:
        """Deflection of the present pressure, from scratch."""
        self.deflection = self.half_space.convolution.apply(self.pressure)
        self.convolutions += 1
        self.fresh = True

    def measure(self) -> None:
        """Step 1: rigid motion by least squares over the contact; gap; error; imbalance."""
        problem, plane = self.problem, self.plane
        self.contact = self.pressure > 0
        raw = problem.open_gap + problem.compliance * self.deflection
        gap = raw - plane.field(self.motion)
        correction = plane.fit(gap, self.contact, problem.support.free)
        self.motion = self.motion + correction
        self.gap = gap - plane.field(correction)
        self.scale = max(
            problem.displacement_scale, problem.compliance * float(self.deflection.max())
        )
        violation = np.where(self.contact, np.abs(self.gap), -self.gap)
        self.error = max(float(violation.max()), 0.0) / self.scale
        self.imbalance = problem.support.imbalance(
            plane.sums(self.pressure) * self.cell_area, plane.extent(self.contact)
        )

    def advance(self) -> None:
        """Steps 2 to 5: precondition, project, conjugate, step exactly, cut and rebalance."""
        self.iterations += 1
        active = self.contact | (self.gap < 0)
        residual = np.where(active, self.gap, 0.0)
        steepest = self._project(self.half_space.preconditioner.apply(residual), active)
        direction = -steepest
        if self.direction is not None:
            change = float(np.vdot(steepest, residual - self.residual))
            conjugacy = max(change / self.slope, 0.0)
            direction += conjugacy * self._project(self.direction, active)
        self.residual = residual
        self.slope = float(np.vdot(steepest, residual)) or 1.0
        self.direction = direction
        self._step(residual, direction)

    def _project(
        self, vector: NDArray[np.float64], active: NDArray[np.bool_]
    ) -> NDArray[np.float64]:
        """Remove from a direction what would change the resultants."""
        vector = np.where(active, vector, 0.0)
        rigid = self.plane.fit(vector, active, self.problem.support.free)
        return np.where(active, vector - self.plane.field(rigid), 0.0)

    def _step(self, residual: NDArray[np.float64], direction: NDArray[np.float64]) -> None:
        change = self.half_space.convolution.apply(direction)
        self.convolutions += 1
        curvature = self.problem.compliance * float(np.vdot(direction, change))
        if curvature <= 0:
            self.direction = None
            return
        length = -float(np.vdot(residual, direction)) / curvature
        self.pressure = self.pressure + length * direction
        self.deflection = self.deflection + length * change
        self.fresh = False
        self._keep_admissible()

    def _keep_admissible(self) -> None:
        """Step 5's second half: no tension, balances kept; convolve only if that changed it."""
        support = self.problem.support
        if float(self.pressure.min()) >= 0 and self._balanced():
            return
        pressure = np.maximum(self.pressure, 0.0)
        pressure = np.where(np.isfinite(self.problem.open_gap), pressure, 0.0)
        restored = restore_balance(pressure, support, self.plane, self.cell_area)
        self.pressure = self._bedding() if restored is None else restored
        self.convolve()

    def _balanced(self) -> bool:
        sums = self.plane.sums(self.pressure) * self.cell_area
        return self.problem.support.imbalance(sums, self.plane.extent(self.pressure > 0)) < 1e-12

    def solution(self, *, converged: bool) -> ContactSolution:
        return ContactSolution(
            self.pressure,
            self.deflection,
            self.gap,
            self.motion,
            self.error,
            self.iterations,
            self.convolutions,
            converged,
        )
