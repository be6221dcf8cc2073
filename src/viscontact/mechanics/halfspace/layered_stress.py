"""Stress influence coefficients of a uniformly loaded rectangle on elastic layers.

In the uppermost layer the stresses are those of a half-space of its material (`stress_influence`)
plus a correction; farther down the correction is the whole. Its transforms X, Y, S, T
(`stack_waves`) decay as e^(-q h) or faster, where h is the thickness of the uppermost layer, so
that it is smooth on this scale. With the transforms over the distance r from a point load,

    A_F(r) = (1/2π) ∫_0^∞ F(q) J1(q r) dq,    C(r) = (1/2π) ∫_0^∞ T(q) J0(q r) dq,

each corner (x, y) of a rectangle contributes to the double difference over its corners

    σxx: I_X(x, y) + I_Y(y, x),    σyy: I_Y(x, y) + I_X(y, x),    σzz: I_S(x, y) + I_S(y, x),
    σxz: -∫_0^y C dy',    σyz: -∫_0^x C dx',    σxy: ∫_0^r (A_X - A_Y) dr',

    I_F(x, y) = x ∫_0^y A_F(r')/r' dy',    r'² = x² + y'².

The correction of small cells is interpolated from that of some of them (`sampled_cells`).

With y' = s sinh t, s² = x² + h², the integrands are analytic in a strip of half width π/2,
whatever the sizes of cells and layers, and Gauss's rule converges at a known rate. A_F and C are
integrated along a ray of complex wave numbers, as in `smooth_kernel`. The Hankel function H1 has a
pole at q = 0; going round it from the real axis to the ray adds F(0) θ/(π² r) to A_F, where θ is
the ray's angle.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
import scipy

from viscontact.backend.arrays import Floats, Integers, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.sampled_cells import SampledCells, sampled_cells
from viscontact.mechanics.halfspace.smooth_kernel import (
    DEGREE,
    LONGEST_WAVE,
    MIRRORED,
    STEP,
    extended,
)
from viscontact.mechanics.halfspace.stack_waves import (
    StackWaves,
    WaveStresses,
    layer_at,
    poisson_ratio_at,
    stack_waves,
)
from viscontact.mechanics.halfspace.stress_influence import stress_coefficients
from viscontact.mechanics.halfspace.stress_response import HalfSpaceStress, PressureStress

#: Direction of the ray of integration, and step of the logarithm of the wave number on it.
ANGLE, LOG_STEP = np.pi / 8, 0.07

#: Wave number times the thickness of the uppermost layer beyond which nothing is left.
SHORTEST_WAVE = 45.0

#: Decimal digits to which Gauss's rule integrates.
DIGITS = 12.0

#: Amplitude, and value of a Hankel function, that is nothing, and the imaginary part of the
#: argument from which on the function is.
TINY, FADED = 1e-100, 240.0

#: Places of the transforms in a table.
ALONG, ACROSS, NORMAL, SHEAR = range(4)


@dataclass(frozen=True)
class LayeredStress(PressureStress):
    """Stresses in an elastic stack."""

    stack: ElasticStack

    @property
    def _length(self) -> float:
        """Scale on which the correction is smooth [m]."""
        return self.stack.layers[0].thickness

    def poisson_ratio_at(self, depth: float) -> float:
        """Poisson's ratio of the layer, or of the base."""
        return poisson_ratio_at(self.stack, depth)

    def waves(self, wave_number: Floats) -> Callable[[float], WaveStresses]:
        """Stresses of waves over the depth."""
        waves = stack_waves(self.stack, wave_number.ravel())

        def at(depth: float) -> WaveStresses:
            found = waves.stresses(depth)
            parts = (found.along, found.across, found.normal, found.shear)
            return WaveStresses(*(np.reshape(part, wave_number.shape) for part in parts))

        return at

    def coefficients(self, x_edges: Floats, y_edges: Floats, depth: float) -> Floats:
        """Stresses at a point per unit pressure on cells, as in `stress_coefficients` [-]."""

        def corners(x: Floats, y: Floats, reach: float) -> Floats:
            return _corner_terms(self._table(depth, reach), x, y)

        found = sums_of_corners(corners, x_edges / self._length, y_edges / self._length)
        if layer_at(self.stack, depth) == 0:
            nu = self.stack.layers[0].poisson_ratio
            found += stress_coefficients(x_edges, y_edges, depth, nu)
        return np.asarray(found)

    @cached_property
    def _rays(self) -> dict[int, StackWaves]:
        return {}

    def _table(self, depth: float, reach: float) -> _Table:
        """Table of the transforms for distances up to `reach` in units of the length."""
        count = int(np.ceil(np.arcsinh(reach) / STEP)) + MIRRORED
        q, hankel = hankel_rule(count)
        if count not in self._rays:
            self._rays[count] = stack_waves(self.stack, q / self._length)
        found = self._rays[count].stresses(depth)
        amplitudes = np.stack([found.along, found.across, found.normal, found.shear])
        if layer_at(self.stack, depth) == 0:
            own = HalfSpaceStress(self.stack.layers[0].poisson_ratio)
            free = own.waves(q / self._length)(depth)
            parts = (free.along, free.across, free.normal, free.shear)
            amplitudes = amplitudes - np.stack([part * free.decay for part in parts])
        return _hankel_table(amplitudes, count, q, hankel)


@dataclass(frozen=True, eq=False)
class _Table:
    """Splines over asinh r of A_F/r (F = X, Y, S) and C, and of the integral of A_X - A_Y."""

    transforms: Any
    difference: Any


@lru_cache(maxsize=4)
def hankel_rule(count: int) -> tuple[Numbers, tuple[Numbers, Numbers]]:
    """Wave numbers on the ray, and H0 and H1 with the weights of its integral; (r, q)."""
    r = np.sinh(STEP * np.arange(0.5, count))
    log_longest = np.log(LONGEST_WAVE / r[-1])
    steps = int(np.ceil((np.log(SHORTEST_WAVE) - log_longest) / LOG_STEP))
    q = np.exp(1j * ANGLE + log_longest + LOG_STEP * np.arange(steps + 1))
    argument, weights = np.multiply.outer(r, q), q * (LOG_STEP / (2 * np.pi))
    # Decayed to nothing where SciPy finds no number, as in thin layers on long lines.
    decayed = argument.imag > FADED
    near = np.where(decayed, 1.0, argument)
    h0, h1 = (
        np.where(decayed, 0.0, without_tiny(scipy.special.hankel1(order, near) * weights))
        for order in (0, 1)
    )
    return q, (h0, h1)


def without_tiny(values: Numbers) -> Numbers:
    """Values with zeros in place of those that would make products slow by underflow."""
    return np.where(np.abs(values) < TINY, 0.0, values)


@lru_cache(maxsize=256)
def _gauss(count: int) -> tuple[Floats, Floats]:
    return np.polynomial.legendre.leggauss(count)


def hankel_at_zero(amplitudes: Numbers, r: Floats) -> Floats:
    """What going round the pole of H1 at q = 0 adds to transforms over distances, (r, f)."""
    return np.asarray(amplitudes[:, 0].real * (ANGLE / np.pi**2) / r[:, None])


def _hankel_table(amplitudes: Numbers, count: int, q: Numbers, hankel: tuple[Any, Any]) -> _Table:
    amplitudes = without_tiny(amplitudes)
    t = STEP * np.arange(0.5, count)  # none at r = 0, where H1 is singular
    r = np.sinh(t)
    # A tenth of the time of a product of matrices.
    lengthwise = np.einsum("rq,fq->rf", hankel[1], amplitudes[:SHEAR]).real
    lengthwise += hankel_at_zero(amplitudes[:SHEAR], r)
    shear = np.einsum("rq,q->r", hankel[0], amplitudes[SHEAR]).real
    values = np.concatenate([lengthwise / r[:, None], shear[:, None]], axis=1)
    # Over dr = cosh(t) dt: A is odd, so is this integrand.
    slope = (lengthwise[:, ALONG] - lengthwise[:, ACROSS]) * np.cosh(t)
    transforms, rate = (
        scipy.interpolate.make_interp_spline(*extended(t, each, sign), k=DEGREE)
        for each, sign in ((values, 1), (slope, -1))
    )
    return _Table(transforms, rate.antiderivative())


def sums_of_corners(
    corners: Callable[[Floats, Floats, float], Floats], x_edges: Floats, y_edges: Floats
) -> Floats:
    """Double differences of corner terms over cells, interpolated from those of some of them.

    `corners` takes the edges of these, and the reach of all; lengths are those of the correction.
    """
    x, y = _sampled_edges(x_edges), _sampled_edges(y_edges)
    terms = corners(x.edges, y.edges, float(np.hypot(*(np.abs(e.edges).max() for e in (x, y)))))
    sampled = np.diff(np.diff(terms, axis=1)[:, x.cells], axis=2)[:, :, y.cells]
    return np.asarray(x.at_all(y.at_all(sampled, axis=2), axis=1))


def _sampled_edges(edges: Floats) -> SampledCells:
    """Cells that stand for a row, as the correction is analytic to a distance of one length."""
    widths = np.diff(edges)
    is_even = np.allclose(widths, widths[0], rtol=1e-6, atol=0.0)
    return sampled_cells(edges, 1.0 if is_even else 0.0)


def _corner_terms(table: _Table, x: Floats, y: Floats) -> Floats:
    """Corner terms of all components; a cell's stress is their double difference; (6, nx, ny)."""
    (x_sizes, x_places), (y_sizes, y_places) = (
        np.unique(np.abs(each), return_inverse=True) for each in (x, y)
    )

    def transforms(near: Floats, r: Floats) -> Floats:
        return np.asarray(table.transforms(np.arcsinh(r)))

    along_y = integrals_along(transforms, x_sizes, y_sizes)
    along_x = integrals_along(transforms, y_sizes, x_sizes).swapaxes(1, 2)
    near_x, near_y = x_sizes[:, None], y_sizes[None, :]
    xx, yy, zz = (
        near_x * along_y[one] + near_y * along_x[other]
        for one, other in ((ALONG, ACROSS), (ACROSS, ALONG), (NORMAL, NORMAL))
    )
    xy = table.difference(np.arcsinh(np.hypot(near_x, near_y)))
    found = np.stack([xx, yy, zz, -along_x[SHEAR], -along_y[SHEAR], xy])
    odd_x, odd_y = np.sign(x)[:, None], np.sign(y)[None, :]
    one = np.ones((x.size, y.size))
    both = odd_x * odd_y
    signs = np.stack([both, both, both, odd_x * one, odd_y * one, one])
    return np.asarray(found[:, x_places[:, None], y_places[None, :]] * signs)


def integrals_along(
    integrand: Callable[[Floats, Floats], Floats], near: Floats, along: Floats
) -> Floats:
    """Integrals over y' from 0 to ascending y (`along`) at x (`near`); (functions, x, y).

    The integrand takes x and r, and returns its functions along a last axis.
    """
    scale = np.hypot(near, 1.0)
    ends = np.arcsinh(along[None, :] / scale[:, None])
    starts = np.concatenate([np.zeros((near.size, 1)), ends[:, :-1]], axis=1)
    middle, half = (ends + starts) / 2, (ends - starts) / 2
    pieces: list[Floats] = [np.empty(0)] * along.size
    counts = _nodes(half.max(axis=0))
    for count in np.unique(counts):
        nodes, weights = _gauss(int(count))
        own = np.flatnonzero(counts == count)
        t = middle[:, own, None] + half[:, own, None] * nodes
        r = np.hypot(near[:, None, None], scale[:, None, None] * np.sinh(t))
        weighted = half[:, own, None] * weights * scale[:, None, None] * np.cosh(t)
        values = integrand(near[:, None, None], r)
        found = np.einsum("xykf,xyk->yfx", values, weighted)
        for place, piece in zip(own.tolist(), found, strict=True):
            pieces[place] = piece
    return np.cumsum(np.stack(pieces, axis=2), axis=2)


def _nodes(half: Floats) -> Integers:
    """Nodes of Gauss's rule over intervals of t, of a function analytic to a distance of π/2."""
    slope = np.pi / 2 / np.maximum(half, 1e-9)
    gained = np.log10(slope + np.sqrt(1 + slope**2))
    return np.maximum(np.ceil(DIGITS / (2 * gained)), 1).astype(int)
