"""Stresses in layers that creep differently: those of elastic stacks under weighted pressures.

By the correspondence principle (Lee 1955) the Laplace transform of the stresses under a wave of
pressure is that of the elastic stack of the moduli at s (`stack_waves`). With S for any of its
amplitudes, which are dimensionless, the sum

    S(q, z, s) ≈ Σ_m g_m(s) S_m(q, z),   g_0 = 1,   g_m = 1/(1 + s τ_m),

takes exponentials of times τ_m that are spread evenly in log τ over all rates of creep and
relaxation, between which the poles of S lie. The S_m follow by collocation at as many s_j: they are
sums of the stresses of elastic stacks, so that the stresses of a history of pressure are those of
these stacks under the pressures

    p_j(t) = Σ_m (B^-1)_mj [p(t) - ∫ e^(-(t - t')/τ_m) dp(t')],   B_jm = g_m(s_j)

(without the integral for m = 0). At the beginning and at the end of all creep the sum is exact.
Where one term is enough, the stresses are those of the present pressure. The error is the largest
one of the harmonic response over wave numbers and frequencies, over the largest stress under a wave
at the same depth; twice that is stated. Tractions have the stresses of sheared waves, of the same
poles, and their history the same weights.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import SeriesLaw
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.stack_waves import (
    antiplane_waves,
    interface_depths,
    stack_waves,
)
from viscontact.mechanics.problem.series_body import ANY_TIMES, Span, series_body

#: Error of the sum at which no times are added, numbers of times that are tried, and the largest
#: weight, which multiplies errors of rounding.
ENOUGH, COUNTS, LARGEST_WEIGHT = 3e-4, (1, 2, 3, 4, 5, 6, 8, 11, 15, 20, 26), 1e7

#: Stated error over the largest one found.
SAFETY = 2.0

#: Wave numbers and frequencies at which the error is measured, range of q times thickness, of the
#: thinnest layer and of all, and of ω over the slowest and fastest rate.
WAVES, FREQUENCIES, LONG, SHORT, MARGIN = 25, 24, 0.03, 8.0, 10.0

#: Ratio of s to the rates at the beginning and at the end of all creep, which fluids do not have.
BEYOND, BEYOND_FLUID = 1e6, 1e2


@dataclass(frozen=True, eq=False)
class StressHistory:
    """Elastic stacks whose stresses add up to those of creeping layers."""

    stacks: tuple[ElasticStack, ...]  # at the s_j
    times: Numbers  # τ_m [s]; none where the present pressure is enough
    weights: Numbers  # B^-1, transposed, shape (stacks, 1 + m) [-]
    error: float  # bound, over the largest stress under any wave at the same depth [-]

    def loads(self, instants: Numbers, load: Numbers, jumps: Numbers) -> Numbers:
        """Loads of the stacks [Pa], (stacks, instants, ...), by that at the instants [s].

        A pressure, or a traction along an axis.
        """
        # The load is linear between the instants, and jumps to its first value at the first one.
        # At a jump it jumps to its next value.
        found = np.empty((len(self.stacks), *load.shape))
        faded = np.repeat(load[None, 0], self.times.size, axis=0)
        times = self.times.reshape(-1, *[1] * (load.ndim - 1))
        for k, now in enumerate(load):
            if k:
                step, change = instants[k] - instants[k - 1], now - load[k - 1]
                ratio = step / times
                within = jumps[(jumps > instants[k - 1]) & (jumps <= instants[k])]
                kept = -np.expm1(-ratio) / ratio
                if within.size:
                    kept = np.exp(-(instants[k] - within[0]) / times)
                faded = np.exp(-ratio) * faded + kept * change
            terms = np.concatenate([now[None], now - faded])
            found[:, k] = np.tensordot(self.weights, terms, axes=1)
        return found


@lru_cache(maxsize=16)
def stress_history(
    body: Layered, span: Span = ANY_TIMES, *, sheared: bool = False
) -> StressHistory:
    """Separate the stresses of layers, for times of interest within a span [s].

    Those under tractions as well if `sheared`.
    """
    body, deviation = series_body(body, span)
    slow, fast, fluid = _rates(body)
    far = BEYOND_FLUID if fluid else BEYOND
    if fluid:
        slow /= BEYOND_FLUID
    omega = np.geomspace(slow / MARGIN, fast * MARGIN, FREQUENCIES)
    q, depths = _samples(body)
    amplitudes = partial(_amplitudes, q=q, depths=depths, sheared=sheared)
    full = np.array([amplitudes(_stack_at(body, 1j * each)) for each in omega])
    harmonic = amplitudes, omega, full
    best = _collocated(body, np.empty(0), np.array([np.sqrt(slow * fast)]), harmonic)
    for count in COUNTS:
        if best.error <= SAFETY * ENOUGH:
            break
        rates = np.geomspace(slow, fast, count)
        s = np.array([slow / far, *np.sqrt(rates[:-1] * rates[1:]), fast * far])
        tried = _collocated(body, 1 / rates, s, harmonic)
        if np.abs(tried.weights).max() > LARGEST_WEIGHT:
            break
        best = min(best, tried, key=lambda each: each.error)
    return replace(best, error=best.error + (deviation if best.times.size else 0.0))


def _collocated(
    body: Layered,
    times: Numbers,
    s: Numbers,
    harmonic: tuple[Callable[[ElasticStack], Numbers], Numbers, Numbers],
) -> StressHistory:
    """Sum with given times, exact at real s, and its error in the harmonic response.

    `harmonic`: the amplitudes of a stack, frequencies, and the amplitudes at these.
    """
    amplitudes, omega, full = harmonic
    stacks = tuple(_stack_at(body, float(each)) for each in s)
    at_s = np.array([amplitudes(stack) for stack in stacks])
    weights = np.linalg.inv(_functions(times, s))
    kernels = np.tensordot(weights, at_s, axes=1)
    missing = np.abs(np.tensordot(_functions(times, 1j * omega), kernels, axes=1) - full)
    error = float((missing.max(axis=(0, 2, 3)) / np.abs(full).max(axis=(0, 2, 3))).max())
    return StressHistory(stacks, times, weights.T, SAFETY * error)


def _functions(times: Numbers, s: Numbers) -> Numbers:
    """g_m at s, shape (s, 1 + times)."""
    fading = 1 / (1 + np.multiply.outer(s, times))
    return np.concatenate([np.ones((s.size, 1)), fading], axis=1)


def _samples(body: Layered) -> tuple[Numbers, list[float]]:
    """Wave numbers [1/m], and depths within all parts [m], at which the error is measured."""
    lengths = [layer.thickness for layer in body.layers]
    q = np.geomspace(LONG / sum(lengths), SHORT / min(lengths), WAVES)
    lower = interface_depths(_stack_at(body, 1.0))
    depths = []
    for top, bottom in zip([0.0, *lower[:-1]], lower, strict=True):
        depths += [top * (1 + 3e-9), (top + bottom) / 2, bottom]
    if not isinstance(body.base, str):
        depths += [lower[-1] * (1 + 3e-9), 2 * lower[-1]]
    return q, depths


def _amplitudes(stack: ElasticStack, q: Numbers, depths: list[float], *, sheared: bool) -> Numbers:
    """X, Y, S and T of a stack, and those of sheared waves with Z and V, shape (depths, 4, q)."""
    kinds = [stack_waves(stack, q)]
    if sheared:
        kinds.append(stack_waves(stack, q, sheared=True))
    antiplane = antiplane_waves(stack, q) if sheared else None
    found = []
    for depth in depths:
        at = [waves.stresses(depth) for waves in kinds]
        own = [part for each in at for part in (each.along, each.across, each.normal, each.shear)]
        found.append(own if antiplane is None else [*own, *antiplane.stresses(depth)])
    return np.array(found)


def _stack_at(body: Layered, s: Any) -> ElasticStack:
    """Elastic stack of the moduli at s."""
    constants = [_constants(material, s) for material in body.materials]
    assert not isinstance(body.bonded, bool)  # made a tuple
    layers = tuple(
        ElasticLayer(layer.thickness, *each, bonded=bonded)
        for layer, each, bonded in zip(body.layers, constants, body.bonded, strict=False)
    )
    base = None if isinstance(body.base, str) else ElasticBase(*constants[-1])
    return ElasticStack(layers, base)


def _constants(material: Material, s: Any) -> tuple[Any, Any]:
    """Shear modulus [Pa] and Poisson's ratio of a material at s."""
    assert isinstance(material.law, SeriesLaw)  # others are refused
    instant, amplitudes, times, fluidity = material.law.creep_series().terms
    creep = instant + (np.asarray(amplitudes) / (1 + s * np.asarray(times))).sum() + fluidity / s
    shear = 1 / (2 * creep)
    bulk = material.bulk_modulus
    if bulk is None:
        return shear, material.poisson_ratio
    return shear, (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))


def _rates(body: Layered) -> tuple[float, float, bool]:
    """Slowest and fastest rate of creep and of relaxation [1/s], and if a part flows."""
    rates, flows = [], False
    for material in body.materials:
        assert isinstance(material.law, SeriesLaw)  # others have been replaced
        instant, amplitudes, times, fluidity = material.law.creep_series().terms
        rates += (1 / np.asarray(times)).tolist()
        begun = float((np.asarray(amplitudes) / np.asarray(times)).sum()) + fluidity
        if begun and instant > 0:  # a body relaxes faster than it creeps, but not more than this
            rates.append(begun / instant + max(1 / np.asarray(times), default=0.0))
        flows = flows or fluidity > 0
    return (min(rates), max(rates), flows) if rates else (1.0, 1.0, False)
