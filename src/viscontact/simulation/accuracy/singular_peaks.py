"""Peak pressures that have no limit, or that the cells at the body's end do not resolve.

Pressure is singular at a point, a ridge or a corner of the body, and grows like the inverse square
root of the distance at a sharp end. At the end of a logarithmic profile it is finite: as the cells
shrink, its growth stops. On cells that are too large for such an end, the largest pressure lies in
the last cells, and the excess over the pressure before them is an estimate of its error.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.rounding import rounding_remedy
from viscontact.simulation.accuracy.coarser_results import CoarserResult, History, with_contact
from viscontact.simulation.accuracy.coarser_runs import MIN_ACROSS
from viscontact.simulation.accuracy.refinement_levels import (
    RefinementLevels,
    aligned,
    between_known,
    end_flags,
    moving_maximum,
    moving_mean,
)
from viscontact.simulation.accuracy.richardson import richardson
from viscontact.simulation.checks.singularities import DEPENDS_ON_MESH
from viscontact.units.formatting import format_quantity

#: Least growth of a peak without a limit as cells shrink by a factor e, over the mean pressure:
#: under a wedge it is 0.64, under a cone 1. So much must be found, and possible by the body's bend:
#: that of a smooth body can cause 0.4 over the cells on the contact's half width.
UNBOUNDED_GROWTH = 0.3

#: Least exponent of the growth with the cells of a peak next to the body's end that has no limit:
#: it is 1/2 at a sharp end, approached from below as the cells shrink (0.25 with 8 on a half
#: length), and at most 0.1 at the resolved end of a logarithmic profile.
UNBOUNDED_EXPONENT = 0.1

#: Least power of the cell size with which the bend of a body that is round there falls.
ROUND_BEND = 0.7

#: Largest pressures that differ by less than this part are the same.
SAME_PEAK = 1e-3

#: Error of a peak in the body's last cells over its excess over the pressure before them.
EXCESS_FACTOR = 2.0

#: Warning of a peak without a limit.
SINGULAR = (
    "the peak pressure has no limit as cells become smaller: it depends on the mesh, at a sharp "
    "edge, a point or a ridge of the body or at roughness that the grid does not resolve, and its "
    "error is given as infinite; resultants converge"
)

#: Least error of a finite peak by the body's shape, over the peak, that is warned of where the peak
#: is half of the run's largest.
COARSE_PEAK_ERROR = 0.2


def peak_bars(
    bars: Floats, history: History, results: Sequence[CoarserResult], *, left_out: bool = False
) -> Floats:
    """Bars of the peak pressure: widened at the body's end, and inf where it has no limit [Pa]."""
    # `left_out` if the automatic grid was refined without it, as it had no limit on finer cells.
    excess = EXCESS_FACTOR * moving_maximum(_end_excess(history["time"], results))
    widened = np.maximum(bars, np.nan_to_num(excess) * history["peak_pressure"])
    unbounded = unbounded_peak(history, results)
    if left_out:
        unbounded |= with_contact(history) & _at_end(history["time"], results)
    return np.where(unbounded, np.inf, widened)


def singular_warnings(
    bars: Floats, indenter: Indenter, issued: Sequence[str] = ()
) -> tuple[str, ...]:
    """Warning of infinite bars of the peak pressure, unless the run has given the reason."""
    is_known = any(DEPENDS_ON_MESH in text for text in issued)
    if is_known or not np.isinf(bars).any():
        return ()
    return (f"{SINGULAR}; {rounding_remedy(indenter)}",)


def coarse_peak_warnings(bars: Floats, least: Floats, history: History) -> tuple[str, ...]:
    """Warning of finite peaks whose least bars, by the shape beside them, are large."""
    peaks = history["peak_pressure"]
    counts = np.isfinite(bars) & (peaks >= np.max(peaks) / 2) & (peaks > 0)
    coarse = counts & (least > COARSE_PEAK_ERROR * peaks)
    if not coarse.any():
        return ()
    parts = np.where(coarse, bars / _positive(peaks), 0.0)
    worst = int(np.argmax(parts))
    return (
        f"the peak pressure is known to {parts[worst]:.0%} only, at "
        f"{format_quantity(history['time'][worst], 's')}: the pressure rises to it within few "
        "cells, as beside an edge or a tip of the body and at the rim of a stiff coating; use "
        "smaller cells if the peak matters",
    )


def unbounded_peak(history: History, results: Sequence[CoarserResult]) -> Bools:
    """Times at which the peak pressure has no limit, by the body's shape or by the grids."""
    contact = with_contact(history)
    if any(each.is_sharp for each in results):
        return contact
    levels = RefinementLevels.of("peak_pressure", history, list(results))
    at_end = _grows_at_end(history["time"], results, levels)
    return contact & (at_end | _does_not_converge(history, results, levels))


def _grows_at_end(
    times: Floats, results: Sequence[CoarserResult], levels: RefinementLevels
) -> Bools:
    """Times at which the largest pressure lies next to the body's end and grows with the cells."""
    finest = _finest(results)
    share = finest.end_pressures[:, 0] / _positive(finest.scalars["peak_pressure"])
    share = between_known(_at_times(times, finest, share))
    lies_there = moving_maximum(share) >= 1 - SAME_PEAK
    own, coarser = levels.values[0], levels.values[1:]
    growth = np.log(_positive(own) / _positive(coarser))
    exponents = growth / np.log(levels.spacings[1:])[:, None]
    # Between two instants of a coarser run as at one of them; an unknown growth has no limit.
    exponents = np.array([between_known(each) for each in exponents])
    bounded = moving_maximum(np.fmax.reduce(exponents)) <= UNBOUNDED_EXPONENT
    return np.asarray(_at_end(times, results) & lies_there & ~bounded)


def _does_not_converge(
    history: History, results: Sequence[CoarserResult], levels: RefinementLevels
) -> Bools:
    """Times at which the peaks of three grids grow without converging, where the body bends."""
    order = np.argsort(levels.spacings)
    if len(order) < 3:
        return np.zeros(len(history["time"]), dtype=bool)
    three = order[[0, 1, -1]]
    peaks = levels.values[three]
    spacings = np.array(levels.spacings)[three]
    known = np.isfinite(peaks).all(axis=0)
    verdict = richardson(np.where(known, peaks, 1.0), spacings)
    growth = (peaks[0] - peaks[-1]) / np.log(spacings[-1])
    grows = growth > UNBOUNDED_GROWTH * history["mean_pressure"]
    # A contact of few cells does not exist on the coarsest grid.
    fine = history["cells_across"] >= MIN_ACROSS * spacings[-1]
    finest, coarsest = _finest(results), max(results, key=lambda each: each.spacing)
    bends, coarser_bends = (
        _at_times(history["time"], each, each.bend_growth) for each in (finest, coarsest)
    )
    # Between cells a round edge bends in proportion to their size, a corner as much on any.
    falling = (coarsest.spacing / finest.spacing) ** ROUND_BEND
    bent = (bends > UNBOUNDED_GROWTH) & ~(coarser_bends > falling * bends)
    unbounded = np.where(known, ~verdict.converges & grows & fine & bent, np.nan)
    mean = moving_mean(unbounded)
    # Between instants that are farther apart than the window, as at one of the next ones.
    return np.asarray(np.where(np.isnan(mean), between_known(mean), mean) > 0.5)


def _end_excess(times: Floats, results: Sequence[CoarserResult]) -> Floats:
    """Relative excess of the peak near the body's end over the pressure farther from it [-]."""
    finest = _finest(results)
    inner = finest.end_pressures[:, 1] / _positive(finest.scalars["peak_pressure"])
    return _at_times(times, finest, np.clip(1 - inner, 0.0, 1.0))


def _at_end(times: Floats, results: Sequence[CoarserResult]) -> Bools:
    """Times at which the contact reaches the body's end, or has done so shortly before or after."""
    return np.asarray(moving_maximum(end_flags(times, list(results))) > 0)


def _finest(results: Sequence[CoarserResult]) -> CoarserResult:
    return min(results, key=lambda each: each.spacing)


def _at_times(times: Floats, result: CoarserResult, values: Floats) -> Floats:
    """Values at the instants of a coarser run, at a run's times; NaN where there are none."""
    scalars = {"time": result.scalars["time"], "values": values}
    return aligned("values", times, replace(result, scalars=scalars))


def _positive(values: Floats) -> Floats:
    """Values, NaN in place of zeros."""
    return np.where(values > 0, values, np.nan)
