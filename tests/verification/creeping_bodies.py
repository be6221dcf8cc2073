"""Materials and, written by hand beside them, their contact compliance J and its inverse M.

Nothing of the package's own conversion is used: where a law has two time constants, poles are
roots of a quadratic and amplitudes their residues in s² L[J] L[M] = 1.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import erfcx, gamma

import viscontact as vc
from inverse_pairs import series

G = 5e8  # shear modulus [Pa]
TIME = 100.0  # s


@dataclass(frozen=True)
class Body:
    """A material, what it is in theory, and the decades of time in which it creeps.

    If the pressed ball creeps, too, creep and relaxation are those of both together.
    """

    material: vc.Material
    creep: Callable
    relaxation: Callable
    first: float
    end: float
    ball: vc.Material | None = None


def maxwell():
    """J = (1 - nu) Phi, Phi = (1 + t/tau)/(2 G): Spinu & Cerlinca (2018), Table 1."""
    material = vc.Material(vc.Maxwell(G, G * TIME), poisson_ratio=0.5)
    modulus = 4 * G
    return Body(
        material,
        lambda t: (1 + t / TIME) / modulus,
        lambda t: modulus * np.exp(-t / TIME),
        TIME / 100,
        3 * TIME,
    )


def zener():
    """Spring and Kelvin unit of equal moduli, as in the same Table 1; M(0)/M(inf) = 2."""
    modulus = 2 * G
    material = vc.Material(vc.Zener(modulus, modulus, modulus * TIME), poisson_ratio=0.5)
    return Body(
        material,
        lambda t: (2 - np.exp(-t / TIME)) / (4 * modulus),
        lambda t: 4 * modulus * (1 + np.exp(-2 * t / TIME)) / 2,
        TIME / 100,
        5 * TIME,
    )


def burgers():
    """Maxwell and Kelvin units in series, tau of the Kelvin unit 10 s."""
    poisson_ratio, stiff, viscosity, soft, delay = 0.38, 5e8, 1e11, 1e9, 10.0
    material = vc.Material(vc.Burgers(stiff, viscosity, soft, soft * delay), poisson_ratio)
    instant, flow, delayed = (
        (1 - poisson_ratio) / (2 * value) for value in (stiff, viscosity, soft)
    )
    return Body(material, *_delayed_and_flowing(instant, delayed, delay, flow), 0.1, 300.0)


def _delayed_and_flowing(instant, delayed, delay, flow):
    """J with one delayed part and flow; f(s) = s L[J], M = sum exp(s_k t)/(s_k f'(s_k))."""
    zeros = np.roots([instant * delay, instant + flow * delay + delayed, flow])
    slopes = -flow / zeros**2 - delayed * delay / (1 + zeros * delay) ** 2
    return (
        lambda t: instant + flow * t - delayed * np.expm1(-t / delay),
        lambda t: np.exp(t[:, None] * zeros) @ (1 / (zeros * slopes)),
    )


def solid_ball_on_a_fluid():
    """Two creeping bodies: their compliances add."""
    fluid = vc.Material(vc.Maxwell(G, G * TIME), poisson_ratio=0.5)
    ball = vc.Material(vc.Zener(G, G / 2, G * TIME / 20), poisson_ratio=0.3)
    # Halved by Phi = 1/(2 G), and (1 - nu) of each.
    instant = 0.5 / (2 * G) + 0.7 / (2 * G)
    pair = _delayed_and_flowing(instant, 0.7 / G, TIME / 10, 0.5 / (2 * G * TIME))
    return Body(fluid, *pair, TIME / 100, 3 * TIME, ball)


def elastic():
    """Nothing creeps."""
    modulus = 2 * G / 0.7

    def relaxation(t):
        return np.full_like(t, modulus)

    return Body(vc.Material(vc.Elastic(G), 0.3), lambda t: 1 / relaxation(t), relaxation, 1.0, 10.0)


# With exponent 1/2 Mittag-Leffler's function is E(-x) = exp(x²) erfc(x): Mainardi (2010), app. E.


def power_law():
    """Phi = J0 + J sqrt(t/tau); M the inverse of J0 (1 + x) with x² L = pi/4 (J/J0)² t/tau."""
    instant, crept, time, share = 5e-10, 8e-10, 20.0, 0.62
    material = vc.Material(vc.PowerLaw(crept, 0.5, time, instant), 0.38)

    def relaxation(t):
        return erfcx(gamma(1.5) * crept / instant * np.sqrt(t / time)) / (share * instant)

    return Body(
        material,
        lambda t: share * (instant + crept * np.sqrt(t / time)),
        relaxation,
        0.02,
        500.0,
    )


def fractional_maxwell():
    """A spring and a spring-pot of exponent 1/2 in series."""
    material = vc.Material(vc.FractionalMaxwell(G, TIME, 0.5), 0.5)
    return Body(
        material,
        lambda t: (1 + np.sqrt(t / TIME) / gamma(1.5)) / (4 * G),
        lambda t: 4 * G * erfcx(np.sqrt(t / TIME)),
        TIME / 1000,
        10 * TIME,
    )


def fractional_maxwell_with_elastic_bulk():
    """As `maxwell_with_elastic_bulk`, with sqrt(s tau) in the place of s tau."""
    bulk = 1.5e9
    material = vc.Material(vc.FractionalMaxwell(G, TIME, 0.5), bulk_modulus=bulk)
    delay, relaxation_delay = 1 + G / (3 * bulk), 1 + 4 * G / (3 * bulk)

    def creep(t):
        root = np.sqrt(t / TIME)
        volumetric = 1 / (3 * bulk) - (1 / (3 * bulk) - 1 / (3 * bulk + G)) * erfcx(root / delay)
        return (1 + root / gamma(1.5)) / (4 * G) + 0.75 * volumetric

    def relaxation(t):
        root = np.sqrt(t / TIME)
        return G * erfcx(root) + 3 * G / relaxation_delay * erfcx(root / relaxation_delay)

    return Body(material, creep, relaxation, TIME / 1000, 10 * TIME)


def fractional_zener():
    """A spring beside them: from 3 G to G."""
    material = vc.Material(vc.FractionalZener(3 * G, G, TIME, 0.5), 0.5)
    slower = 9 * TIME  # by the square of the ratio of moduli
    return Body(
        material,
        lambda t: (1 / 3 + 2 / 3 * (1 - erfcx(np.sqrt(t / slower)))) / (4 * G),
        lambda t: 4 * G * (1 + 2 * erfcx(np.sqrt(t / TIME))),
        TIME / 1000,
        100 * TIME,
    )


def tabulated_creep():
    """The rows of a creep test on `creep_series`, 12 in each decade."""
    body = creep_series()
    times = np.append(0.0, np.geomspace(5e-3, 2e4, 81))
    law = vc.TabulatedCreep(times, body.creep(times) / 0.62)
    return replace(body, material=vc.Material(law, 0.38))


def tabulated_relaxation():
    """The rows of a relaxation test on `relaxation_series`, 12 in each decade."""
    body = relaxation_series()
    times = np.append(0.0, np.geomspace(5e-3, 5e3, 73))
    law = vc.TabulatedRelaxation(times, body.relaxation(times) * 0.62 / 2)
    return replace(body, material=vc.Material(law, 0.38))


def creep_series():
    """Four terms over three decades, M(0)/M(inf) = 4.2."""
    instant, amplitudes, times = 6e-10, np.array([3e-10, 5e-10, 2e-10, 9e-10]), [0.5, 7, 60, 900]
    material = vc.Material(vc.CreepSeries(instant, tuple(amplitudes), tuple(times)), 0.38)
    return Body(material, *series(0.62 * instant, 0.62 * amplitudes, times), 0.05, 1e4)


def relaxation_series():
    """Two terms: M = 2 G(t)/(1 - nu); J from the roots of a quadratic."""
    equilibrium, (first, second), (fast, slow) = 2e8, (3e8, 2e8), (5.0, 80.0)
    law = vc.RelaxationSeries(equilibrium, (first, second), (fast, slow))
    factor = 2 / (1 - 0.38)
    # s L[M] = factor (G_inf + sum G_i s tau_i/(1 + s tau_i)) = factor above(s)/below(s)
    below = np.polymul([fast, 1], [slow, 1])
    above = equilibrium * below + (
        first * np.polymul([fast, 0], [slow, 1]) + second * np.polymul([slow, 0], [fast, 1])
    )
    zeros = np.roots(above)
    residues = np.polyval(below, zeros) / (zeros * np.polyval(np.polyder(above), zeros))
    return Body(
        vc.Material(law, 0.38),
        lambda t: (1 / equilibrium + np.exp(t[:, None] * zeros) @ residues) / factor,
        lambda t: factor * (equilibrium + first * np.exp(-t / fast) + second * np.exp(-t / slow)),
        0.5,
        1e3,
    )


def maxwell_with_elastic_bulk():
    """Maxwell in shear, elastic in bulk: L[J] = [1/G~ + 3/(3 K + G~)]/(4 s), G~ = s L[G]."""
    bulk = 1.5e9
    material = vc.Material(vc.Maxwell(G, G * TIME), bulk_modulus=bulk)
    delay = (3 * bulk + G) * TIME / (3 * bulk)
    relaxation_time = (3 * bulk + 4 * G) * TIME / (3 * bulk)

    def creep(t):
        volumetric = 1 / (3 * bulk) - (1 / (3 * bulk) - 1 / (3 * bulk + G)) * np.exp(-t / delay)
        return (1 + t / TIME) / (4 * G) + 0.75 * volumetric

    def relaxation(t):
        second = 9 * bulk * G / (3 * bulk + 4 * G)
        return G * np.exp(-t / TIME) + second * np.exp(-t / relaxation_time)

    return Body(material, creep, relaxation, TIME / 100, 3 * TIME)


BODIES = {
    build.__name__: build()
    for build in (
        maxwell,
        zener,
        burgers,
        creep_series,
        relaxation_series,
        maxwell_with_elastic_bulk,
        solid_ball_on_a_fluid,
        elastic,
        power_law,
        fractional_maxwell,
        fractional_maxwell_with_elastic_bulk,
        fractional_zener,
        tabulated_creep,
        tabulated_relaxation,
    )
}
