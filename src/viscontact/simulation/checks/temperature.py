"""Warnings about the temperature of a run: its rate, and the shifts of the materials."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from viscontact.bodies.laws import WLF, Elastic
from viscontact.bodies.loads import TemperatureHistory
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.problem import Problem
from viscontact.units.formatting import format_quantity
from viscontact.units.temperatures import in_celsius

#: Thermal diffusivity of polymers [m²/s].
DIFFUSIVITY = 1e-7

#: Temperature below which few contacts are meant [K].
VERY_COLD = 150.0

#: Deviation of the temperature from an even one, or from a range, that is not reported [K].
NOTABLE = 2.0

#: Constants of the WLF equation referred to the glass transition, which are alike for many polymers
#: (Williams, Landel and Ferry 1955).
UNIVERSAL_C1, UNIVERSAL_C2 = 17.44, 51.6

#: Change of the vertical factor over a run that is not reported.
NOTABLE_FACTOR = 0.01

#: Temperatures at which a vertical factor is computed.
_SAMPLES = 50


def shift_warnings(problem: Problem) -> dict[str, str]:
    """Warn of materials whose shift does not cover the temperature of a run, or is missing."""
    found = _cold_warnings(problem)
    for body, name in zip(problem.given_materials, problem.body_names, strict=True):
        for material in body:
            for kind, text in _of_material(material, name, problem.temperature):
                found.setdefault(kind, text)
    return found


def _cold_warnings(problem: Problem) -> dict[str, str]:
    """Warn of temperatures at which degrees Celsius may have been taken for kelvin."""
    layers = [each for body in problem.bodies if isinstance(body, Layered) for each in body.layers]
    given = [each.expansion_from for each in layers if each.expansion_from is not None]
    if problem.temperature is not None:
        given.append(problem.temperature.range[1])
    if not given or min(given) >= VERY_COLD:
        return {}
    return {
        "kelvin": (
            f"a temperature of {min(given):.4g} K is given, that is {_celsius(min(given))}; add "
            "273.15 if degrees Celsius are meant"
        )
    }


def _of_material(
    material: Material, whose: str, temperature: TemperatureHistory | None
) -> Iterator[tuple[str, str]]:
    if isinstance(material.law, Elastic):
        return
    if isinstance(material.shift, WLF):
        yield from _below_transition(material, material.shift, whose, temperature)
    if temperature is None:
        return
    if material.shift is None:
        yield (
            "no shift",
            f"the {whose} has no shift, and its law is used as it is at {_span(temperature)}; give "
            "it a shift (WLF, Arrhenius or factors), or leave the temperature out",
        )
        return
    factors = material.shift.vertical_factor(np.linspace(*temperature.range, _SAMPLES))
    low, high = float(factors.min()), float(factors.max())
    if not temperature.is_constant and high > (1 + NOTABLE_FACTOR) * low:
        yield (
            "vertical shift",
            f"the moduli of the {whose} vary by factors from {low:.3g} to {high:.3g} with the "
            "temperature of the run (vertical shift); this is left out, as only the times of a law "
            "follow a temperature that varies",
        )


def _below_transition(
    material: Material, shift: WLF, whose: str, temperature: TemperatureHistory | None
) -> Iterator[tuple[str, str]]:
    """Warn of the WLF equation below the glass transition that its constants let expect."""
    # Without a temperature of the run, a law is used at the reference temperature of its shift,
    # which is its own temperature if the constants were given at another one.
    reference, transition = shift.reference_temperature, glass_transition(shift)
    lowest = reference if temperature is None else temperature.range[0]
    given = reference if shift.given_at is None else shift.given_at
    tested = material.measured_range
    measured = np.inf if tested is None or tested.temperatures is None else tested.temperatures[0]
    if lowest < min(transition, given, measured) - NOTABLE:
        varies = temperature is not None and not temperature.is_constant
        falls = "the temperature falls to" if varies else f"the {whose} is used at"
        yield (
            "glass transition",
            f"{falls} {_celsius(lowest)}, below about "
            f"{in_celsius(transition):.0f} °C, where the constants of the {whose}'s WLF equation "
            "become those of many polymers at their glass transition "
            f"(C1 = {UNIVERSAL_C1}, C2 = {UNIVERSAL_C2} K); below it the "
            "equation makes the body too slow: use Arrhenius or a table of factors there",
        )


def glass_transition(shift: WLF) -> float:
    """Temperature at which the constants of a WLF equation would become the universal ones [K]."""
    # C1 C2 and T_r - C2 do not depend on the reference temperature, so that C1 = 17.44 there.
    return shift.reference_temperature + shift.c1 * shift.c2 / UNIVERSAL_C1 - shift.c2


def diffusion_warnings(problem: Problem, half_width: float) -> dict[str, str]:
    """Warn of a temperature that changes faster than heat diffuses over a contact [m]."""
    if problem.temperature is None:
        return {}
    ways = heat_ways(problem.bodies, half_width)
    return lag_warnings(problem.temperature, *max(ways, key=lambda way: way[0]), problem.end)


def heat_ways(
    bodies: Sequence[Material | Layered], half_width: float
) -> Iterator[tuple[float, str]]:
    """Lengths over which heat has to diffuse before the run is right, with a name for each [m]."""
    # The pressure feels the law about as deep as the contact is wide, but the thickness grows by
    # the mean temperature of the layer, however narrow the contact.
    creeping = max(map(creeping_depth, bodies))
    if creeping < half_width:
        yield creeping, f"through the body: over its {format_quantity(creeping, 'm', 2)}"
    else:
        width = format_quantity(half_width, "m", 2)
        yield half_width, f"over the contact: over its half width of {width}"
    for depth in map(expanding_depth, bodies):
        thick = format_quantity(depth, "m", 2)
        yield depth, f"through the layers that expand: over their {thick}"


def creeping_depth(body: Material | Layered) -> float:
    """Depth down to which a body creeps, as far as it depends on its temperature [m]."""
    if isinstance(body, Material):
        return 0.0 if isinstance(body.law, Elastic) else body.thickness or np.inf
    if not isinstance(body.base, str) and not isinstance(body.base.law, Elastic):
        return np.inf
    return _lowest(body, [not isinstance(each.material.law, Elastic) for each in body.layers])


def expanding_depth(body: Material | Layered) -> float:
    """Depth down to which a body becomes thicker with its temperature [m]."""
    return 0.0 if isinstance(body, Material) else _lowest(body, [x.expands for x in body.layers])


def _lowest(body: Layered, of: list[bool]) -> float:
    """Depth of the bottom of the lowest of some layers [m], 0 without any."""
    bottoms = np.cumsum([layer.thickness for layer in body.layers])
    return float(bottoms.max(initial=0.0, where=of))


def lag_warnings(
    temperature: TemperatureHistory, length: float, way: str, end: float
) -> dict[str, str]:
    """Warn of a temperature that changes faster than heat diffuses over a length [m] until [s]."""
    takes = length**2 / DIFFUSIVITY
    if not temperature.steepest * takes > NOTABLE:
        return {}
    kinks = temperature.kinks
    times = np.append(kinks[kinks < end], end)
    values = np.concatenate([temperature.at(times, side=side) for side in ("left", "right")])
    lag = min(temperature.steepest * takes, float(np.ptp(values)))
    if lag <= NOTABLE:
        return {}
    return {
        "diffusion": (
            f"the temperature changes faster than heat diffuses {way} this takes about "
            f"{format_quantity(takes, 's', 2)} in a polymer, in which the temperature lags behind "
            f"by about {lag:.2g} K; the run takes it as even in the bodies"
        )
    }


def _span(temperature: TemperatureHistory) -> str:
    low, high = temperature.range
    return _celsius(low) if low == high else f"{_celsius(low)} to {_celsius(high)}"


def _celsius(kelvin: float) -> str:
    return f"{in_celsius(kelvin):.4g} °C"
