"""Horizontal shift in ln(time) between two measured curves at two temperatures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import isotonic_regression, minimize_scalar

from viscontact.backend.arrays import Floats

_SAMPLES = 200  # points along the overlap; the curves are linear between measured points
_NEIGHBOURHOOD = np.log(10.0) / 2  # search range: half a decade to either side
_SCANNED = 41


@dataclass(frozen=True, eq=False)
class TemperatureCurve:
    """Set of one temperature, increasing in ln(time) or -ln(ω): shapes (n,) and (columns, n)."""

    log_times: Floats
    log_columns: Floats


def log_shift(slow: TemperatureCurve, fast: TemperatureCurve) -> tuple[float, float]:
    """Shift of the faster curve in ln(time) onto the slower one, and the mismatch [-].

    The mismatch is the root mean square relative difference in the overlap; NaN without one. The
    start is closed-form shifting (ISO 18437-6; Gergesova et al., J. Rheol. 55 (2011) 1-16): the
    mean distance in ln(time) over common values, after isotonic regression of the scatter. It needs
    no starting value and cannot diverge. From there the mean squared difference over the overlap in
    time is minimised; with several columns that of their vector relative to its length, so that
    losses count too.
    """
    start = _closed_form_shift(slow, fast)
    places = start + _NEIGHBOURHOOD * np.linspace(-1.0, 1.0, _SCANNED)
    least = _overlap(slow, fast, start) / 2  # a short overlap is no agreement
    mismatches = np.array([_mismatch(slow, fast, place, least) for place in places])
    best = int(np.argmin(mismatches))
    if not np.isfinite(mismatches[best]):
        return start, float("nan")
    around = places[max(best - 1, 0)], places[min(best + 1, _SCANNED - 1)]
    found = minimize_scalar(
        lambda place: _mismatch(slow, fast, place, least),
        bounds=around,
        method="bounded",
        options={"xatol": 1e-8},
    )
    return float(found.x), float(np.sqrt(found.fun))


def _closed_form_shift(slow: TemperatureCurve, fast: TemperatureCurve) -> float:
    rises = _trend(slow) + _trend(fast) > 0
    evened = [
        isotonic_regression(curve.log_columns[0], increasing=rises).x for curve in (slow, fast)
    ]
    lowest = max(values.min() for values in evened)
    highest = min(values.max() for values in evened)
    if not highest > lowest:
        raise ValueError(
            f"they have no value in common: one lies within {np.exp(evened[0].min()):.4g} and "
            f"{np.exp(evened[0].max()):.4g}, the other within {np.exp(evened[1].min()):.4g} and "
            f"{np.exp(evened[1].max()):.4g}"
        )
    values = np.linspace(lowest, highest, _SAMPLES)
    slow_times, fast_times = (
        _times_of(values, curve.log_times, along)
        for curve, along in zip((slow, fast), evened, strict=True)
    )
    return float(np.mean(slow_times - fast_times))


def _times_of(values: Floats, log_times: Floats, evened: Floats) -> Floats:
    """ln(time) at which a monotone curve takes given values; the middle where it is level."""
    distinct, where = np.unique(evened, return_inverse=True)
    middles = np.bincount(where, weights=log_times) / np.bincount(where)
    return np.interp(values, distinct, middles)


def _trend(curve: TemperatureCurve) -> float:
    centred = curve.log_times - curve.log_times.mean()
    return float(centred @ curve.log_columns[0])


def _overlap(slow: TemperatureCurve, fast: TemperatureCurve, shift: float) -> float:
    first, last = _common_span(slow, fast, shift)
    return last - first


def _common_span(
    slow: TemperatureCurve, fast: TemperatureCurve, shift: float
) -> tuple[float, float]:
    first = max(slow.log_times[0], fast.log_times[0] + shift)
    last = min(slow.log_times[-1], fast.log_times[-1] + shift)
    return float(first), float(last)


def _mismatch(slow: TemperatureCurve, fast: TemperatureCurve, shift: float, least: float) -> float:
    """Mean squared difference over the overlap; inf where that is too short."""
    first, last = _common_span(slow, fast, shift)
    if not last - first > max(least, 0.0):
        return np.inf
    times = np.linspace(first, last, _SAMPLES)
    one, other = (
        np.array([np.interp(at, curve.log_times, column) for column in curve.log_columns])
        for at, curve in ((times, slow), (times - shift, fast))
    )
    # Each column counts by its share of the value: a loss of a hundredth of the modulus is
    # measured less accurately than the modulus, and matters less.
    shares = np.exp(one + other)
    shares /= shares.sum(axis=0)
    return float(np.mean(np.sum(shares * (one - other) ** 2, axis=0)))
