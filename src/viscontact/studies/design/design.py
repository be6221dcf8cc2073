"""Design of a case: values of its parameters for the least or largest scalar: `design`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from viscontact.case import Case
from viscontact.case.errors import dotted
from viscontact.studies.case_values import (
    fields_setting,
    fingerprint,
)
from viscontact.studies.cells import coarse_cells
from viscontact.studies.design.conclusions import notes_on, notes_on_trade_off, why_infeasible
from viscontact.studies.design.evaluated_trials import Searched, Trials, searched
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.plan import planned_design
from viscontact.studies.design.result import DesignResult, table_of
from viscontact.studies.design.trade_off import searched_trade_off
from viscontact.studies.design.trial_runs import CaseTrials
from viscontact.studies.evaluation import Budget, BudgetSpentError, Progress, evaluating
from viscontact.studies.executors.executor_choice import chosen_workers
from viscontact.studies.infeasible import InfeasibleError
from viscontact.studies.journal import journal_of
from viscontact.studies.study_files import BEST_NAME, TRIALS_NAME, write_case, write_table

#: Way of the search, which another journal does not have: trials would follow on others.
SEARCH = "surrogate of what the runs state"


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
    clear_of_ends: bool = False,
    settings: Mapping[str, Any] | None = None,
    runs: int | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    client: Any = None,
    directory: str | PathLike[str] | None = None,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> DesignResult:
    """Find the values of some parameters of a case for which a scalar or one of them is best.

    Parameters
    ----------
    case : path-like
        Case file, YAML or TOML.
    change : mapping
        Parameters by dotted key, at most eight: a tuple of two bounds, and ``"log"`` for a
        logarithmic scale, as ``{"indenter.crown_radius": ("20 mm", "2 m", "log")}``; or a list of
        values to choose from, as ``{"material": ["pmma-paper", "epdm-70-25c"]}``.
    minimise, maximise : str or sequence of str, optional
        Name of the scalar whose magnitude is to be least, or largest; or key of a parameter of
        `change`, as ``"material.layers[1].thickness"`` for the thinnest cover that keeps the
        constraints. Two or three names give a trade-off: the trials of which no other one is better
        in one of them and as good in the others.
    at : {"worst", "end"} or float, optional
        Instant of the scalar: that of its worst value in the run, the last one, a time of the run
        [s], or in steady motion a speed [m/s]. Constraints are kept at all of them.
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
        ``["contact_length<=18mm"]``, or with ``>=``; ``["peak_pressure<=allowable"]`` is the
        allowable value of the case, or that of the yield stress of the pressed body.
    clear_of_ends : bool, optional
        True: a contact that reaches a sharp end of the body at any instant is never the best one.
        Pressure has no limit there, also where the cells of a run do not resolve that, so that its
        peak pressure has an error bar and a warning. By default the error bar decides.
    settings : mapping, optional
        Values of other keys, the same in all runs.
    runs : int, optional
        Most runs; a trial takes one for each scenario. By default 60, and for a trade-off 60 for
        each of its searches: 300 for two scalars, 420 for three.
    workers : int, optional
        Number of parallel processes; by default as many as there are cores. They compute the
        scenarios of a trial and, ahead, those of the trials that are likely to follow; the result
        does not depend on their number. With 1, the runs are computed in this process. With more, a
        script needs ``if __name__ == "__main__":``, as for `simulate_many`.
    executor : concurrent.futures.Executor, optional
        Executor of the runs in place of processes of this machine, as for `simulate_many`.
    client : distributed.Client, optional
        Client of a Dask cluster, in place of an executor.
    directory : path-like, optional
        Keep the trials there, in ``trials.jsonl``; the same call again goes on where the first one
        was interrupted. In the end it has the best case, ``best.yaml``, and the table,
        ``trials.nc``.
    overwrite : bool, optional
        Begin again, in place of the runs that the directory holds.
    progress : callable, optional
        Called after each run with the number of runs so far and the most allowed ones.

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
    of the case, and the search goes on around the best one, by radial basis functions through the
    scalars of all trials and by polls where these predict no gain (Torczon 1997). It ends when the
    predicted gain, with the error of the last predictions, is small: the gain that is left is
    `DesignResult.remaining_gain`. A global optimum is not guaranteed. A peak pressure of which a
    run states that it has no limit is never the best one. A trade-off is searched for the best
    value of each scalar, then for compromises of different weights, by the augmented weighted
    Chebyshev distance (Steuer and Choo 1983), which also finds curves that are not convex.

    A parameter is known without a run, so that one that is to be least or largest has no error, and
    values that cannot be better than a feasible one are not run. Of a single range, the first
    change of sign of the excess over the bounds is searched from the better end on, at five points
    at first, and enclosed by a bracket: `DesignResult.remaining_gain` is its width. A range beyond
    it whose bounds are kept between two of these points is not excluded.

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
    ...     workers=1,
    ... )
    >>> force = float(found.best["load.force"])
    >>> abs(force / (4 / 3 * 4e6 * 0.6e-3**3 / 5e-3) - 1) < 0.1  # Hertz: F = 4/3 E* a^3 / R
    True
    """
    plan = planned_design(
        case,
        change,
        minimise=minimise,
        maximise=maximise,
        at=at,
        over=over,
        scatter=scatter,
        constraints=constraints,
        settings=settings,
        runs=runs,
    )
    path, fixed, goals, limits, own = plan.path, plan.fixed, plan.goals, plan.limits, plan.own
    budget, scenarios = Budget(plan.runs), plan.scenarios
    arguments = {
        **{"case": fingerprint(own), "change": repr(change), "goal": repr(goals)},
        **{"over": repr(over), "scatter": repr(scatter or None)},
        **{"constraints": repr(limits), "settings": fixed, "search": SEARCH},
        **{"clear_of_ends": bool(clear_of_ends)},
    }
    cells = coarse_cells(own)
    fields = fields_setting(own)
    of_case = CaseTrials(path, fixed, scenarios, goals, limits, cells, fields, bool(clear_of_ends))
    journal = journal_of("design", arguments, directory=directory, overwrite=overwrite)
    chosen = chosen_workers(workers, executor, client)
    with evaluating(budget, journal, chosen, progress) as evaluation:
        levels = ("coarse", "case") if of_case.coarse else ("case",)
        trials = Trials(plan.space, of_case, goals, limits, evaluation, levels, len(scenarios))
        found = _search(trials, of_case, plan.values, _unused_tolerances(own, scatter))
        if directory is not None:
            write_case(Path(directory) / BEST_NAME, found.best_case)
            about = found.table.assign_attrs(headline=str(found))
            write_table(Path(directory) / TRIALS_NAME, about)
        return found


def _search(
    trials: Trials, of_case: CaseTrials, own: Mapping[str, str], known: Iterable[str]
) -> DesignResult:
    """Search, and describe the best trial, with notes `known` before; ValueError if none is."""
    goals, limits = trials.goals, trials.constraints
    searches = _searches(trials, own)
    best = searches[-1].best
    if best is None:
        raise InfeasibleError(why_infeasible(trials))
    before, *_ = made = trials.in_order()
    names = [each.name or "as in the case" for each in of_case.scenarios]
    table = table_of(made, trials.space.keys, own, names, goals, limits)
    is_trade_off = len(goals) > 1
    if is_trade_off:
        notes = (*known, *notes_on_trade_off(searches, before))
    else:
        notes = (*known, *notes_on(best, before, searches[0]))
    number = made.index(best)
    about = {"goal": " ".join(goal.name for goal in goals), "at": str(goals[0].at)}
    about["sense"] = " ".join("least" if goal.least else "largest" for goal in goals)
    about |= {"constraints": "; ".join(map(str, limits)), "notes": "\n".join(notes)}
    left = math.nan if is_trade_off else searches[0].remaining_gain
    return DesignResult(
        table.assign_attrs(about, best=number, remaining_gain=left),
        dict(best.settings),
        notes,
        trials.budget.runs,
        of_case.case,
        of_case.settings,
        goals,
        limits,
        number,
        tuple(of_case.scenarios),
        best.deciding(goals[0], limits),
    )


def _searches(trials: Trials, own: Mapping[str, str]) -> list[Searched]:
    """Searches for the goals, after the case itself; all know the trials of the others."""
    try:
        trials.of_case(own)
    except BudgetSpentError:
        most, size = trials.budget.most, trials.size
        raise ValueError(f"runs: {most} are too few for {size} scenarios") from None
    if len(trials.goals) > 1:
        return searched_trade_off(trials)
    return [searched(trials, Objective(trials.goals))]


def _unused_tolerances(case: Case, scatter: Mapping[str, Any] | None) -> list[str]:
    """Note on tolerances in the case that are not among the scatter."""
    given = scatter or {}
    found = {dotted(path): text for path, text in case.document.tolerances.items()}
    left = [f"'{key}={text}'" for key, text in found.items() if key not in given]
    if not left:
        return []
    return [f"tolerances of the case count in a design only as scatter, as {left[0]}"]
