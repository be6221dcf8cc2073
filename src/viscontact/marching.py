"""The one loop over time: from an indenter, a material and a load to states."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence

from numpy.typing import ArrayLike

from viscontact.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.grid import Grid
from viscontact.half_space import HalfSpace
from viscontact.indenters import Indenter
from viscontact.load import LoadHistory
from viscontact.material import Material
from viscontact.observation import Instant, Observer
from viscontact.past import Past
from viscontact.run import Run, Steps, prepare_run
from viscontact.schedule import Step
from viscontact.state import ContactState, Outcome
from viscontact.stepping import AdaptiveTimes

#: Called after each instant asked for: the state, how many are done, how many there are; with
#: adaptive steps, how many there probably are.
Progress = Callable[[ContactState, int, int], None]


def march(
    indenter: Indenter,
    material: Material,
    load: LoadHistory,
    grid: Grid | None = None,
    times: ArrayLike | AdaptiveTimes | None = None,
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
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    grid : Grid, optional
        Cells that carry the pressure; `auto_grid` chooses when left out.
    times : array_like or AdaptiveTimes, optional
        Instants of the states, strictly increasing, none before 0 [s]; chosen from load and
        law when left out. At a jump the state is the one just after it. With `adaptive_times`
        there is a state for each step that the run chooses, and one at each instant of
        `fields`.
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
    Cerlinca 2018, eq. 12) is of first order. Over steps long against the law (always, if it is a
    dashpot at first) the pressure rises over a part of the step only, lest it ring, and the error
    is of first order; an `AccuracyWarning` says so where it matters.

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
    observer, done = Observer(run), 0
    end = float(run.times[-1])
    steps = run.steps()
    for step, instant in _instants(run, steps):
        state = observer.observe(step, instant)
        if step.asked is not None:
            done += 1
            state = observer.judge(state, last=step.asked >= end)
            for text in state.warnings:
                warnings.warn(text, AccuracyWarning, stacklevel=2)
            if progress is not None:
                progress(state, done, done + steps.left)
            yield state
        if instant.outcome is Outcome.NOT_CONVERGED:
            raise ConvergenceError(_not_converged(run, step, instant))
    observer.refuse_coarse_mesh()


def _instants(run: Run, steps: Steps) -> Iterator[tuple[Step, Instant]]:
    """Solve step after step; what the body remembers is all in its past."""
    past = Past(run, HalfSpace(run.grid, mirrored=run.is_mirrored, threads=run.threads))
    while (step := steps.upcoming()) is not None:
        trial = past.trial(step)
        failed = trial.outcome is Outcome.NOT_CONVERGED
        if not (failed or steps.accepts(trial.error.relative)):
            continue
        instant = past.accept(step, trial)
        _refuse_rim(run, step, instant)
        yield step, instant


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
