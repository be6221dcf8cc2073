"""Error bars of a run's scalars, estimated from coarser runs.

On grids of cells h a scalar differs by c (h2^p - h1^p); each pair of grids gives c, and the largest
one counts, since the rim's position between cells scatters and a single difference may be small by
accident. The error of the time steps follows in the same way from a run with halved steps on one of
the grids. The largest relative difference at an instant and the ones next to it counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import field, replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.variables import scalars_with_error
from viscontact.simulation.accuracy.coarser_results import (
    CoarserResult,
    History,
)
from viscontact.simulation.accuracy.coarser_runs import (
    creeps,
    march_coarser_run,
    plan_coarser_runs,
)
from viscontact.simulation.accuracy.error_models import (
    COARSE_SPOT_CELLS,
    ERROR_MODELS,
    MOVING_MODELS,
    ErrorModel,
)
from viscontact.simulation.accuracy.event_bars import (
    event_errors,
    pull_off_errors,
    segment_end_errors,
    set_bars_at_events,
    widen_after_events,
    with_least_errors,
)
from viscontact.simulation.accuracy.filled_periods import zero_over_periods
from viscontact.simulation.accuracy.first_and_last_contact import (
    before_loss,
    bound_by_few_cells,
    bound_by_first_contact,
    bound_in_first_cells,
    certainly_separated,
    touching_times,
    zero_without_contact,
)
from viscontact.simulation.accuracy.least_bars import (
    MOMENTS,
    ContactKinds,
    agrees,
    least_bar,
)
from viscontact.simulation.accuracy.least_peak_bars import least_peak_bar
from viscontact.simulation.accuracy.refinement_levels import (
    CUMULATIVE,
    RefinementLevels,
    beside_peak,
    between_known,
    end_flags,
    moving_maximum,
    moving_minimum,
    quotient,
    rises_to_ends,
    spots_across,
)
from viscontact.simulation.accuracy.rim_cells import EXTENTS, least_extent_of_area, recedes
from viscontact.simulation.accuracy.singular_peaks import (
    coarse_peak_warnings,
    peak_bars,
    singular_warnings,
    unbounded_peak,
)
from viscontact.simulation.accuracy.step_errors import estimated_by_steps, while_receding
from viscontact.simulation.transient.setup import RunSetup

#: Scalars whose errors a creeping body keeps after the contact has left the end.
ERRORS_KEPT = (
    *("force", "eccentricity_x", "eccentricity_y"),
    *("approach", "tilt_x", "tilt_y", "work", "loss_per_cycle"),
)

#: Width of the spots over the cells in contact along a line, from which on they are one. The width
#: is the least of coarser grids, which may miss cells at the rim.
ONE_SPOT = 0.7

#: Factor of the bars of bodies that are coupled by friction, whose tractions converge more slowly.
COUPLED = 2.0

#: Error of extents over that which a rim as uncertain as the area would cause.
EXTENT_OF_AREA = 0.75

#: How many times as large bars are at the last instant before a contact is lost: errors grow until
#: the loss, and many of the largest were there.
BEFORE_LOSS = 2.0

#: Scalars of bodies that adhere that the fronts of contact and cohesive zone move to and fro as
#: they cross the cells, with errors of one size and changing sign: grids agree at some instants by
#: chance. Their bars are at least this part of the median one of the contact.
MOVED_BY_FRONTS = (
    *("force", "approach", "contact_area", "contact_length", "contact_width", "least_pressure"),
)
PART_OF_MEDIAN = 0.7

#: Part of the largest errors so far of moments that a creeping body keeps: while a contact hardly
#: grows, its rim stays among the same cells, and coarser grids may agree for long by chance.
KEPT_OF_MOMENTS = 0.35


@dataclass(frozen=True, eq=False)
class ErrorBars:
    """Estimated errors of a run's scalars."""

    #: Half widths of the bars by scalar, in its unit, over the run's times: inf where the scalar
    #: has no limit, NaN where the error is unknown.
    values: dict[str, Floats]
    warnings: tuple[str, ...]  # warnings that follow from the coarser runs
    #: Attributes of the result that they replace: the errors of the instants of events.
    attributes: Mapping[str, str | float | list[float]] = field(default_factory=dict)


def error_bars(
    run: RunSetup,
    history: History,
    on_step: Callable[[], None] | None = None,
    *,
    issued: Sequence[str] = (),
) -> ErrorBars:
    """Errors of a run's scalars from coarser runs, with 95 %; `issued` are its warnings so far."""
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
        return unknown_bars(history)
    kinds = _contact_kinds(run, history, found)
    values = {
        name: _bar(run, name, RefinementLevels.of(name, history, found), kinds, history)
        for name in ERROR_MODELS
        if name in history
    }
    _widen_extents(values, kinds, history, found)
    values["contact_area"] = bound_by_few_cells(values["contact_area"], history)
    least_peak = least_peak_bar(run, kinds, history)
    values["peak_pressure"] = np.fmax(values["peak_pressure"], least_peak)
    values["mean_pressure"] = _mean_pressure_bar(history, values)
    left_out = run.mesh is not None and "peak" in run.mesh.warnings
    values["peak_pressure"] = peak_bars(values["peak_pressure"], history, found, left_out=left_out)
    # A sharp corner of the body has the same effect on the line load as its end.
    sharp = replace(kinds, at_end=kinds.at_end | np.isinf(values["peak_pressure"]))
    line_load = RefinementLevels.of("peak_line_load", history, found)
    values["peak_line_load"] = _bar(run, "peak_line_load", line_load, sharp, history)
    ends = with_least_errors(segment_end_errors(run, found), values, run, history)
    widen_after_events(values, run, history, ends)
    touching = touching_times(history, found)
    bound_in_first_cells(values, history)
    bound_by_first_contact(values, history)
    apart = certainly_separated(run, history, touching)
    zero_without_contact(run, values, apart, touching)
    zero_over_periods(values, run, history, found)
    peaks = values["peak_pressure"]
    warnings = singular_warnings(peaks, run.problem.indenter, issued)
    warnings += coarse_peak_warnings(peaks, least_peak, history)
    set_bars_at_events(values, run, history)
    attributes = event_errors(run, ends) | pull_off_errors(run, found)
    return ErrorBars(values, warnings, attributes)


def _contact_kinds(run: RunSetup, history: History, results: list[CoarserResult]) -> ContactKinds:
    """Kinds of contact over the run's times, by its coarser runs."""
    times = history["time"]
    at_end = moving_maximum(end_flags(times, results)) > 0
    spots = spots_across(times, results)
    spots = np.where(np.isnan(spots), moving_minimum(spots), spots)
    of_spots = (spots < COARSE_SPOT_CELLS) & _in_several_spots(run, history, spots)
    # A creeping body keeps the error of a contact that has reached the end.
    creeping = creeps(run.problem.surface.creep, times)
    ended = np.logical_or.accumulate(at_end) if creeping else at_end
    singular = moving_maximum(unbounded_peak(history, results)) > 0
    drops, exponents, bends = beside_peak(times, results)
    rises = rises_to_ends(times, results)
    return ContactKinds(at_end, ended, of_spots, singular, rises, drops, exponents, bends)


def _in_several_spots(run: RunSetup, history: History, spots: Floats) -> Bools:
    """Instants at which a line along y or x crosses several spots of a mean width in cells."""
    if any(run.grid.periodic):
        return np.ones(len(spots), dtype=bool)
    lengths = [history["contact_length"], history["contact_width"]]
    cells = [
        quotient(history["contact_area"], length * size)
        for length, size in zip(lengths, reversed(run.grid.cell_size), strict=True)
    ]
    return np.asarray(spots < ONE_SPOT * np.minimum(*cells))


def _widen_extents(
    values: dict[str, Floats], kinds: ContactKinds, history: History, results: list[CoarserResult]
) -> None:
    """Raise the bars of extents to what the bar of the area makes of those of a round contact."""
    # All grids may have a line of cells too many, for as long as a contact stands; under a blunt
    # body that recedes, such a line is the last to leave.
    for name in EXTENTS:
        rows = RefinementLevels.of(name, history, results).values
        if not agrees(np.abs(rows[1:] - rows[0]), history[name]):
            least = least_extent_of_area(history, values["contact_area"])
            part = EXTENT_OF_AREA * (1 + kinds.steepness * recedes(history))
            values[name] = np.fmax(values[name], part * least)


def unknown_bars(history: History) -> ErrorBars:
    """Errors of the scalars of a history that are not known."""
    names = [name for name in scalars_with_error() if name in history]
    return ErrorBars({name: np.full(len(history["time"]), np.nan) for name in names}, ())


def _bar(
    run: RunSetup, name: str, levels: RefinementLevels, kinds: ContactKinds, history: History
) -> Floats:
    """Half width of the bars of one scalar over the run's times."""
    own = np.abs(levels.values[0])
    scale = moving_maximum(own)
    model = ERROR_MODELS[name]
    if not run.problem.motion.stands:
        model = MOVING_MODELS.get(name, model)
    area = history["contact_area"]
    by_cells = _by_cells(model, name, levels, kinds)
    # The relative error from the cells falls with their number in a growing contact; without
    # contact, what a scalar keeps has the errors of the instants around.
    cells = area / run.grid.cell_area
    count, over = np.maximum(cells, 1.0), quotient(by_cells, scale)
    part = model.of_neighbours
    nearby = _largest_nearby(count * over, part) / count
    relative = np.where(area > 0, nearby, _largest_nearby(over, part))
    carried = levels.carried(scale, cells, remembers=_remembers(run))
    relative = np.fmax(relative, quotient(_by_cells(model, name, carried, kinds), scale))
    if name in MOMENTS and _remembers(run):
        relative = np.fmax(relative, _kept(np.where(area > 0, count * over, np.nan)) / count)
    # What is prescribed does not differ between the grids.
    differs = between_known(by_cells) > run.problem.solver_error * scale
    part = model.of_left_out if levels.steps_shown.any() else model.of_time_error
    estimated = part * estimated_by_steps(name, levels, history)
    by_steps = np.fmax(levels.by_steps, np.where(differs, estimated, 0.0))
    relative += np.nan_to_num(quotient(by_steps, scale))
    receding = model.of_receding * while_receding(run, levels.left_out, history)
    receding = np.where(differs, receding * quotient(own, scale), 0.0)
    relative = np.fmax(relative, receding)
    relative += run.problem.solver_error + max(plan.error for plan in run.plans)
    relative += run.problem.surface.splitting_error + run.error_of_ends
    bar = (relative + run.problem.compliance.inversion_error) * scale
    bar = np.maximum(bar, least_bar(run, name, kinds, history, by_cells))
    if name not in CUMULATIVE:
        bar = np.where(before_loss(history), BEFORE_LOSS * bar, bar)
    bar = COUPLED * bar if run.problem.is_coupled else bar
    bar = _as_usual(run, name, bar, differs & (area > 0))
    return np.where(np.isnan(own), np.nan, bar)


def _as_usual(run: RunSetup, name: str, bar: Floats, here: Bools) -> Floats:
    """Bars of bodies that adhere at some instants, no less than a part of their median there."""
    known = here & np.isfinite(bar)
    if run.law is None or name not in MOVED_BY_FRONTS or not known.any():
        return bar
    return np.where(here, np.fmax(bar, PART_OF_MEDIAN * np.median(bar[known])), bar)


def _by_cells(
    model: ErrorModel, name: str, levels: RefinementLevels, kinds: ContactKinds
) -> Floats:
    """Error of a scalar from the cells by the kinds of contact, in its unit."""
    by_cells = model.of(levels)
    if model.at_end is not None:
        ended = kinds.ended if name in ERRORS_KEPT else kinds.at_end
        by_cells = np.where(ended, model.at_end.of(levels), by_cells)
    if model.steep is not None:
        by_cells = np.where(kinds.steep, model.steep.of(levels), by_cells)
    if model.of_spots is not None:
        by_cells = np.where(kinds.of_spots, model.of_spots.of(levels), by_cells)
    return by_cells


def _remembers(run: RunSetup) -> bool:
    """Test whether a contact depends on the loads before."""
    problem = run.problem
    slips_or_adheres = problem.friction is not None or run.law is not None
    return slips_or_adheres or not (problem.surface.creep.is_elastic and problem.motion.stands)


def _kept(relative: Floats) -> Floats:
    """Part of the largest error of moments so far that counts at an instant."""
    return np.asarray(KEPT_OF_MOMENTS * np.fmax.accumulate(relative))


def _largest_nearby(relative: Floats, part: float) -> Floats:
    """Largest error at an instant and, in part, at the ones next to it; in full where unknown."""
    known = between_known(relative)
    nearby = moving_maximum(known, 1)
    return np.where(np.isnan(relative), nearby, np.fmax(known, part * nearby))


def _mean_pressure_bar(history: History, values: dict[str, Floats]) -> Floats:
    """Bar of force over area from both; that of the peak without contact, or unknown."""
    area = history["contact_area"]
    least = area - values["contact_area"]
    # A rim too far outside makes both too large.
    error = np.fmax(values["force"], values["contact_area"] * history["mean_pressure"])
    bar = np.divide(error, least, out=np.full_like(area, np.nan), where=least > 0)
    return np.where(area > 0, bar, values["peak_pressure"])
