"""Materials and, written by hand beside them, their contact compliance J and its inverse M.

Nothing of the package's own conversion is used: where a law has two time constants, poles are
roots of a quadratic and amplitudes their residues in s² L[J] L[M] = 1.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import viscontact as vc
from inverse_pairs import series

G = 5e8  # shear modulus [Pa]
TIME = 100.0  # s


@dataclass(frozen=True)
class Body:
    """A material, what it is in theory, and the decades of time in which it creeps."""

    material: vc.Material
    creep: Callable
    relaxation: Callable
    first: float
    end: float


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
    # f(s) = s L[J]; M = sum exp(s_k t)/(s_k f'(s_k)) over its zeros.
    zeros = np.roots([instant * delay, instant + flow * delay + delayed, flow])
    slopes = -flow / zeros**2 - delayed * delay / (1 + zeros * delay) ** 2
    return Body(
        material,
        lambda t: instant + flow * t - delayed * np.expm1(-t / delay),
        lambda t: np.exp(t[:, None] * zeros) @ (1 / (zeros * slopes)),
        0.1,
        300.0,
    )


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
    )
}
