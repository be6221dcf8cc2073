"""Error bars of a run's scalars, estimated from coarser runs.

On grids of cells h a scalar differs by c (h2^p - h1^p); each pair of grids gives c, and the largest
one counts, since the rim's position between cells scatters and a single difference may be small by
accident. The error of the time steps follows in the same way from a run with halved steps on one of
the grids. The largest relative difference within a window of times counts for all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.accuracy.coarser_runs import (
    CoarserResult,
    History,
    march_coarser_run,
    plan_coarser_runs,
)
from viscontact.accuracy.levels import (
    RefinementLevels,
    end_flags,
    moving_maximum,
    moving_minimum,
    spots_across,
)
from viscontact.accuracy.singular_peaks import peak_bars, singular_warnings
from viscontact.simulation.setup import RunSetup

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ErrorModel:
    """Conversion of differences between grids to errors."""

    order: float  # power of the cell size with which the error falls [-]
    #: Safety factor, calibrated on exact solutions (tests/verification/test_error_bars.py) so that
    #: 95 of 100 errors are smaller [-].
    factor: float
    at_end: ErrorModel | None = None  # where contact reaches the body's end
    of_spots: ErrorModel | None = None  # where contact consists of spots of few cells

    def of(self, levels: RefinementLevels) -> Array:
        """Error from the cells."""
        return self.factor * levels.by_cells(self.order)


#: Approach, force and work, also where a contact reaches the end of a body: pressure is singular
#: there, and the cells approximate the end by a staircase.
_BULK = ErrorModel(2.0, 1.5, at_end=ErrorModel(0.7, 1.2))

#: Area and peak, also where contact consists of spots of fewer cells across, in the mean: some of
#: them exist on one grid only. Calibrated on self-affine surfaces, 2 to 9 cells across.
COARSE_SPOT_CELLS = 8.0
_AREA = ErrorModel(2.0, 2.0, of_spots=ErrorModel(1.0, 1.5))
_PEAK = ErrorModel(2.0, 2.0, at_end=ErrorModel(1.0, 1.5), of_spots=ErrorModel(2.0, 4.0))

#: Peak of the line load, a mean over a twentieth of the contact. Calibrated on ellipses, crowned
#: rollers, and rollers and punches with sharp ends, 15 to 80 cells long.
_LINE_LOAD = ErrorModel(2.0, 2.0, at_end=ErrorModel(0.7, 1.1), of_spots=ErrorModel(2.0, 4.0))

_EXTENT = ErrorModel(1.0, 0.75)

#: Error models of the scalars. Pressure is smooth except at the rim, which lies between cells.
ERROR_MODELS = {
    "force": _BULK,
    "eccentricity_x": _BULK,
    "eccentricity_y": _BULK,
    "approach": _BULK,
    "tilt_x": _BULK,
    "tilt_y": _BULK,
    "contact_area": _AREA,
    "contact_length": _EXTENT,
    "contact_width": _EXTENT,
    "peak_pressure": _PEAK,
    "mean_pressure": _AREA,
    "peak_line_load": _LINE_LOAD,
    "work": _BULK,
    "loss_per_cycle": _BULK,
}

#: Smallest error of extents in cells, however well two grids agree; with spots of few cells, or
#: singular pressure at the rim.
RIM_CELLS, UNSMOOTH_RIM_CELLS = 0.25, 1.5

#: Relative difference below which all grids agree on an extent: it is that of the body.
AGREEMENT_TOLERANCE = 1e-6

#: Errors of the scalars, in tolerances of the solver, which bounds the gap.
SOLVER_ERROR_FACTOR = 3.0

#: Extents of the contact along x and y, and scalars that follow from the moments.
EXTENTS = ("contact_length", "contact_width")
MOMENTS = ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")

TINY = float(np.finfo(np.float64).tiny)

#: Scalars that are exactly zero without contact.
ZERO_WITHOUT_CONTACT = (
    *("force", "contact_area", "contact_length", "contact_width"),
    *("peak_pressure", "mean_pressure", "peak_line_load"),
)


@dataclass(frozen=True, eq=False)
class ErrorBars:
    """Estimated errors of a run's scalars."""

    #: Half widths of the bars by scalar, in its unit, over the run's times: inf where the scalar
    #: has no limit, NaN where the error is unknown.
    values: dict[str, Array]
    warnings: tuple[str, ...]  # warnings that follow from the coarser runs


def error_bars(
    run: RunSetup,
    history: History,
    on_step: Callable[[], None] | None = None,
    *,
    issued: Sequence[str] = (),
) -> ErrorBars:
    """Estimate the errors of a finished run's scalars from coarser runs, which are marched.

    95 of 100 true errors are smaller. `on_step` is called after each step of a coarser run; an
    exception from it ends the estimate. `issued` are the warnings of the run so far.

    Examples
    --------
    >>> import viscontact as vc
    >>> from viscontact.accuracy.coarser_runs import history_of
    >>> from viscontact.simulation.state_generator import march_run
    >>> from viscontact.problem.problem import Problem
    >>> from viscontact.simulation.setup import prepare_run
    >>> rubber = vc.Material(vc.Elastic(1e6 / 3), poisson_ratio=0.5)
    >>> grid = vc.Grid((40, 40), (0.26, 0.26))
    >>> run = prepare_run(Problem(vc.Paraboloid(0.75, 0.75), rubber, vc.step(2370.0), grid, [0.0]))
    >>> history = history_of(list(march_run(run)))
    >>> bar = error_bars(run, history).values["approach"][0]
    >>> bool(abs(history["approach"][0] - (0.75 * 2370 / (4e6 / 3) / 0.75**0.5)**(2 / 3)) < bar)
    True
    >>> bool(bar / history["approach"][0] < 2e-3)
    True
    """
    results = [
        result
        for each in plan_coarser_runs(run, history)
        if (result := march_coarser_run(each, on_step))
    ]
    return error_bars_from(run, history, results, issued=issued)


def error_bars_from(
    run: RunSetup,
    history: History,
    results: Iterable[CoarserResult],
    *,
    issued: Sequence[str] = (),
) -> ErrorBars:
    """Estimate errors from coarser runs that have been marched; NaN if there are none."""
    found = list(results)
    if not found:
        return unknown_bars(len(history["time"]))
    at_end = moving_maximum(end_flags(history["time"], found)) > 0
    of_spots = moving_minimum(spots_across(history["time"], found)) < COARSE_SPOT_CELLS
    places = _ContactKinds(at_end, of_spots)
    values = {
        name: _bar(run, name, RefinementLevels.of(name, history, found), places, history)
        for name in ERROR_MODELS
    }
    left_out = run.mesh is not None and "peak" in run.mesh.warnings
    values["peak_pressure"] = peak_bars(values["peak_pressure"], history, found, left_out=left_out)
    # A sharp corner of the body has the same effect on the line load as its end.
    sharp = _ContactKinds(at_end | np.isinf(values["peak_pressure"]), of_spots)
    line_load = RefinementLevels.of("peak_line_load", history, found)
    values["peak_line_load"] = _bar(run, "peak_line_load", line_load, sharp, history)
    apart = _certainly_separated(run, history)
    for name in ZERO_WITHOUT_CONTACT:
        values[name][apart] = 0.0
    warnings = singular_warnings(values["peak_pressure"], run.problem.indenter, issued)
    return ErrorBars(values, warnings)


def unknown_bars(count: int) -> ErrorBars:
    """Errors that are not known, over a number of times.

    Examples
    --------
    >>> unknown_bars(2).values["force"]
    array([nan, nan])
    """
    return ErrorBars({name: np.full(count, np.nan) for name in ERROR_MODELS}, ())


@dataclass(frozen=True, eq=False)
class _ContactKinds:
    """Times at which a contact reaches the body's end, and consists of spots of few cells."""

    at_end: NDArray[np.bool_]
    of_spots: NDArray[np.bool_]


def _bar(
    run: RunSetup, name: str, levels: RefinementLevels, places: _ContactKinds, history: History
) -> Array:
    """Half width of the bars of one scalar over the run's times."""
    own = np.abs(levels.values[0])
    scale = moving_maximum(own)
    model = ERROR_MODELS[name]
    by_cells = model.of(levels)
    if model.at_end is not None:
        by_cells = np.where(places.at_end, model.at_end.of(levels), by_cells)
    if model.of_spots is not None:
        by_cells = np.where(places.of_spots, model.of_spots.of(levels), by_cells)
    nothing = np.where(np.isnan(by_cells), np.nan, 0.0)
    parts = [
        moving_maximum(np.divide(part, scale, out=nothing.copy(), where=scale > 0))
        for part in (by_cells, levels.by_steps)
    ]
    solver = SOLVER_ERROR_FACTOR * run.problem.tolerance + run.hereditary.error
    solver += run.problem.compliance.inversion_error
    bar = (parts[0] + np.nan_to_num(parts[1]) + solver) * scale
    bar = np.maximum(
        bar, _least_bar(run, name, by_cells > AGREEMENT_TOLERANCE * own, places, history)
    )
    return np.where(np.isnan(own), np.nan, bar)


def _least_bar(
    run: RunSetup, name: str, differs: NDArray[np.bool_], places: _ContactKinds, history: History
) -> Array | float:
    """Lower limit of the bars: parts of a cell for extents, the balance of moments for tilts."""
    if name in EXTENTS:
        cell = run.grid.cell_size[EXTENTS.index(name)]
        ragged = places.of_spots | places.at_end
        parts = np.where(ragged, UNSMOOTH_RIM_CELLS, RIM_CELLS)
        return np.asarray(np.where(differs, parts * cell, 0.0))
    if name in MOMENTS:
        # The solver's tolerance of the moments, force times extent, may tilt a symmetric body.
        axis = "contact_length" if name.endswith("x") else "contact_width"
        extent = np.nan_to_num(history[axis])
        slope = np.abs(history["approach"]) / np.maximum(extent, TINY)
        lever = extent if name.startswith("eccentricity") else slope
        tolerance = SOLVER_ERROR_FACTOR * run.problem.tolerance
        return np.asarray(np.where(extent > 0, tolerance * lever, 0.0))
    return 0.0


def _certainly_separated(run: RunSetup, history: History) -> NDArray[np.bool_]:
    """Times without contact, and without one that is lost or made next to them."""
    apart = np.asarray(history["peak_pressure"] == 0)
    if run.problem.load.control == "force":
        return apart
    return np.asarray(apart & ~(moving_maximum(~apart, 1) > 0))
