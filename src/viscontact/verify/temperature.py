"""Verification cases under a temperature that varies, and of a material that ages.

Under a temperature that rises evenly the WLF equation and that of Arrhenius are both
a_T = exp(b/u - c), with u = T - T_r + C_2 or u = T, so that the reduced time is

    ξ = e^c ∫ e^(-b/u) dt,   ∫ e^(-b/u) du = u e^(-b/u) - b E_1(b/u),

with the exponential integral E_1 (Abramowitz & Stegun 1964, chapter 5). The exact solutions are
those of the law over the reduced time (Morland & Lee 1960, Trans. Soc. Rheol. 4, 233); that of a
material that ages is Struik's (1978). The error of the mesh under a punch is removed by one elastic
contact on the same mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import WLF, Ageing, Arrhenius, PowerLaw
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.loads import HarmonicTemperature, TemperatureHistory, ramp, step
from viscontact.bodies.materials.material import Material
from viscontact.verify.case import Case, Comparison, Quantity, history
from viscontact.verify.creeping import TIME, G, maxwell, zener
from viscontact.verify.fixed_contact import GRID, PUNCH, softness_of_punch
from viscontact.verify.indentation import FORCE, RADIUS, grid_around, press

_Compare = Callable[[int], tuple[Comparison, ...]]

_COLD, _WARM = 283.15, 313.15  # K
_WLF, _ARRHENIUS = WLF(293.15, 8.86, 101.6), Arrhenius(293.15, 80e3)


@dataclass(frozen=True)
class _Ramp:
    """Even change of the temperature over a time, and the reduced time in closed form."""

    shift: WLF | Arrhenius
    first: float
    last: float
    duration: float = 2 * TIME

    @property
    def temperature(self) -> TemperatureHistory:
        """The temperature, as a run takes it."""
        return TemperatureHistory([0.0, self.duration], [self.first, self.last])

    @property
    def _constants(self) -> tuple[float, float, float]:
        """U at time 0, b and c of a_T = exp(b/u - c)."""
        if isinstance(self.shift, WLF):
            c = np.log(10) * self.shift.c1
            u = self.shift.c2 + self.first - self.shift.reference_temperature
            return u, c * self.shift.c2, c
        b = self.shift.activation_energy / GAS_CONSTANT
        return self.first, b, b / self.shift.reference_temperature

    def reduced(self, times: Floats) -> Floats:
        """Reduced times [s] within the change."""
        start, b, c = self._constants
        slope = (self.last - self.first) / self.duration
        u = start + slope * times

        def integral(u: Floats) -> Floats:
            whole = u * np.exp(c - b / u) - b * np.exp(c) * scipy.special.exp1(b / u)
            return np.asarray(whole)

        return np.asarray((integral(u) - integral(np.array(start))) / slope)


def _times(count: int) -> Floats:
    return np.asarray(np.linspace(0.0, 2 * TIME, count + 1))


def _of_shift(material: Material, shift: WLF | Arrhenius) -> Material:
    return replace(material, shift=shift)


def _held_force(heated: _Ramp, steps: int) -> tuple[Comparison, ...]:
    """Punch under a held force: u = F J(ξ) at any steps."""
    body, times = zener(), _times(steps)
    run = press(
        *(_of_shift(body.material, heated.shift), step(FORCE), times, GRID),
        indenter=PUNCH,
        tolerance=1e-9,
        temperature=heated.temperature,
    )
    exact = FORCE * softness_of_punch() * body.creep(heated.reduced(times))
    return (history(exact, run.over_time("approach")),)


def _growing_force(heated: _Ramp, steps: int) -> tuple[Comparison, ...]:
    """Punch under an even rise of the force, on a fluid: u = ∫ J(ξ(t) - ξ(t')) dF."""
    body, times = maxwell(), _times(steps)
    run = press(
        *(_of_shift(body.material, heated.shift), ramp(FORCE, 2 * TIME), times, GRID),
        indenter=PUNCH,
        tolerance=1e-9,
        temperature=heated.temperature,
    )
    # By parts, with J = J_0 (1 + ξ/τ): J_0 [F + ∫ F dξ/τ], and ∫ F dξ = F ξ - ∫ ξ dF.
    nodes, weights = np.polynomial.legendre.leggauss(40)
    parts = times[:, None] / 2 * (1 + nodes)
    under = times / 2 * (heated.reduced(parts) @ weights)
    slope = FORCE / (2 * TIME)
    flowed = slope * (times * heated.reduced(times) - under) / TIME
    exact = softness_of_punch() * float(body.creep(np.zeros(1))[0]) * (slope * times + flowed)
    return (history(exact, run.over_time("approach")),)


def _clamped(heated: _Ramp, steps: int) -> tuple[Comparison, ...]:
    """Punch at a held approach: F = w M(ξ)."""
    body, times, approach = zener(), _times(steps), 1e-6
    run = press(
        *(_of_shift(body.material, heated.shift), step(approach=approach), times, GRID),
        indenter=PUNCH,
        tolerance=1e-9,
        temperature=heated.temperature,
    )
    exact = approach / softness_of_punch() * body.relaxation(heated.reduced(times))
    return (history(exact, run.over_time("force")),)


def _ball(heated: _Ramp, cells: int) -> tuple[Comparison, ...]:
    """Ball under a sudden force: a³ = (3/4) R F J(ξ)."""
    body, times = zener(), _times(16)
    reduced = heated.reduced(times)
    radius = np.cbrt(0.75 * RADIUS * FORCE * body.creep(reduced))
    grid = grid_around((float(radius[-1]), float(radius[-1])), cells + 0.3)
    material = _of_shift(body.material, heated.shift)
    run = press(material, step(FORCE), times, grid, temperature=heated.temperature)
    return (
        history(radius**2 / RADIUS, run.over_time("approach")),
        history(radius, run.radius),
    )


def _swings(steps: int) -> tuple[Comparison, ...]:
    """Punch under a held force while the temperature swings, by Arrhenius."""
    body, period = zener(), TIME / 2
    swings = HarmonicTemperature(_ARRHENIUS.reference_temperature, 10.0, period, 4)
    times = _times(steps)
    b = _ARRHENIUS.activation_energy / GAS_CONSTANT

    def rate(time: Floats) -> Floats:
        warmed = swings.mean + swings.amplitude * np.sin(2 * np.pi * time / period)
        return np.asarray(np.exp(b / swings.mean - b / warmed))

    # Of a periodic function the trapezoidal rule converges exponentially; between, a fine one.
    fine = np.linspace(0.0, 2 * TIME, 64 * steps + 1)
    reduced = scipy.integrate.cumulative_simpson(rate(fine), x=fine, initial=0.0)[::64]
    run = press(
        *(_of_shift(body.material, _ARRHENIUS), step(FORCE), times, GRID),
        indenter=PUNCH,
        tolerance=1e-9,
        temperature=swings,
    )
    exact = FORCE * softness_of_punch() * body.creep(reduced)
    return (history(exact, run.over_time("approach")),)


def _ageing(steps: int) -> tuple[Comparison, ...]:
    """Punch under a held force on a power law that ages, over a year."""
    del steps  # at any
    age, rate, exponent = 3600.0, 0.8, 0.3
    law = PowerLaw(1 / (8 * G), exponent, 3600.0, instant=1 / (4 * G))
    material = Material(law, 0.5, ageing=Ageing(age, rate))
    times = np.append(0.0, np.geomspace(60.0, 3.156e7, 12))
    run = press(material, step(FORCE), times, GRID, indenter=PUNCH, tolerance=1e-9)
    effective = age / (1 - rate) * ((1 + times / age) ** (1 - rate) - 1)
    creep = 0.5 * (1 / (4 * G) + (effective / 3600.0) ** exponent / (8 * G))
    return (history(FORCE * softness_of_punch() * creep, run.over_time("approach")),)


def _punch(
    name: str, bounds: tuple[float, float], levels: tuple[int, ...], compare: _Compare
) -> Case:
    """Case of a punch, with the bounds of its fast and of its full form."""
    quantity = ("force", "N") if "held approach" in name else ("approach", "m")
    reference = "Struik 1978, Sneddon 1965" if "ages" in name else "Morland & Lee 1960"
    return Case(f"flat punch, {name}", reference, (Quantity(*quantity, *bounds),), levels, compare)


CASES: tuple[Case, ...] = (
    _punch(
        "held force, warming by WLF, Zener",
        (1e-8, 1e-8),
        (8,),
        partial(_held_force, _Ramp(_WLF, _COLD, _WARM)),
    ),
    _punch(
        "held force, cooling by Arrhenius, Zener",
        (1e-8, 1e-8),
        (8,),
        partial(_held_force, _Ramp(_ARRHENIUS, _WARM, _COLD)),
    ),
    _punch(
        "ramp of force, cooling by WLF, Maxwell",
        (2e-2, 4e-4),
        (8, 16, 32, 64),
        partial(_growing_force, _Ramp(_WLF, _WARM, 293.15)),
    ),
    _punch(
        "held approach, warming by WLF, Zener",
        (1e-3, 2e-4),
        (16, 32, 64),
        partial(_clamped, _Ramp(_WLF, _COLD, _WARM)),
    ),
    Case(
        "ball under a sudden force, warming by Arrhenius, Zener",
        "Lee & Radok 1960, Morland & Lee 1960",
        (Quantity("approach", "m", 5e-4, 2e-4), Quantity("contact radius", "m", 4e-3, 2e-3)),
        (10, 20, 40),
        partial(_ball, _Ramp(_ARRHENIUS, _COLD, _WARM)),
    ),
    _punch("held force, temperature that swings, Zener", (1e-8, 1e-8), (32,), _swings),
    _punch("held force, power law that ages", (1e-8, 1e-8), (1,), _ageing),
)
