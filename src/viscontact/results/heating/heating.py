"""Heating of a cover over time, with the power of its temperature at each instant."""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.results.heating.balances import Reach
from viscontact.results.heating.cover import Cover
from viscontact.results.heating.power_curve import PowerCurve

#: Rise of temperature for slopes [K], relative and absolute tolerance [K] of a heating.
_RISE, _RELATIVE, _ABSOLUTE = 1e-3, 1e-6, 1e-5


def heating(
    cover: Cover, area: float, curve: PowerCurve, speed: float, reach: Reach, times: Floats
) -> Floats:
    """Modes of a cover that starts to roll at its idle temperature, (times, modes).

    NaN from where its mean temperature leaves the reach of the curve.
    """
    stored, conducted = cover.matrices
    start, inflow = cover.steady(0.0), cover.inflow
    found = np.full((times.size, start.size), np.nan)
    if reach.is_empty or reach.low > cover.idle:
        return found
    found[0] = start
    inverse = np.linalg.inv(stored)

    def source(modes: Floats) -> Floats:
        within = np.clip(cover.mean(modes), reach.low, reach.high)
        return np.asarray(curve.power(within, speed)) / area

    def rate(time: float, modes: Floats) -> Floats:
        return inverse @ (source(modes) * cover.averages + inflow - conducted @ modes)

    def slopes(time: float, modes: Floats) -> Floats:
        rise = _RISE * cover.averages
        gained = float(source(modes + rise) - source(modes)) / float(cover.averages @ rise)
        return inverse @ (gained * np.outer(cover.averages, cover.averages) - conducted)

    def leaves(time: float, modes: Floats) -> float:
        return reach.high - float(cover.mean(modes))

    leaves.terminal = True  # type: ignore[attr-defined]
    done = scipy.integrate.solve_ivp(
        *(rate, (0.0, float(times[-1])), start),
        method="BDF",
        jac=slopes,
        t_eval=times,
        events=leaves,
        rtol=_RELATIVE,
        atol=_ABSOLUTE,
    )
    found[: done.y.shape[1]] = done.y.T
    return found
