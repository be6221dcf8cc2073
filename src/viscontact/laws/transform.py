"""How a curve through points answers an oscillation, without a fit.

With t on a fine grid on which f is a straight line in ln t, f' = b/t on each step, and

    i omega L[f](i omega) = f(0) + Σ b_k [E1(i omega t_k) - E1(i omega t_k+1)]

is exact, with the exponential integral E1 (Abramowitz & Stegun 1964, 5.1.1). The grid is refined
until the result stands.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import exp1

from viscontact.laws.curve import LogCurve

Floats = NDArray[np.float64]

# The grid reaches so much ahead of the shortest period, where exp(-i omega t) = 1 - i omega t,
_AHEAD = 1e-8
# and so far beyond the longest, where what is left out has averaged away.
_BEYOND = 1e6
_TOLERANCE = 1e-9
_MOST_HALVINGS = 7
_TOGETHER = 32  # frequencies transformed at once, to bound the memory


def oscillating(curve: LogCurve, omega: Floats) -> NDArray[np.complex128]:
    """Return i omega L[f](i omega) of a curve f at angular frequencies > 0 [rad/s].

    For the creep compliance Phi it is the complex compliance, for G the complex modulus.
    """
    ordered, where = np.unique(omega, return_inverse=True)
    parts = [_refined(curve, ordered[i : i + _TOGETHER]) for i in range(0, ordered.size, _TOGETHER)]
    return np.concatenate(parts)[where].reshape(omega.shape)


def _refined(curve: LogCurve, omega: Floats) -> NDArray[np.complex128]:
    grid = _grid(curve, omega)
    rough = _of_lines(curve, grid, omega)
    limit = rough
    for _ in range(_MOST_HALVINGS):
        grid = np.sort(np.concatenate([grid, np.sqrt(grid[:-1]) * np.sqrt(grid[1:])]))
        better = _of_lines(curve, grid, omega)
        before, limit = limit, better + (better - rough) / 3  # of second order in the step
        if (np.abs(limit - before) <= _TOLERANCE * np.abs(limit)).all():
            break
        rough = better
    return limit


def _grid(curve: LogCurve, omega: Floats) -> Floats:
    """Return the curve's points with at most a quarter of a decade between them."""
    first = min(curve.times[0], _AHEAD / omega[-1])
    last = max(curve.times[-1], _BEYOND / omega[0])
    count = int(np.ceil(4 * np.log10(last / first))) + 1
    # A point beside one of the curve's would only be a tiny step.
    between = np.geomspace(first, last, count)
    nearest = curve.times[np.clip(np.searchsorted(curve.times, between), 0, curve.times.size - 1)]
    before = curve.times[np.clip(np.searchsorted(curve.times, between) - 1, 0, None)]
    apart = (np.abs(between / nearest - 1) > 1e-3) & (np.abs(between / before - 1) > 1e-3)
    return np.unique(np.concatenate([[first], curve.times, between[apart], [last]]))


def _of_lines(curve: LogCurve, grid: Floats, omega: Floats) -> NDArray[np.complex128]:
    values, phase = curve(grid), 1j * omega[:, None] * grid
    slopes = np.diff(values) / np.diff(np.log(grid))
    integrals = exp1(phase)
    start = grid[:1]
    before = curve.mean(0 * start, start)[0]
    early = values[0] + phase[:, 0] * (before - values[0])
    steps = (integrals[:, :-1] - integrals[:, 1:]) @ slopes
    return np.asarray(early + steps + slopes[-1] * integrals[:, -1])
