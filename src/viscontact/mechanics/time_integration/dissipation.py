"""Energy that the dashpots of a retardation series lose in a step.

Each term of J is a Kelvin unit: its internal variable d follows τ d' = J q - d, and its dashpot
loses the power <J p - d_p, J q - d_q>/(J τ), with the internal variables d_p of the pressure p and
d_q of its unit displacement q = K p, and the sum <a, b> over the cells. Within a linear part of a
step J q - d is known as a function of time, so that the integral is exact (the fields' error is
that of the step).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.materials.compliance import SeriesCompliance

#: Ratio of duration and retardation time below which the integrals are taken from their series.
SMALL_RATIO = 1e-3


def power_lost(compliance: SeriesCompliance, variables: Floats, value: Floats) -> float:
    """Power lost at an instant, over the area of a cell [W/m²].

    `value`: pressure [Pa], unit displacement [Pa m], (2, nx, ny); `variables`: both, for each term.
    """
    power = compliance.fluidity * _product(value, value)
    for amplitude, time, variable in zip(
        compliance.amplitudes, compliance.times, variables, strict=False
    ):
        lag = amplitude * value - variable
        power += _product(lag, lag) / (amplitude * time)
    return float(power)


def heat_of_step(
    compliance: SeriesCompliance,
    variables: Floats,
    parts: Sequence[tuple[float, Floats, Floats]],
) -> float:
    """Energy lost over a step, over the area of a cell [J/m²].

    `variables` are the internal variables at its beginning, `parts` its linear parts: duration [s],
    and pressure and unit displacement at both ends.
    """
    heat = 0.0
    for duration, begin, end in parts:
        mean = _product(begin, begin) + _product(begin, end) + _product(end, end)
        heat += compliance.fluidity * duration * mean / 3
    begin = parts[0][1]
    for amplitude, time, variable in zip(
        compliance.amplitudes, compliance.times, variables, strict=False
    ):
        lag = amplitude * begin - variable
        for duration, first, last in parts:
            if duration == 0:
                continue
            limit = (amplitude * time / duration) * (last - first)
            heat += _heat_of_unit(lag, limit, duration, time) / float(amplitude * time)
            lag = limit + np.exp(-duration / time) * (lag - limit)
    return heat


def _heat_of_unit(lag: Floats, limit: Floats, duration: float, time: float) -> float:
    """Integral of <y, y> for y = lag e + limit (1 - e), e = exp(-t/time), over a duration [s]."""
    ratio = duration / time
    if ratio < SMALL_RATIO:
        once = ratio**2 * (1 - ratio * (1 - 7 * ratio / 12)) / 2
        twice = ratio**3 * (1 / 3 - ratio * (1 / 4 - 7 * ratio / 60))
    else:
        one, two = -np.expm1(-ratio), -np.expm1(-2 * ratio) / 2
        once, twice = one - two, ratio - 2 * one + two
    both = float(-np.expm1(-2 * ratio)) / 2
    product = both * _product(lag, lag)
    product += once * (_product(lag, limit) + _product(limit, lag))
    return float(time * (product + twice * _product(limit, limit)))


def _product(a: Floats, b: Floats) -> float:
    """Sum of the pressure of `a` times the unit displacement of `b`."""
    return float(np.einsum("ij,ij->", a[0], b[1]))
