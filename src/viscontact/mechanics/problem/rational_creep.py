"""Prony series of a creep compliance whose Laplace transform is known.

The transform s L[J] = J_0 + Σ J_i/(1 + s τ_i) + φ/s of a body of springs and dashpots is a rational
function with simple negative poles -1/τ_i and positive amplitudes. Its values at real s are
interpolated by a rational function in barycentric form,

    r(s) = Σ_j w_j f_j/(s - s_j) / Σ_j w_j/(s - s_j),

at points added where the relative error is largest, with the weights of the least error at the
others (AAA). It has the same poles; the amplitudes follow by non-negative least squares at i ω.

References
----------
Y. Nakatsukasa, O. Sète, L. N. Trefethen, SIAM J. Sci. Comput. 40 (2018) A1494.
"""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats, Numbers
from viscontact.bodies.materials.compliance import SeriesCompliance

#: Relative error at which no point is added.
CLOSE = 1e-6

#: Imaginary part over the absolute value of a pole that is real.
REAL = 1e-6

#: Factor by which the rates of poles may lie beyond their bounds, of fluids below.
BEYOND, SLOWER = 2.0, 1e6


def series_of_transform(
    s: Numbers,
    omega: Numbers,
    at_s: Numbers,
    at_omega: Numbers,
    rates: tuple[float, float],
    *,
    flows: bool,
) -> SeriesCompliance:
    """Prony series, with amplitudes >= 0, of f = s L[J] at s [1/s] and i ω [rad/s], ascending."""
    # f(s) is positive, f(i ω) complex [1/Pa]; `rates` bound the rates 1/τ of creep [1/s]. A body
    # that `flows` without end may creep ever more slowly before.
    poles = _poles(s, at_s)
    real = poles.real[np.abs(poles.imag) < REAL * np.abs(poles)]
    slow, fast = rates[0] / (SLOWER if flows else BEYOND), rates[1] * BEYOND
    times = np.unique(-1 / real[(-real > slow) & (-real < fast)])
    parts = [np.ones(omega.size), *(1 / (1 + 1j * omega * time) for time in times)]
    parts += [omega[0] / (1j * omega)] if flows else []
    found = _amplitudes(np.stack(parts, axis=1), at_omega)
    fluidity = float(found[-1] * omega[0]) if flows else 0.0
    return SeriesCompliance(found[0], found[1 : times.size + 1], times, fluidity)


def _poles(s: Numbers, f: Numbers) -> Numbers:
    """Poles of the rational interpolant of f(s)."""
    rest = np.ones(s.size, bool)
    points: list[int] = []
    found = np.full(f.shape, np.sqrt(f.min() * f.max()))
    while len(points) < s.size // 2:
        added = int((np.abs(1 - found / f) * rest).argmax())
        points.append(added)
        rest[added] = False
        # s/(s - s_j) rather than 1/(s - s_j): of order one at all s.
        parts = s[rest, None] / (s[rest, None] - s[points])
        errors = (1 - f[points] / f[rest, None]) * parts
        size = np.abs(errors).max(axis=0)
        size[size == 0] = 1.0  # f is constant
        weights = np.linalg.svd(errors / size)[2][-1] / size
        found = f.copy()
        found[rest] = parts @ (weights * f[points]) / (parts @ weights)
        if np.abs(1 - found / f).max() < CLOSE:
            break
    # Zeros of Σ w_j/(s - s_j), as eigenvalues of an arrow matrix.
    arrow = np.diag(np.append(0.0, s[points]))
    arrow[0, 1:], arrow[1:, 0] = weights, 1.0
    poles = scipy.linalg.eigvals(arrow, np.diag(np.append(0.0, np.ones(len(points)))))
    return np.asarray(poles[np.isfinite(poles)])


def _amplitudes(parts: Numbers, wanted: Numbers) -> Floats:
    """Amplitudes >= 0 of the columns for the least relative error of their sum."""
    scale = float(np.abs(wanted).max())
    columns = parts * (scale / np.abs(wanted))[:, None]
    relative = wanted / np.abs(wanted)
    rows = np.concatenate([columns.real, columns.imag])
    found, _ = scipy.optimize.nnls(
        rows, np.concatenate([relative.real, relative.imag]), maxiter=100 * rows.shape[1]
    )
    return np.asarray(found * scale)
