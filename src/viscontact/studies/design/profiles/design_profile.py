"""Design of a free roller profile: `design_profile`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import LogarithmicProfile
from viscontact.studies.case_values import (
    case_path,
    fingerprint,
    texts,
)
from viscontact.studies.design.profiles.comparison import FoundProfiles, compared
from viscontact.studies.design.profiles.convex_curve import ConvexCurves
from viscontact.studies.design.profiles.loaded_roller import loaded_rollers, without_creep
from viscontact.studies.design.profiles.minimax import Minimum, cost, least_largest
from viscontact.studies.design.profiles.named import NamedProfile, amplitude_of, best_named
from viscontact.studies.design.profiles.profile_runs import ProfileRuns, RowPressures, search_grids
from viscontact.studies.design.profiles.result import ProfileDesign
from viscontact.studies.design.profiles.result_files import write_profile_design
from viscontact.studies.design.profiles.tables import deviating, finite_table, tabulated
from viscontact.studies.design.scenarios import scenarios_of
from viscontact.studies.evaluation import Budget, evaluating
from viscontact.studies.executors.executor_choice import chosen_workers
from viscontact.studies.journal import journal_of
from viscontact.studies.scalars import require_instant
from viscontact.studies.space import Space
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import non_negative, whole

#: Least and most knots of a profile from its middle to its end.
FEWEST_KNOTS, MOST_KNOTS = 3, 20


def design_profile(  # noqa: PLR0913
    case: str | PathLike[str],
    *,
    knots: int = 6,
    symmetric: bool = True,
    at: Literal["worst", "end"] | float = "worst",
    over: Mapping[str, Sequence[Any]] | None = None,
    drop_tolerance: float = 0.0,
    settings: Mapping[str, Any] | None = None,
    runs: int = 2000,
    workers: int | None = None,
    executor: Executor | None = None,
    client: Any = None,
    directory: str | PathLike[str] | None = None,
    overwrite: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> ProfileDesign:
    """Find the drop curve of a roller for which the peak pressure is least.

    Parameters
    ----------
    case : path-like
        Case file whose indenter is a roller with an end, over given times.
    knots : int, optional
        Number of knots of the curve from the middle of the roller to its end, 3 to 20.
    symmetric : bool, optional
        Both halves are equal, so that the roller can be mounted either way round.
    at : {"worst", "end"} or float, optional
        Instants of the peak pressure that count: all of the run, the last one, or a time [s].
    over : mapping, optional
        Scenarios: values of some keys, as ``{"load.eccentricity_x": ["0 mm", "5 mm"]}``; all
        combinations of several keys. The worst one counts.
    drop_tolerance : float, optional
        Production tolerance of the drop, to either side [m]. The worst of seven profiles within it
        counts: as drawn, with a deeper and a flatter crown, tapers, and waves.
    settings : mapping, optional
        Values of other keys, the same in all runs.
    runs : int, optional
        Most runs of the search.
    workers : int, optional
        Number of parallel processes; by default as many as there are cores. With 1, the runs are
        computed in this process.
    executor : concurrent.futures.Executor, optional
        Executor of the runs in place of processes of this machine, as for `simulate_many`.
    client : distributed.Client, optional
        Client of a Dask cluster, in place of an executor.
    directory : path-like, optional
        Keep the runs there, in ``trials.jsonl``; the same call again goes on where the first one
        was interrupted. In the end it has the best case, ``best.yaml``, the profile as
        ``profile.csv`` and ``profile.dxf``, and the table ``trials.nc``.
    overwrite : bool, optional
        Begin again, in place of the runs that the directory holds.
    progress : callable, optional
        Called after each run with the number of runs so far and the most allowed ones.

    Returns
    -------
    ProfileDesign
        ``x`` and ``drop`` [m], ``table`` (xarray.Dataset) with the named profiles under the same
        loads, ``notes``, ``case_text``, and ``report``.

    Raises
    ------
    ValueError
        If an argument does not fit, the case is refused (as `CaseError`), or its indenter is no
        roller with an end.

    Notes
    -----
    The curve is convex: its curvature is linear between the knots and not negative. The largest
    pressure over all rows of cells, instants and scenarios is made least by sequential linear
    programs with a trust region (Madsen 1975), beginning with the best of the named profiles: a
    circular crown, that of Lundberg (1939), and that of Johns and Gohar (1981), each at its best
    amplitude. A local optimum is found; a global one is not guaranteed. The contact stays away from
    the ends of the roller by a fiftieth of the half length, since pressure has no limit there.

    Peak pressures of the result are computed on the cells of the case, with their errors.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "roller.yaml")
    >>> _ = file.write_text(
    ...     "{indenter: {shape: roller, radius: 5 mm, half_length: 10 mm}, "
    ...     "material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.35}, "
    ...     "load: {kind: step, force: 967 N}, time: {end: 1 s, steps: 1}, "
    ...     "grid: {shape: [108, 27], size: [21.6 mm, 1.1 mm]}, output: {errors: false}}"
    ... )
    >>> found = design_profile(file, knots=4, workers=1)
    >>> modulus = 2e9 / (1 - 0.35)
    >>> even = (967 / 20e-3 * modulus / (np.pi * 5e-3)) ** 0.5  # Hertz, even along the roller
    >>> round(found.peak_pressure / even, 2)
    1.03
    """
    path, fixed = case_path(case), texts(settings)
    count = whole("knots", knots, FEWEST_KNOTS, MOST_KNOTS)
    tolerance = non_negative("drop_tolerance", drop_tolerance, "m")
    budget = Budget(whole("runs", runs, 1))
    scenarios = scenarios_of(over, None, Space(()), {})
    rollers = loaded_rollers(path, fixed, scenarios)
    for each in rollers:
        require_instant(each.case, at)
    curves = ConvexCurves(
        rollers[0].end, count, symmetric, not symmetric and rollers[0].has_given_tilt
    )
    arguments = {
        "case": fingerprint(rollers[0].case),
        **{"profile": repr(curves), "at": str(at), "over": repr(scenarios)},
        **{"drop_tolerance": repr(tolerance), "settings": fixed, "runs": budget.most},
    }
    journal = journal_of("design", arguments, directory=directory, overwrite=overwrite)
    chosen = chosen_workers(workers, executor, client)
    with evaluating(budget, journal, chosen, progress) as evaluation:
        made = ProfileRuns(rollers, at, evaluation)
        found = compared(made, _search(made, curves, tolerance), path, fixed)
        if directory is not None:
            write_profile_design(Path(directory), found)
        return found


def _search(search: ProfileRuns, curves: ConvexCurves, tolerance: float) -> FoundProfiles:
    """Search for the free profile, from the best of the named ones."""
    search.amplitude, grids = _amplitude_and_grids(search)
    search.grid = grids[0]
    named = best_named(search)
    best = min(named[1:], key=lambda each: each.cost, default=named[0])
    size = _size(best, curves, search.amplitude)
    start = _start(search, curves, named, tolerance)
    free = _least_peak(search, curves, grids, start, size, tolerance)
    materials, elastic = without_creep(search.scenarios), None
    if materials is not None and not free.is_cut_short:
        search.materials = materials
        elastic = _least_peak(search, curves, grids, start, size, tolerance)
        search.materials, search.grid = {}, grids[-1]
    x = curves.table()
    return FoundProfiles(
        x,
        tuple(named),
        curves.drop(free.point, x),
        None if elastic is None else curves.drop(elastic.point, x),
        tolerance,
        free.is_cut_short,
    )


def _amplitude_and_grids(search: ProfileRuns) -> tuple[float, tuple[Grid, ...]]:
    """Amplitude of an even line load [m], and the grids of the search."""
    own = search.scenarios[0]
    amplitude = amplitude_of(search.widths()[1], own.roller.radius)
    half_width = 2 * np.sqrt(own.roller.radius * amplitude)
    if 2 * half_width >= own.end:
        raise ValueError(
            f"indenter: the contact is {format_quantity(2 * half_width, 'm', 3)} wide, more than "
            "half of the roller's length; a free profile is for contacts that are longer than wide"
        )
    profile = LogarithmicProfile.johns_gohar(
        own.roller.radius, own.end, 2 * np.pi * own.end * amplitude, 1.0
    )
    # Wide enough for this profile of which only an estimate is known.
    search.grid = search_grids(own.end, (half_width, 3 * half_width))[0]
    return amplitude, search_grids(own.end, search.widths(profile))


def _size(best: NamedProfile, curves: ConvexCurves, amplitude: float) -> float:
    """Size of the coefficients [m]: what makes half of the drop at 0.9 of the half length."""
    drop = float(best.profile.drop(0.9 * curves.half_length, curves.half_length))
    return max(drop / 2, amplitude / 2)


def _start(
    search: ProfileRuns, curves: ConvexCurves, named: Sequence[NamedProfile], tolerance: float
) -> Floats:
    """Coefficients of the best curve that approximates a named profile other than the cylinder."""
    x = curves.table()
    lines = [finite_table(each.profile, x, curves.half_length) for each in named[1:]]
    points = [curves.fitted(line) for line in lines]
    rows = search.pressures([_group(curves, point, tolerance) for point in points])
    return points[int(np.argmin([cost(each) for each in rows]))]


def _least_peak(
    search: ProfileRuns,
    curves: ConvexCurves,
    grids: Sequence[Grid],
    start: Floats,
    size: float,
    tolerance: float,
) -> Minimum:
    """Curve of the least largest pressure, on coarse cells and then on finer ones."""

    def responses(points: Sequence[Floats]) -> Sequence[RowPressures | None]:
        return search.pressures([_group(curves, point, tolerance) for point in points])

    found = Minimum(start, np.inf, False)
    for search.grid in grids:
        found = least_largest(responses, found.point, np.full(curves.size, size), curves.lowest)
    return found


def _group(curves: ConvexCurves, point: Floats, tolerance: float) -> list[Any]:
    """Profiles of a point that are within the tolerance."""
    x = curves.table()
    drops = deviating(curves.drop(point, x), x / curves.half_length, tolerance)
    return [tabulated(x, drop) for drop in drops.values()]
