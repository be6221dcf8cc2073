"""Overlap of two measured curves in ln(time), and how far they are apart there."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

_SAMPLES = 200  # points along the overlap; the curves are linear between measured points


@dataclass(frozen=True, eq=False)
class TemperatureCurve:
    """Set of one temperature, increasing in ln(time) or -ln(ω): shapes (n,) and (columns, n)."""

    log_times: Floats
    log_columns: Floats

    def moved(self, log_a: float, log_b: float) -> TemperatureCurve:
        """Curve reduced by ln a_T in ln(time), and by ln b_T in ln(value)."""
        return TemperatureCurve(self.log_times - log_a, self.log_columns - log_b)


def mismatch(one: TemperatureCurve, other: TemperatureCurve) -> float:
    """Root mean square relative difference in the overlap [-]; NaN without one."""
    first = max(one.log_times[0], other.log_times[0])
    last = min(one.log_times[-1], other.log_times[-1])
    if not last > first:
        return float("nan")
    times = np.linspace(first, last, _SAMPLES)
    values = [
        np.array([np.interp(times, curve.log_times, column) for column in curve.log_columns])
        for curve in (one, other)
    ]
    # Each column counts by its share of the value: a loss of a hundredth of the modulus is
    # measured less accurately than the modulus, and matters less.
    shares = np.exp(values[0] + values[1])
    shares /= shares.sum(axis=0)
    return float(np.sqrt(np.mean(np.sum(shares * (values[0] - values[1]) ** 2, axis=0))))


def require_common_values(one: TemperatureCurve, other: TemperatureCurve) -> None:
    """Refuse two curves of which no column takes a value of the other one."""
    ends = [[(c.min(), c.max()) for c in curve.log_columns] for curve in (one, other)]
    if any(a[0] <= b[1] and b[0] <= a[1] for a, b in zip(*ends, strict=True)):
        return
    (low, high), (other_low, other_high) = (np.exp(each[0]) for each in ends)
    raise ValueError(
        f"they have no value in common: one lies within {low:.4g} and {high:.4g}, the other "
        f"within {other_low:.4g} and {other_high:.4g}"
    )
