"""The one loop over time: from an indenter, a material and a load to states."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.balance import Support
from viscontact.contact import ContactSolution, solve_contact
from viscontact.contact_problem import ContactProblem, Guess
from viscontact.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.grid import Grid
from viscontact.half_space import HalfSpace
from viscontact.indenters import Indenter
from viscontact.load import ForceHistory, LoadPoint
from viscontact.material import Material
from viscontact.memory import Memory, Response
from viscontact.observation import Instant, Observer
from viscontact.prediction import POINTS, Twin, predict
from viscontact.run import Run, prepare_run
from viscontact.schedule import Step, schedule
from viscontact.state import ContactState, Outcome

#: Errors are measured against the displacement that the pressure causes, but never against less
#: than this part of the largest displacement of the past: below it rounding would have a say.
HISTORY_COUNTS = 1e-3

#: Samples each way within a cell when the body's lowest point is looked for; even, so that a
#: point on a cell's edge or corner is among them.
TOUCH_SAMPLES = 16

#: Called after each instant asked for: the state, how many are done, how many there are.
Progress = Callable[[ContactState, int, int], None]


def march(
    indenter: Indenter,
    material: Material,
    load: ForceHistory,
    grid: Grid | None = None,
    times: ArrayLike | None = None,
    *,
    indenter_material: Material | None = None,
    tolerance: float = 1e-6,
    fields: str | Sequence[float] = "all",
    threads: int = 1,
    progress: Progress | None = None,
) -> Iterator[ContactState]:
    """Press an indenter on a creeping half-space and yield the state at each instant.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material
        Material of the half-space.
    load : ForceHistory
        Force, eccentricity and prescribed tilts over time.
    grid : Grid, optional
        Cells that carry the pressure; `auto_grid` chooses when left out.
    times : array_like, optional
        Instants of the states, strictly increasing, none before 0 [s]; chosen from load and
        law when left out. At a jump the state is the one just after it.
    indenter_material : Material, optional
        Material of the indenter; rigid when left out.
    tolerance : float
        Relative error of gap and balances at every instant.
    fields : str or sequence of float
        As in `simulate`, checked but not needed here: states carry their fields.
    threads : int
        Threads of one Fourier transform.
    progress : callable, optional
        Called with (state, done, total) after each instant.

    Returns
    -------
    iterator of ContactState
        All checks of the input are done before it is returned.

    Raises
    ------
    ValueError
        If an argument makes no sense, with a remedy; before the first step.
    ConvergenceError
        If the contact solver stagnates, from the iterator.
    DomainError
        If pressure reaches the outermost cells, or the largest contact has fewer than four
        cells across; from the iterator.

    Notes
    -----
    Steps also end at the load's kinks and jumps. Within a step the pressure is linear in time,
    so the error falls with the square of the step; the paper's piecewise-constant rule (Spinu &
    Cerlinca 2018, eq. 12) is of first order. Over steps long against the law (always, if it has
    no instant compliance) the pressure rises over a part of the step only, lest it ring, and the
    error is of first order; an `AccuracyWarning` says so where it matters.

    Examples
    --------
    A sphere on an elastic half-space, E* = 4/3 MPa, R = 0.75 m, sinks like Hertz's:

    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6 / 3), poisson_ratio=0.5)
    >>> grid = vc.Grid((40, 40), (0.26, 0.26))
    >>> states = vc.march(vc.Paraboloid(0.75, 0.75), rubber, vc.step(2370.0), grid, [0.0])
    >>> round(next(states).approach, 4)
    0.0133
    """
    run = prepare_run(
        indenter,
        material,
        load,
        grid,
        times,
        indenter_material=indenter_material,
        tolerance=tolerance,
        fields=fields,
        threads=threads,
    )
    return march_run(run, progress)


def march_run(run: Run, progress: Progress | None = None) -> Iterator[ContactState]:
    """Yield the states of a run that has been checked.

    Parameters
    ----------
    run : Run
        From `prepare_run`.
    progress : callable, optional
        Called with (state, done, total) after each instant.

    Yields
    ------
    ContactState
        One for each of the run's instants.

    Raises
    ------
    ConvergenceError, DomainError
        As in `march`.
    """
    observer = Observer(run)
    total, done = len(run.times), 0
    for step, instant in _instants(run):
        state = observer.observe(step, instant)
        if step.asked is not None:
            done += 1
            state = observer.judge(state, last=done == total)
            for text in state.warnings:
                warnings.warn(text, AccuracyWarning, stacklevel=2)
            if progress is not None:
                progress(state, done, total)
            yield state
        if instant.outcome is Outcome.NOT_CONVERGED:
            raise ConvergenceError(_not_converged(run, step, instant))
    observer.refuse_coarse_mesh()


def _instants(run: Run) -> Iterator[tuple[Step, Instant]]:
    """Solve step after step; what the body remembers is all in the two memories."""
    half_space = HalfSpace(run.grid, mirrored=run.is_mirrored, threads=run.threads)
    shape = half_space.fold(run.open_gap)
    memory = Memory(run.compliance, (2, *half_space.shape))  # of pressure and of deflection
    force_memory = Memory(run.compliance, (1,))
    scale = 1e-12 * max(run.grid.cell_size)
    past: list[Twin] = []
    motion = np.zeros(3)
    for step in schedule(run.times, run.load):
        response, force_response = (
            each.jump() if step.is_jump else each.ramp(step.duration)
            for each in (memory, force_memory)
        )
        point = run.load.at(step.time, side=step.side)
        force = np.array([point.force])
        twin_force = float(force_response.of(force)[0])
        support = half_space.share(Support.of(point))
        problem = ContactProblem(shape + response.history[1], response.compliance, support, scale)
        past = past[-POINTS:] if step.smooth else past[-1:]
        if point.force > 0:
            guess = _guess(predict(past, step.time, twin_force), response)
            solution = solve_contact(problem, half_space, guess, tolerance=run.tolerance)
        else:
            solution = _apart(problem, half_space, motion)
            if not response.history[1].any():
                solution = _before_first_touch(run, solution)
        values = np.stack([solution.found.pressure, solution.found.deflection])
        motion = solution.found.motion
        twin = Twin(step.time, twin_force, response.of(values), motion)
        past = [*([] if step.is_jump else past), twin] if point.force > 0 else []
        memory.accept(values)
        force_memory.accept(force)
        instant = _whole(half_space, solution, twin, _outcome(point, solution), response.resolved)
        scale = max(scale, HISTORY_COUNTS * float(instant.displacement.max()))
        _refuse_rim(run, step, instant)
        yield step, instant


def _outcome(point: LoadPoint, solution: ContactSolution) -> Outcome:
    if point.force == 0:
        return Outcome.NO_CONTACT
    return Outcome.CONVERGED if solution.converged else Outcome.NOT_CONVERGED


def _guess(twin: Twin | None, response: Response) -> Guess | None:
    """From a predicted twin back to the pressure and the deflection that would bring it about."""
    if twin is None:
        return None
    pressure, deflection = (twin.fields - response.history) / response.compliance
    return Guess(pressure, deflection, twin.motion)


def _apart(
    problem: ContactProblem, half_space: HalfSpace, motion: NDArray[np.float64]
) -> ContactSolution:
    """No force: the body is where it just touches the (dented) surface, tilts as they were."""
    tilts = problem.support.with_prescribed(motion) * np.array([0.0, 1.0, 1.0])
    distance = problem.open_gap - half_space.whole.plane.field(tilts)
    approach = float(distance.min())
    nothing = np.zeros(half_space.shape)
    found = Guess(nothing, nothing, tilts + np.array([approach, 0.0, 0.0]))
    return ContactSolution(found, distance - approach, 0.0, 0, 0, converged=True)


def _before_first_touch(run: Run, apart: ContactSolution) -> ContactSolution:
    """A flat surface is touched by the body's lowest point, not by the nearest cell centre."""
    tilts = apart.found.motion[1:]
    cells = run.open_gap - np.add.outer(tilts[0] * run.grid.x, tilts[1] * run.grid.y)
    i, j = np.unravel_index(int(cells.argmin()), cells.shape)
    part = np.linspace(-1.0, 1.0, 2 * TOUCH_SAMPLES + 1)
    x = run.grid.x[i] + part[:, None] * run.grid.cell_size[0]
    y = run.grid.y[j] + part[None, :] * run.grid.cell_size[1]
    lowest = float((run.indenter.gap(x, y) - tilts[0] * x - tilts[1] * y).min())
    below = apart.found.motion[0] - lowest
    motion = apart.found.motion - np.array([below, 0.0, 0.0])
    return replace(apart, found=replace(apart.found, motion=motion), gap=apart.gap + below)


def _whole(
    half_space: HalfSpace,
    solution: ContactSolution,
    twin: Twin,
    outcome: Outcome,
    resolved: bool,
) -> Instant:
    """The instant on the whole grid."""
    found = solution.found
    pressure, gap, displacement = (
        half_space.unfold(field) for field in (found.pressure, solution.gap, twin.fields[1])
    )
    for field in (pressure, gap, displacement):
        field.flags.writeable = False  # the run goes on from them
    energy = half_space.fold_count * float((found.pressure * found.deflection).sum()) / 2
    return Instant(
        pressure,
        gap,
        displacement,
        found.motion,
        energy * half_space.grid.cell_area,
        solution.residual,
        solution.iterations,
        outcome,
        resolved,
    )


def _refuse_rim(run: Run, step: Step, instant: Instant) -> None:
    pressure = instant.pressure
    if not (pressure[[0, -1]].any() or pressure[:, [0, -1]].any()):
        return
    raise DomainError(
        f"grid: the contact reaches the grid's rim at t = {step.time:.6g} s; "
        f"enlarge grid.size, now {run.grid.size[0]:.4g} m x {run.grid.size[1]:.4g} m"
    )


def _not_converged(run: Run, step: Step, instant: Instant) -> str:
    return (
        f"the contact solver stopped at t = {step.time:.6g} s with residual "
        f"{instant.residual:.2g} after {instant.iterations} iterations, short of the tolerance "
        f"{run.tolerance:g}; likely causes: a resultant that hardly fits under the body, a grid "
        f"too coarse for the contact, or a tolerance near rounding"
    )
