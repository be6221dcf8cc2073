"""Identification through the simulator: `fit_case`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from os import PathLike
from typing import Any, Literal
from warnings import warn

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.studies.calibration.adhesive_start import adhesive_start
from viscontact.studies.calibration.preparation import (
    Record,
    check_bounds,
    digest,
    experiment_of,
    read_records,
    require_at_rest,
    require_rows,
)
from viscontact.studies.calibration.residuals import Residuals
from viscontact.studies.calibration.result import CaseFit, result_of
from viscontact.studies.calibration.search import Optimum, search
from viscontact.studies.calibration.unknowns import Unknown, unknowns_of
from viscontact.studies.case_values import (
    case_path,
    case_with,
    fingerprint,
    refuse_repeated,
    texts,
)
from viscontact.studies.evaluation import Budget, BudgetSpentError, evaluating
from viscontact.studies.executors.executor_choice import chosen_workers
from viscontact.studies.journal import journal_of
from viscontact.units.numbers import whole

_RUNS_PER_UNKNOWN = 40

#: Correlation from which on two parameters are not distinguished, and the part of a range that
#: counts as its bound.
_INSEPARABLE, _AT_BOUND = 0.99, 1e-3


def fit_case(  # noqa: PLR0913
    case: str | PathLike[str],
    records: Record | Sequence[Record],
    change: Mapping[str, Any],
    *,
    drive: Literal["force", "approach", "case"] | None = None,
    contact_point: Sequence[str] | None = None,
    machine_stiffness: Sequence[str] | None = None,
    settings: Mapping[str, Any] | None = None,
    confidence: float = 0.95,
    rows: int = 60,
    runs: int | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    client: Any = None,
    trials: str | PathLike[str] | None = None,
    overwrite: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> CaseFit:
    """Fit values of a case to measured records by runs of the case, with confidence intervals.

    Parameters
    ----------
    case : path-like
        Case file: bodies, starting values and cells. The record takes the place of its load, except
        for eccentricity and tilts, and of its times.
    records : ContactRecord or path-like, or sequence of them
        Records, or tables with columns time, and force or approach or both. All are of this case.
    change : mapping
        Unknowns by dotted key: a tuple of two bounds, and ``"log"`` for a logarithmic scale, as
        ``{"material.amplitudes[1]": ("0.1 / MPa", "10 / MPa", "log")}``.
    drive : {"force", "approach", "case"}, optional
        What is prescribed in the runs, and taken as exact: a column of the record, or the load of
        the case; the other quantity is fitted. By default the column that the load of the case
        prescribes, or that load itself if the record lacks this column.
    contact_point : tuple, optional
        Range of the reading of the approach at first touch, as ``("-5 um", "5 um")``: an unknown
        for each record. It is 0 if left out.
    machine_stiffness : tuple, optional
        Range of the stiffness of the machine, as ``("1 kN/mm", "100 kN/mm", "log")``: an unknown,
        the same for all records. Force over stiffness is part of the reading of the approach. The
        machine is rigid if left out.
    settings : mapping, optional
        Values of other keys, the same in all runs.
    confidence : float, optional
        Level of the intervals, between 0 and 1.
    rows : int, optional
        Most rows of a record, and steps of its run; of longer records means over equal numbers of
        rows are fitted.
    runs : int, optional
        Most runs on coarse cells; by default 40 for each unknown and record, and 40 more.
    workers : int, optional
        Number of parallel processes; by default as many as there are cores. With 1, the runs are
        computed in this process. With more, a script needs ``if __name__ == "__main__":``, as for
        `simulate_many`.
    executor : concurrent.futures.Executor, optional
        Executor of the runs in place of processes of this machine, as for `simulate_many`.
    client : distributed.Client, optional
        Client of a Dask cluster, in place of an executor.
    trials : path-like, optional
        Keep each run in this file; the same call again goes on from there. One fit at a time writes
        to it.
    overwrite : bool, optional
        Begin again, in place of the runs that the file holds.
    progress : callable, optional
        Called after each run with the number of runs so far and the most allowed ones.

    Returns
    -------
    CaseFit
        Parameters, intervals, correlations, discretisation errors and fitted curves.

    Raises
    ------
    ValueError
        If an argument does not fit, the case or a bound is refused (as `CaseError`), a record
        lacks a column, has fewer rows than twice the unknowns or ends after the load of the case,
        or no run has a result.

    Warns
    -----
    AccuracyWarning
        If two parameters are correlated by more than 0.99, one lies at its bound, its interval
        is longer than its range, or the runs were used up; kept in ``notes``.

    Notes
    -----
    Least squares of the residuals over the largest value of each record, by the trust-region
    reflective algorithm (Branch, Coleman and Li 1999) with differences, on cells that are coarser
    than those of the case and the same in all runs, with steps through the rows of the record.
    Gauss-Newton steps lead from there to the least squares on the cells of the case with steps half
    as long. The intervals are those of the linearised model there, with Student's t and the scatter
    of the residuals: valid for scatter that is independent from row to row, and of equal size
    relative to the largest value in all records. Rows with less than a twentieth of the
    largest force do not count where the approach is fitted.

    If the approach is prescribed, contact point and stiffness of the machine are subtracted from
    its readings, with the measured force and so with its scatter. Take the force as the drive where
    the machine is about as soft as the contact.

    For a sphere, cone or round punch on a half-space, `fit_indentation` needs no runs, and
    `fit_adhesion` for an elastic sphere that adheres.

    Where the bodies adhere, the approach drives the runs, and the force is fitted. With a
    ``stage_stiffness`` in the load of the case the record has the approach of the body, and the
    runs are given that of the stage. All cells are those of the case. The search also begins at
    what `fit_adhesion` finds for a round body. Beside a jump of a run, a row has that of its forces
    before and after it, or between, which is nearest to the record: the jump counts as far as the
    rows tell its instant.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from viscontact.studies.calibration.record import ContactRecord
    >>> file = Path(tempfile.mkdtemp(), "ball.yaml")
    >>> _ = file.write_text(
    ...     "{indenter: {shape: sphere, radius: 5 mm}, "
    ...     "material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}, "
    ...     "load: {kind: step, force: 0.1 N}, time: {end: 1 s, steps: 1}, "
    ...     "grid: {shape: [32, 32], size: [2.4 mm, 2.4 mm]}}"
    ... )
    >>> force = 0.1 * np.linspace(0.2, 1.0, 9)
    >>> depth = (3 * force / (16 * 2e6 * np.sqrt(5e-3))) ** (2 / 3)  # Hertz, G = 2 MPa, nu = 0.5
    >>> fit = fit_case(
    ...     file,
    ...     ContactRecord(np.arange(9.0), force, depth + 2e-6),
    ...     {"material.shear_modulus": ("0.5 MPa", "9 MPa", "log")},
    ...     contact_point=("-9 um", "9 um"),
    ...     workers=1,
    ... )
    >>> f"{fit.parameters['contact_point']:.1g} {fit.units['contact_point']}"
    '2e-06 m'
    """
    path, fixed = case_path(case), texts(settings)
    if not 0 < confidence < 1:
        raise ValueError(f"confidence: must lie between 0 and 1, got {confidence!r}")
    if drive not in (None, "force", "approach", "case"):
        raise ValueError(f"drive: must be 'force', 'approach' or 'case', got {drive!r}")
    most_rows, own = whole("rows", rows, 5), case_with(path, fixed)
    require_at_rest(path, own)
    given = [each.thinned(most_rows) for each in read_records(records)]
    unknowns = unknowns_of(change, contact_point, machine_stiffness, len(given), own)
    refuse_repeated(change=[each.name for each in unknowns], settings=list(fixed))
    check_bounds(path, fixed, unknowns)
    experiments = [
        experiment_of(path, fixed, own, each, drive, number) for number, each in enumerate(given)
    ]
    require_rows(experiments, unknowns)
    default = _RUNS_PER_UNKNOWN * (1 + len(unknowns)) * len(experiments)
    most = default if runs is None else whole("runs", runs, 1)
    arguments = {
        "case": fingerprint(own),
        "records": [digest(each) for each in given],
        "unknowns": repr(unknowns),
        "drives": [each.drive for each in experiments],
        "settings": fixed,
        "cells": repr([(each.own_cells, each.coarse_cells) for each in experiments]),
    }
    at_a_time = len(experiments) * len(unknowns)
    journal = journal_of("fit", arguments, file=trials, overwrite=overwrite)
    chosen = chosen_workers(workers, executor, client, at_a_time)
    with evaluating(Budget(most), journal, chosen, progress) as evaluation:
        residuals = Residuals(experiments, unknowns, evaluation)
        found = _search(residuals, adhesive_start(own, experiments[0], unknowns), most)
        notes = tuple(notes_on(unknowns, found, confidence, most))
        for note in notes:
            warn(f"fit_case: {note}", AccuracyWarning, stacklevel=2)
        return result_of(residuals, found, confidence, notes, path, fixed)


def _search(residuals: Residuals, further: Floats | None, most: int) -> Optimum:
    """Least squares from a further start, too; ValueError if the runs are too few for any."""
    starts = [np.array([each.start for each in residuals.unknowns])]
    try:
        return search(residuals, *starts, *([] if further is None else [further]))
    except BudgetSpentError:
        raise ValueError(f"runs: {most} are too few for this fit; give more") from None


def notes_on(
    unknowns: Sequence[Unknown], found: Optimum, confidence: float, budget: int
) -> Iterator[str]:
    """Yield notes on the optimum of a search of at most `budget` runs."""
    names, correlation = [each.name for each in unknowns], found.correlation
    for n in range(len(names)):
        for m in range(n):
            if abs(correlation[n, m]) > _INSEPARABLE:
                yield (
                    f"{names[m]} and {names[n]} cannot be distinguished (correlation "
                    f"{correlation[n, m]:+.4f}): fix one of them, or add a record with another "
                    "rate or a hold"
                )
    for each, part, reach in zip(unknowns, found.point, found.reach(confidence), strict=True):
        if not _AT_BOUND < part < 1 - _AT_BOUND:
            yield f"{each.name} lies at its bound {each.text(round(part))}; widen its range"
        elif reach > 0.5:
            yield f"{each.name} is left open: its interval is longer than its range"
    if not found.complete:
        yield f"the search ended after {budget} runs, before it had converged; allow more runs"
