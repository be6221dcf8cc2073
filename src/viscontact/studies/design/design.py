"""Design of a case: values of its parameters for the least or largest scalar: `design`."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.case import Case, CaseError, read_case
from viscontact.case.errors import dotted
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.studies.design.conclusions import (
    InfeasibleError,
    notes_on,
    notes_on_trade_off,
    why_infeasible,
)
from viscontact.studies.design.evaluation import BudgetSpentError, Evaluation, coarse_cells
from viscontact.studies.design.goals import Goal, constraints_of, goals_of
from viscontact.studies.design.history import History
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.parameters import Space, space_of
from viscontact.studies.design.result import DesignResult, table_of
from viscontact.studies.design.result_files import write_result
from viscontact.studies.design.scenarios import Scenario, scenarios_of
from viscontact.studies.design.search import Search
from viscontact.studies.design.trade_off import compromises, searched_trade_off
from viscontact.studies.design.trials import Trial
from viscontact.studies.executors.chosen import refuse_import_by_a_worker
from viscontact.studies.executors.local import LocalWorkers
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import whole

#: Most runs of a search, where none are given.
RUNS = 60

#: Called with the numbers of runs, done and allowed, after each trial.
Progress = Callable[[int, int], None]


def design(  # noqa: PLR0913
    case: str | PathLike[str],
    change: Mapping[str, Any],
    *,
    minimise: str | Sequence[str] | None = None,
    maximise: str | Sequence[str] | None = None,
    at: Literal["worst", "end"] | float = "worst",
    over: Mapping[str, Sequence[Any]] | None = None,
    scatter: Mapping[str, tuple[Any, Any] | str] | None = None,
    constraints: Sequence[str] = (),
    settings: Mapping[str, Any] | None = None,
    runs: int | None = None,
    workers: int = 1,
    directory: str | PathLike[str] | None = None,
    progress: Progress | None = None,
) -> DesignResult:
    """Find the values of some parameters of a case for which a scalar is least or largest.

    Parameters
    ----------
    case : path-like
        Case file, YAML or TOML, of a run over time.
    change : mapping
        Parameters by dotted key, at most eight: a tuple of two bounds, and ``"log"`` for a
        logarithmic scale, as ``{"indenter.crown_radius": ("20 mm", "2 m", "log")}``; or a list of
        values to choose from, as ``{"material": ["pmma-paper", "epdm-70-25c"]}``.
    minimise, maximise : str or sequence of str, optional
        Name of the scalar whose magnitude is to be least, or largest. Two or three scalars give a
        trade-off: the trials of which no other one is better in one scalar and as good in the
        others.
    at : {"worst", "end"} or float, optional
        Instant of the scalar: that of its worst value in the run, the last one, or a time of the
        run [s].
    over : mapping, optional
        Scenarios: values of some keys, as ``{"load.eccentricity_x": ["0 mm", "5 mm"]}``; all
        combinations of several keys. The scalar counts in the worst one.
    scatter : mapping, optional
        Scatter of at most three keys, by two bounds: values of a key, as
        ``{"material.poisson_ratio": ("0.36", "0.40")}``, or, for a key of `change`, deviations
        from each value that is tried, as ``{"indenter.crown_radius": ("-2 mm", "2 mm")}``. A number
        with its tolerance is accepted, too, as ``{"indenter.radius": "12 mm ± 0.02 mm"}``. Each
        scenario is computed without scatter and at all corners of the ranges.
    constraints : sequence of str, optional
        Bounds on the magnitudes of scalars at all instants of all scenarios, as
        ``["contact_length<=18mm"]``, or with ``>=``.
    settings : mapping, optional
        Values of other keys, the same in all runs.
    runs : int, optional
        Most runs; a trial takes one for each scenario. By default 60, and for a trade-off 60 for
        each of its searches: 300 for two scalars, 420 for three.
    workers : int, optional
        Number of parallel processes. They compute the scenarios of a trial and, ahead, those of
        the trials that are likely to follow; the result does not depend on their number. With 1,
        the runs are computed in this process. With more, a script needs
        ``if __name__ == "__main__":``, as for `simulate_many`.
    directory : path-like, optional
        Keep the trials there, in ``trials.jsonl``; the same call again goes on where the first one
        was interrupted. In the end it has the best case, ``best.yaml``, and the table,
        ``trials.nc``.
    progress : callable, optional
        Called after each trial with the number of runs so far and the most allowed ones.

    Returns
    -------
    DesignResult
        ``best`` and ``table`` (xarray.Dataset), ``settings``, ``case_text`` and ``notes``.

    Raises
    ------
    ValueError
        If an argument does not fit, the case or a bound is refused (as `CaseError`), two
        constraints contradict each other, or no trial is feasible; the message names the closest
        one.

    Notes
    -----
    The ranges are searched on coarse cells by the algorithm DIRECT (Jones, Perttunen and Stuckman
    1993; locally biased: Gablonsky and Kelley 2001), which needs no derivatives and no random
    numbers; constraints are an exact penalty. If half of the runs have given no feasible trial, the
    search goes on around the one that is closest. The best trials are computed again on the cells
    of the case, and the search goes on around the best one by the method of Nelder and Mead (1965).
    Each search ends when its last trials have gained less than the error of the scalar. A global
    optimum is not guaranteed. A peak pressure without a limit, as where a contact reaches the sharp
    end of a roller, is never the best one. A trade-off is searched for the best value of each
    scalar, then for compromises of different weights, by the augmented weighted Chebyshev distance
    (Steuer and Choo 1983), which also finds curves that are not convex.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "ball.yaml")
    >>> _ = file.write_text(
    ...     "{indenter: {shape: sphere, radius: 5 mm}, "
    ...     "material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}, "
    ...     "load: {kind: step, force: 0.1 N}, time: {end: 1 s, steps: 1}, "
    ...     "grid: {shape: [64, 64], size: [2.4 mm, 2.4 mm]}, output: {errors: false}}"
    ... )
    >>> found = design(
    ...     file,
    ...     {"load.force": ("0.01 N", "0.5 N", "log")},
    ...     maximise="approach",
    ...     constraints=["contact_width<=1.2mm"],
    ... )
    >>> force = float(found.best["load.force"])
    >>> abs(force / (4 / 3 * 4e6 * 0.6e-3**3 / 5e-3) - 1) < 0.1  # Hertz: F = 4/3 E* a^3 / R
    True
    """
    refuse_import_by_a_worker()
    path, fixed = Path(case), {key: str(value) for key, value in (settings or {}).items()}
    goals, limits, space = (
        goals_of(minimise, maximise, at),
        constraints_of(constraints),
        space_of(change),
    )
    _refuse_repeated(space.keys, tuple(over or ()), tuple(fixed))
    _refuse_repeated(tuple(scatter or ()), tuple(over or ()), tuple(fixed))
    budget = whole("runs", _default_runs(len(goals)) if runs is None else runs, 1)
    values = _own_values(_read(path, _assignments(fixed)), (*space.keys, *(scatter or {})))
    scenarios = scenarios_of(over, scatter, space, values)
    own = _checked(path, space, scenarios, fixed, goals[0])
    arguments = {
        "case": hashlib.sha256(b"".join(sorted(own.digests.values()))).hexdigest(),
        **{"change": repr(change), "goal": repr(goals), "over": repr(over)},
        **({"scatter": repr(scatter)} if scatter else {}),
        **{"constraints": repr(limits), "settings": fixed},
    }
    count = whole("workers", workers, 1)
    with ExitStack() as opened:
        history = opened.enter_context(_history(directory, arguments))
        evaluation = Evaluation(
            path,
            fixed,
            scenarios,
            goals,
            limits,
            coarse_cells(own),
            budget,
            opened.enter_context(warm_workers(count)),
            count,
            history.keep if history else _forget,
            progress or silent,
            history.recorded if history else {},
        )
        found = _searched(evaluation, space, values, _unused_tolerances(own, scatter))
        if directory is not None:
            write_result(Path(directory), found)
        return found


def _default_runs(goals: int) -> int:
    """Most runs of each search; there is one for each goal and for each compromise."""
    if goals == 1:
        return RUNS
    return RUNS * (goals + len(compromises(goals)))


def _searched(
    evaluation: Evaluation, space: Space, own: Mapping[str, str], known: Iterable[str]
) -> DesignResult:
    """Search, and describe the best trial, with notes `known` before; ValueError if none is."""
    goals, limits = evaluation.goals, evaluation.constraints
    try:
        evaluation.evaluate({}, "case")
    except BudgetSpentError:
        raise ValueError(
            f"runs: {evaluation.budget} are too few for {len(evaluation.scenarios)} scenarios"
        ) from None
    if len(goals) == 1:
        search = Search(space, evaluation, Objective(goals))
        searches = [(search, search.run())]
    else:
        searches = searched_trade_off(space, evaluation)
    search, best = searches[-1]
    if best is None:
        raise InfeasibleError(why_infeasible(evaluation, search))
    names = [each.name or "as in the case" for each in evaluation.scenarios]
    table = table_of(evaluation.trials, space.keys, own, names, goals, limits)
    said = notes_on(best, search) if len(goals) == 1 else notes_on_trade_off(searches)
    notes, number = (*known, *said), evaluation.trials.index(best)
    about = {"goal": " ".join(goal.scalar for goal in goals), "at": str(goals[0].at)}
    about["sense"] = " ".join("least" if goal.least else "largest" for goal in goals)
    about |= {"constraints": "; ".join(map(str, limits)), "notes": "\n".join(notes)}
    return DesignResult(
        table.assign_attrs(about, best=number),
        dict(best.settings),
        notes,
        evaluation.runs,
        evaluation.case,
        evaluation.settings,
        goals,
        number,
        tuple(evaluation.scenarios),
    )


def _unused_tolerances(case: Case, scatter: Mapping[str, Any] | None) -> list[str]:
    """Note on tolerances in the case that are not among the scatter."""
    given = scatter or {}
    found = {dotted(path): text for path, text in case.document.tolerances.items()}
    left = [f"'{key}={text}'" for key, text in found.items() if key not in given]
    if not left:
        return []
    return [f"tolerances of the case count in a design only as scatter, as {left[0]}"]


def _refuse_repeated(*groups: Sequence[str]) -> None:
    keys = [key for group in groups for key in group]
    for key in keys:
        if keys.count(key) > 1:
            raise ValueError(f"{key}: is given twice, in change, over or settings; give it once")


def _checked(
    path: Path,
    space: Space,
    scenarios: Sequence[Scenario],
    fixed: Mapping[str, str],
    goal: Goal,
) -> Case:
    """Check the case at its own values, at the bounds and in all scenarios, and return it."""

    def read(scenario: Scenario, trial: Mapping[str, str]) -> Case:
        return _read(path, (*_assignments(fixed), *_assignments(scenario.settings(trial))))

    own = read(scenarios[0], {})
    if own.steady is not None:
        raise ValueError(f"{path}: is in steady motion; a design takes a case over time")
    if own.adaptive is None and not isinstance(goal.at, str):
        require_instant(own.instants, goal.at)
    for corner in space.corners():
        for each in scenarios:
            if each is scenarios[0] or each.deviations:
                read(each, corner)
    for each in scenarios[1:]:
        read(each, {})
    return own


def require_instant(instants: Floats, time: float) -> None:
    """Raise ValueError if a time [s] is none of the instants."""
    near = float(instants[np.abs(instants - time).argmin()])
    if not np.isclose(near, time, rtol=1e-9, atol=0):
        wanted, found = (format_quantity(each, "s") for each in (time, near))
        raise ValueError(f"at: {wanted} is no instant of the case; the nearest one is {found}")


def _read(path: Path, settings: Sequence[str]) -> Case:
    """Read a case; CaseError without the name of an option of the command line."""
    try:
        return read_case(path, settings)
    except CaseError as error:
        raise CaseError(*(line.removeprefix("--set ") for line in error.problems)) from None


def _assignments(settings: Mapping[str, str]) -> list[str]:
    return [f"{key}={value}" for key, value in settings.items()]


def _own_values(case: Case, keys: Sequence[str]) -> dict[str, str]:
    """Values of some keys in the case, where they are plain."""
    found = {}
    for key in keys:
        value: Any = case.document.data
        for step in key.split("."):
            value = value.get(step) if isinstance(value, dict) else None
        if isinstance(value, str | int | float):
            found[key] = str(value)
    return found


@contextmanager
def _history(
    directory: str | PathLike[str] | None, arguments: dict[str, Any]
) -> Iterator[History | None]:
    with in_use(directory):
        yield None if directory is None else History(Path(directory), arguments)


@contextmanager
def in_use(directory: str | PathLike[str] | None) -> Iterator[None]:
    """Lock the directory of a design; ValueError if it is a file, or another one is at work."""
    if directory is None:
        yield
        return
    place = Path(directory)
    if place.exists() and not place.is_dir():
        raise ValueError(f"directory: {place} is a file; name a directory for the design")
    place.mkdir(parents=True, exist_ok=True)
    try:
        with locked(place):
            yield
    except DirectoryInUse as error:
        raise ValueError(str(error)) from None


@contextmanager
def warm_workers(count: int) -> Iterator[LocalWorkers | None]:
    """Warm processes; none for one run at a time."""
    if count == 1:
        yield None
        return
    pool = LocalWorkers(count)
    try:
        yield pool
    except BaseException:
        pool.kill()
        raise
    finally:
        pool.shutdown()


def _forget(trial: Trial) -> None:
    """Keep nothing."""


def silent(done: int, allowed: int) -> None:
    """Show nothing."""
