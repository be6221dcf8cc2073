"""Random creep laws with their contact compliance J(t) and its means in closed form.

Nothing of `viscontact.laws` computes them: exponentials, powers and Mittag-Leffler's function of
order 1/2, E(-x) = exp(x²) erfc(x) (Mainardi 2010, Fractional Calculus and Waves in Linear
Viscoelasticity, appendix E). The retardation times of a relaxation series are the zeros of its
modulus (Tschoegl 1989, The Phenomenological Theory of Linear Viscoelastic Behavior, section 4.1).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import brentq
from scipy.special import erfcx

import viscontact as vc
from viscontact.reference.lag_means import lag_mean

Array = np.ndarray
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(10)


@dataclass(frozen=True)
class CreepSum:
    """J(t) = instant + Σ a (1 - exp(-t/τ)) + flow t + Σ c t^n [1/Pa], with its means over lags."""

    instant: float
    delayed: tuple[tuple[float, float], ...] = ()  # amplitude [1/Pa] and retardation time [s]
    flow: float = 0.0  # [1/(Pa s)]
    powers: tuple[tuple[float, float], ...] = ()  # factor [1/(Pa s^n)] and exponent n

    def __call__(self, t: Array) -> Array:
        t = np.asarray(t, dtype=float)
        crept = self.instant + self.flow * t
        for amplitude, time in self.delayed:
            crept = crept - amplitude * np.expm1(-t / time)
        for factor, exponent in self.powers:
            crept = crept + factor * t**exponent
        return crept

    def mean(self, start: Array, end: Array) -> Array:
        start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        length = end - start
        means = self.instant + self.flow * (start + end) / 2
        for amplitude, time in self.delayed:
            x = length / time
            decay = np.where(x > 0, -np.expm1(-x) / np.where(x > 0, x, 1.0), 1.0)
            means = means + amplitude * (1 - np.exp(-start / time) * decay)
        for factor, exponent in self.powers:
            means = means + factor * _mean_power(exponent, start, end)
        return means


def _mean_power(exponent: float, start: Array, end: Array) -> Array:
    """Mean of t^n over intervals; Gauss's rule where the difference of two powers would cancel."""
    length = end - start
    places = start[..., None] + length[..., None] / 2 * (1 + _NODES)
    narrow = places**exponent @ _WEIGHTS / 2
    power = exponent + 1
    wide = (end**power - start**power) / (power * np.where(length > 0, length, 1.0))
    return np.where(start >= length, narrow, wide)


@dataclass(frozen=True, eq=False)
class Creep:
    """A material and its exact contact compliance."""

    name: str
    material: vc.Material
    compliance: Callable[[Array], Array]  # J(t) [1/Pa]
    time: float  # characteristic time of the law [s]
    jumps: bool = True  # it has an instant compliance
    more: dict = field(default_factory=dict)  # further arguments of `simulate`


def scale(rng: np.random.Generator) -> tuple[float, float, float]:
    """Shear modulus [Pa], Poisson's ratio, and time [s]."""
    return 10 ** rng.uniform(6, 9), rng.uniform(0.2, 0.5), 10 ** rng.uniform(-1, 3)


def elastic(rng: np.random.Generator) -> Creep:
    shear, ratio, time = scale(rng)
    compliance = CreepSum((1 - ratio) / (2 * shear))
    return Creep("elastic", vc.Material(vc.Elastic(shear), ratio), compliance, time)


def zener(rng: np.random.Generator) -> Creep:
    shear, ratio, time = scale(rng)
    more = math.exp(rng.uniform(math.log(0.2), math.log(10)))
    law = vc.Zener(shear, shear / more, shear / more * time)
    part = (1 - ratio) / (2 * shear)
    return Creep("Zener", vc.Material(law, ratio), CreepSum(part, ((more * part, time),)), time)


def maxwell(rng: np.random.Generator) -> Creep:
    shear, ratio, time = scale(rng)
    part = (1 - ratio) / (2 * shear)
    law = vc.Maxwell(shear, shear * time)
    return Creep("Maxwell", vc.Material(law, ratio), CreepSum(part, flow=part / time), time)


def creep_series(rng: np.random.Generator) -> Creep:
    """Two to five retardation times, over one to three decades; some bodies flow."""
    shear, ratio, time = scale(rng)
    count = int(rng.integers(2, 6))
    times = time * np.geomspace(10 ** -rng.uniform(1, 3), 1.0, count)
    amplitudes = rng.uniform(0.2, 2.0, count) / (2 * shear)
    flow = rng.uniform(0.1, 1.0) / (2 * shear * time) if rng.random() < 0.3 else 0.0
    law = vc.CreepSeries(1 / (2 * shear), amplitudes.tolist(), times.tolist(), flow)
    part = 1 - ratio
    compliance = CreepSum(
        part / (2 * shear),
        tuple(zip((part * amplitudes).tolist(), times.tolist(), strict=True)),
        part * flow,
    )
    return Creep("creep series", vc.Material(law, ratio), compliance, time)


def relaxation_series(rng: np.random.Generator) -> Creep:
    """Two to four relaxation times; the compliance by the zeros of the modulus."""
    shear, ratio, time = scale(rng)
    count = int(rng.integers(2, 5))
    times = time * np.geomspace(10 ** -rng.uniform(1, 3), 1.0, count)
    moduli = shear * rng.uniform(0.2, 1.0, count)
    rest = shear * rng.uniform(0.1, 1.0)
    law = vc.RelaxationSeries(rest, moduli.tolist(), times.tolist())
    factor = 2 / (1 - ratio)
    compliance = inverse_of_relaxation(factor * rest, factor * moduli, times)
    return Creep("relaxation series", vc.Material(law, ratio), compliance, time)


def inverse_of_relaxation(rest: float, moduli: Array, times: Array) -> CreepSum:
    """Compliance to M = rest + Σ m exp(-t/τ), rest > 0: 1/(s m(s)) by partial fractions.

    m(s) = rest + Σ m s τ/(1 + s τ) has one zero -1/λ above each relaxation time; the residue
    there is -1/(s m'(s)).
    """
    order = np.argsort(times)
    tau, m = np.asarray(times)[order], np.asarray(moduli)[order]

    def modulus(logarithm: float) -> float:
        """m(-1/λ) with its poles multiplied away, λ = exp(logarithm)."""
        delay = math.exp(logarithm)
        factors = 1 - tau / delay
        whole = rest * np.prod(factors)
        for k in range(len(tau)):
            whole -= m[k] * tau[k] / delay * np.prod(np.delete(factors, k))
        return float(whole)

    delayed = []
    above = [*np.log(tau[1:]), math.log(tau[-1] * (1 + m.sum() / rest) * 10)]
    for k, high in enumerate(above):
        delay = math.exp(brentq(modulus, math.log(tau[k]), high, xtol=1e-14, rtol=1e-14))
        s = -1 / delay
        slope = float(np.sum(m * tau / (1 + s * tau) ** 2))
        # exp(s t)/(s m'(s)) is the decaying part, negative.
        delayed.append((-1 / (s * slope), delay))
    return CreepSum(1 / (rest + m.sum()), tuple(delayed))


def power_law(rng: np.random.Generator) -> Creep:
    shear, ratio, time = scale(rng)
    exponent, more = rng.uniform(0.15, 0.8), rng.uniform(0.3, 4.0)
    part = (1 - ratio) / (2 * shear)
    law = vc.PowerLaw(more / (2 * shear), exponent, time, 1 / (2 * shear))
    compliance = CreepSum(part, powers=((more * part / time**exponent, exponent),))
    return Creep("power law", vc.Material(law, ratio), compliance, time)


def power_law_without_instant(rng: np.random.Generator) -> Creep:
    shear, ratio, time = scale(rng)
    exponent = rng.uniform(0.2, 0.7)
    part = (1 - ratio) / (2 * shear)
    law = vc.PowerLaw(1 / (2 * shear), exponent, time)
    compliance = CreepSum(0.0, powers=((part / time**exponent, exponent),))
    return Creep("pure power law", vc.Material(law, ratio), compliance, time, jumps=False)


def fractional_maxwell(rng: np.random.Generator) -> Creep:
    shear, ratio, time = scale(rng)
    exponent = rng.uniform(0.2, 0.8)
    part = (1 - ratio) / (2 * shear)
    law = vc.FractionalMaxwell(shear, time, exponent)
    factor = part / (math.gamma(1 + exponent) * time**exponent)
    compliance = CreepSum(part, powers=((factor, exponent),))
    return Creep("fractional Maxwell", vc.Material(law, ratio), compliance, time)


@dataclass(frozen=True)
class HalfOrderCreep:
    """J(t) of a fractional Zener body of order 1/2: settled - delayed E_1/2(-(t/τ)^1/2) [1/Pa]."""

    settled: float
    delayed: float
    time: float

    def __call__(self, t: Array) -> Array:
        return self.settled - self.delayed * erfcx(np.sqrt(np.asarray(t, dtype=float) / self.time))

    def mean(self, start: Array, end: Array) -> Array:
        start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        length = end - start
        places = start[..., None] + length[..., None] / 2 * (1 + _NODES)
        narrow = self(places) @ _WEIGHTS / 2
        lost = self.time * (
            _swept_half_order(end / self.time) - _swept_half_order(start / self.time)
        )
        wide = self.settled - self.delayed * lost / np.where(length > 0, length, 1.0)
        return np.where(start >= length, narrow, wide)


def _swept_half_order(x: Array) -> Array:
    """Integral of exp(x) erfc(sqrt(x)) from 0; by its series where the closed form cancels."""
    small = np.minimum(x, 0.05)
    series = sum((-1) ** k * small ** (k / 2 + 1) / math.gamma(k / 2 + 2) for k in range(16))
    closed = erfcx(np.sqrt(x)) - 1 + 2 * np.sqrt(x / math.pi)
    return np.where(x < 0.05, series, closed)


def fractional_zener(rng: np.random.Generator) -> Creep:
    shear, ratio, time = scale(rng)
    stiffer = rng.uniform(1.5, 6.0)  # of the instant modulus over the settled one
    law = vc.FractionalZener(stiffer * shear, shear, time / stiffer**2, 0.5)
    part = (1 - ratio) / (2 * shear)
    compliance = HalfOrderCreep(part, part * (1 - 1 / stiffer), time)
    return Creep("fractional Zener", vc.Material(law, ratio), compliance, time)


def tabulated_creep(rng: np.random.Generator) -> Creep:
    """A table of 30 rows a decade, through which the law's curve is closer than 1e-5."""
    body = creep_series(rng) if rng.random() < 0.5 else power_law(rng)
    ratio = body.material.poisson_ratio
    rows = np.append(0.0, body.time * np.geomspace(1e-6, 1e2, 241))
    values = body.compliance(rows) / (1 - ratio)
    law = vc.TabulatedCreep(rows.tolist(), values.tolist())
    return Creep(f"table of a {body.name}", vc.Material(law, ratio), body.compliance, body.time)


def two_bodies(rng: np.random.Generator) -> Creep:
    """A Zener ball on a creeping half-space: the compliances add."""
    ball, body = zener(rng), zener(rng)
    shear = 1 / (2 * body.compliance.instant / (1 - body.material.poisson_ratio))
    other = vc.Material(
        vc.Zener(2 * shear, shear, 3 * shear * body.time), ball.material.poisson_ratio
    )
    part = (1 - ball.material.poisson_ratio) / (4 * shear)
    own = body.compliance
    compliance = CreepSum(own.instant + part, (*own.delayed, (2 * part, 3 * body.time)))
    more = {"indenter_material": other}
    return Creep("Zener on Zener", body.material, compliance, body.time, more=more)


LAWS = (
    elastic,
    zener,
    zener,
    maxwell,
    creep_series,
    relaxation_series,
    power_law,
    power_law_without_instant,
    fractional_maxwell,
    fractional_zener,
    tabulated_creep,
    two_bodies,
)


def random_creep(rng: np.random.Generator, *, creeping: bool = False) -> Creep:
    """One of the laws; `creeping`: none that is elastic."""
    laws = LAWS[1:] if creeping else LAWS
    return laws[rng.integers(len(laws))](rng)


def mean_compliance(creep: Creep, start: Array, end: Array) -> Array:
    """Mean of J over lags from start to end [1/Pa]."""
    return lag_mean(creep.compliance)(np.asarray(start, float), np.asarray(end, float))
