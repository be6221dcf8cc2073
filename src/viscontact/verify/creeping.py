"""CreepingBody bodies of the cases, with J(t) and M(t) in closed form.

The package's own conversions are not used here: for laws with two times, poles are the roots of a
quadratic and amplitudes their residues in s² L[J] L[M] = 1; Mittag-Leffler's function of order 1/2
is E(-x) = exp(x²) erfc(x) (Mainardi 2010, Fractional Calculus and Waves in Linear Viscoelasticity,
appendix E).

"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.special import erfcx

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import (
    Burgers,
    CreepSeries,
    Elastic,
    FractionalMaxwell,
    FractionalZener,
    Maxwell,
    PowerLaw,
    RelaxationSeries,
    TabulatedCreep,
    TabulatedRelaxation,
    Zener,
)
from viscontact.bodies.materials.material import Material

TimeFunction = Callable[[Floats], Floats]

G, TIME = 5e8, 100.0  # shear modulus [Pa], time of a law [s]


@dataclass(frozen=True, eq=False)
class CreepingBody:
    """CreepingBody body, its exact J(t) and M(t), and the time span of the comparison."""

    name: str
    material: Material
    # J(t) [1/Pa] and M(t) [Pa], of both bodies if the ball creeps too
    creep: TimeFunction
    relaxation: TimeFunction
    # instants between which it creeps [s]
    first: float
    end: float
    ball: Material | None = None  # ball; None if it is rigid


def _solid(instant: float, delayed: float, delay: float) -> tuple[TimeFunction, TimeFunction]:
    """J = J0 + J1 (1 - exp(-t/λ)); M relaxes in λ J0/(J0 + J1)."""
    settled = instant + delayed
    relaxing = delay * instant / settled
    return (
        lambda t: settled - delayed * np.exp(-t / delay),
        lambda t: (1 + delayed / instant * np.exp(-t / relaxing)) / settled,
    )


def _delayed_and_flowing(
    instant: float, delayed: float, delay: float, flow: float
) -> tuple[TimeFunction, TimeFunction]:
    """J = J0 + J1 (1 - exp(-t/λ)) + φ t; at the zeros of f = s L[J], M = Σ exp(s t)/(s f'(s))."""
    zeros = np.roots([instant * delay, instant + flow * delay + delayed, flow])
    slopes = -flow / zeros**2 - delayed * delay / (1 + zeros * delay) ** 2
    return (
        lambda t: instant + flow * t - delayed * np.expm1(-t / delay),
        lambda t: np.exp(t[:, None] * zeros) @ (1 / (zeros * slopes)),
    )


def zener() -> CreepingBody:
    """Spring and Kelvin unit of equal moduli."""
    pair = _solid(1 / (8 * G), 1 / (8 * G), TIME)
    return CreepingBody(
        "Zener", Material(Zener(2 * G, 2 * G, 2 * G * TIME), 0.5), *pair, TIME / 50, 5 * TIME
    )


def maxwell() -> CreepingBody:
    """A fluid: Spinu & Cerlinca (2018), Table 1."""
    return CreepingBody(
        "Maxwell",
        Material(Maxwell(G, G * TIME), 0.5),
        lambda t: (1 + t / TIME) / (4 * G),
        lambda t: 4 * G * np.exp(-t / TIME),
        TIME / 100,
        3 * TIME,
    )


def _elastic() -> CreepingBody:
    modulus = 2 * G / 0.7

    def relaxation(t: Floats) -> Floats:
        return np.full_like(t, modulus)

    return CreepingBody(
        "Elastic",
        Material(Elastic(G), 0.3),
        lambda t: 1 / relaxation(t),
        relaxation,
        TIME / 100,
        TIME,
    )


def _burgers() -> CreepingBody:
    share = 0.62 / (2 * G)
    pair = _delayed_and_flowing(share, share / 2, TIME / 10, share / (2 * TIME))
    law = Burgers(G, 2 * G * TIME, 2 * G, 2 * G * TIME / 10)
    return CreepingBody("Burgers", Material(law, 0.38), *pair, TIME / 100, 3 * TIME)


def _creep_series() -> CreepingBody:
    amplitudes = np.array([1.0, 0.7, 0.4, 1e-3]) / G
    pair = _delayed_and_flowing(
        0.62 * amplitudes[0], 0.62 * amplitudes[1], TIME, 0.62 * amplitudes[3]
    )
    law = CreepSeries(amplitudes[0], (amplitudes[1],), (TIME,), amplitudes[3])
    return CreepingBody("CreepSeries", Material(law, 0.38), *pair, TIME / 50, 5 * TIME)


def _relaxation_series() -> CreepingBody:
    law = RelaxationSeries(G, (2 * G,), (TIME / 3,))
    pair = _solid(0.5 / (6 * G), 0.5 * (1 / (2 * G) - 1 / (6 * G)), TIME)
    return CreepingBody("RelaxationSeries", Material(law, 0.5), *pair, TIME / 50, 5 * TIME)


def _power_law() -> CreepingBody:
    instant, crept, share = 1 / (2 * G), 1 / (2 * G), 0.62
    law = PowerLaw(crept, 0.5, TIME, instant)
    return CreepingBody(
        "PowerLaw",
        Material(law, 0.38),
        lambda t: share * (instant + crept * np.sqrt(t / TIME)),
        lambda t: erfcx(math.gamma(1.5) * crept / instant * np.sqrt(t / TIME)) / (share * instant),
        TIME / 1e4,
        5 * TIME,
    )


def _fractional_maxwell() -> CreepingBody:
    return CreepingBody(
        "FractionalMaxwell",
        Material(FractionalMaxwell(G, TIME, 0.5), 0.5),
        lambda t: (1 + np.sqrt(t / TIME) / math.gamma(1.5)) / (4 * G),
        lambda t: 4 * G * erfcx(np.sqrt(t / TIME)),
        TIME / 1e4,
        5 * TIME,
    )


def fractional_zener() -> CreepingBody:
    """Modulus from 3 G to G; slower in creep than in relaxation by the square of that ratio."""
    return CreepingBody(
        "FractionalZener",
        Material(FractionalZener(3 * G, G, TIME / 9, 0.5), 0.5),
        lambda t: (1 - 2 / 3 * erfcx(np.sqrt(t / TIME))) / (4 * G),
        lambda t: 4 * G * (1 + 2 * erfcx(np.sqrt(9 * t / TIME))),
        TIME / 1e5,
        10 * TIME,
    )


def table_times() -> Floats:
    """Rows of the tables: 0, and 12 in each decade [s]."""
    return np.append(0.0, np.geomspace(TIME / 1e4, 10 * TIME, 61))


def tabulated_creep() -> CreepingBody:
    """Creep table of the Zener body at the table's times."""
    body, times = zener(), table_times()
    law = TabulatedCreep(times.tolist(), (2 * body.creep(times)).tolist())
    return replace(body, name="TabulatedCreep", material=Material(law, 0.5))


def _tabulated_relaxation() -> CreepingBody:
    body, times = zener(), table_times()
    law = TabulatedRelaxation(times.tolist(), (body.relaxation(times) / 4).tolist())
    return replace(body, name="TabulatedRelaxation", material=Material(law, 0.5))


def _two_bodies() -> CreepingBody:
    ball = Material(Zener(G, G / 2, G * TIME / 20), 0.3)
    pair = _delayed_and_flowing(1.2 / (2 * G), 0.7 / G, TIME / 10, 0.5 / (2 * G * TIME))
    fluid = Material(Maxwell(G, G * TIME), 0.5)
    return CreepingBody("Zener ball on Maxwell", fluid, *pair, TIME / 100, 3 * TIME, ball)


def _elastic_bulk() -> CreepingBody:
    """L[J] = [1/G~ + 3/(3K + G~)]/(4 s) with G~ = s L[G] = G s τ/(1 + s τ)."""
    bulk = 3 * G
    delay, relaxing = (1 + G / (3 * bulk)) * TIME, (1 + 4 * G / (3 * bulk)) * TIME

    def creep(t: Floats) -> Floats:
        settled, instant = 1 / (3 * bulk), 1 / (3 * bulk + G)
        volumetric = settled - (settled - instant) * np.exp(-t / delay)
        return (1 + t / TIME) / (4 * G) + 0.75 * volumetric

    def relaxation(t: Floats) -> Floats:
        second = 9 * bulk * G / (3 * bulk + 4 * G)
        return G * np.exp(-t / TIME) + second * np.exp(-t / relaxing)

    material = Material(Maxwell(G, G * TIME), bulk_modulus=bulk)
    return CreepingBody(
        "Maxwell with elastic bulk", material, creep, relaxation, TIME / 100, 3 * TIME
    )


def all_bodies() -> tuple[CreepingBody, ...]:
    """One body for each law, two creeping bodies, and one that is elastic in bulk."""
    return (
        _elastic(),
        maxwell(),
        zener(),
        _burgers(),
        _creep_series(),
        _relaxation_series(),
        _power_law(),
        _fractional_maxwell(),
        fractional_zener(),
        tabulated_creep(),
        _tabulated_relaxation(),
        _two_bodies(),
        _elastic_bulk(),
    )
