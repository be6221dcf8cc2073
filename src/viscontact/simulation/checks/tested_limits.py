"""Warnings about strains, stresses and temperatures beyond those of a material's tests.

The representative strain of a contact is 0.2 a/R under a sphere and 0.2 tan β under a cone (Tabor
1951, The Hardness of Metals; Johnson 1985, Contact Mechanics, section 6.3): the uniaxial strain
that stands for the field below the contact. With Hertz's mean pressure, p = (4/3π) E* a/R, it is
0.15 π p/E*, in which the shape is not contained: under a cone, p = E* tan β/2, this is 0.24 tan β,
under a cylinder 0.19 a/R. Of a body that creeps 1/E* is J(t), t being the time since the load came.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import LoadHistory, TemperatureHistory
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.bodies.materials.measured_range import MeasuredRange
from viscontact.bodies.materials.strength import onset_ratio
from viscontact.mechanics.problem.problem import Problem
from viscontact.units.formatting import format_number, format_quantity
from viscontact.units.temperatures import in_celsius

#: Representative strain over mean pressure times contact compliance.
TABOR = 0.15 * np.pi

#: Tolerance of a temperature of use [K].
NEARLY = 2.0


@dataclass(frozen=True, eq=False)
class LimitedBody:
    """Body at the contact whose material states a limit: of its tests, or of its strength."""

    range: MeasuredRange
    material: Material
    compliance: Callable[[float], float]  # J(t) [1/Pa]
    modulus_ratio: float  # Young's modulus over E*, 1 - ν² [-]
    depth: float  # of the layer at the surface [m]; inf for a half-space
    whose: str


@dataclass(frozen=True)
class Contact:
    """What the strain of a contact follows from, at one instant or speed."""

    mean_pressure: float  # [Pa]
    half_width: float  # [m]
    approach: float  # [m]; NaN if unknown
    loaded: float  # time since the load came [s]
    when: str
    peak_pressure: float = math.nan  # [Pa]
    is_line: bool = False
    repeats: bool = False  # the load, in cycles or with a body that moves


def limited_bodies(
    bodies: Iterable[Material | Layered], clocks: Sequence[Clock] = (), since: float = 0.0
) -> tuple[LimitedBody, ...]:
    """Bodies whose materials at the surface state a limit, the half-space first.

    Their creep follows clocks, the time where none are given; the load came at `since` [s].
    """
    found = []
    every = list(bodies)
    for place, body in enumerate(every):
        top = body if isinstance(body, Material) else body.materials[0]
        tested = top.measured_range or MeasuredRange()
        limits = (tested.strain, tested.shear_strain, tested.stress)
        if (*limits, top.strength(repeats=True)) == (None,) * 4:
            continue
        ratio = 0.5 if top.poisson_ratio is None else top.poisson_ratio
        depth = math.inf if isinstance(body, Material) else body.layers[0].thickness
        whose = "material" if len(every) == 1 else ("half-space", "indenter")[place] + " material"
        law, clock = top.contact_compliance(), clocks[place] if clocks else TIME
        compliance = partial(_crept, law, clock, since)
        found.append(LimitedBody(tested, top, compliance, 1 - ratio**2, depth, whose))
    return tuple(found)


def _crept(law: ContactCompliance, clock: Clock, since: float, loaded: float) -> float:
    """J of a load that came at a time and has acted for another one [1/Pa]."""
    return float(law(clock.passed(since + loaded, loaded)))


def loaded_since(load: LoadHistory) -> float:
    """Time at which a load begins [s]."""
    kinks = np.asarray(load.kinks, dtype=np.float64)
    levels = np.asarray(load.level_at(kinks)) > 0
    if not levels.any():
        return 0.0
    first = int(np.argmax(levels))
    # A ramp begins at the kink before the first one that is loaded.
    ramped = first > 0 and float(load.level_at(float(kinks[first]), side="left")) > 0
    return max(float(kinks[first - 1] if ramped else kinks[first]), 0.0)


def repeated(problem: Problem) -> bool:
    """Return whether a load comes again: in cycles, or with a body that moves."""
    return not problem.motion.stands or len(problem.contact_load.load_cycles) > 1


def limit_warnings(bodies: Iterable[LimitedBody], contact: Contact) -> dict[str, str]:
    """Warn of a strain or a stress beyond that of the tests of a body."""
    warnings: dict[str, str] = {}
    if contact.mean_pressure == 0:
        return warnings
    for body in bodies:
        warnings = _of_body(body, contact) | _of_strength(body, contact) | warnings
    return warnings


def _of_strength(body: LimitedBody, contact: Contact) -> dict[str, str]:
    """Warn of a pressure at which a contact of Hertz on a half-space begins to yield below."""
    material, found = body.material, {}
    names = {"yield stress": material.yield_stress}
    if contact.repeats:
        names["fatigue limit"] = material.fatigue_limit
    for name, stress in names.items():
        if stress is None or math.isfinite(body.depth):
            continue
        ratio = onset_ratio(material.instant_poisson_ratio, is_line=contact.is_line)
        if contact.peak_pressure > ratio * stress:
            peak, limit, own = (
                format_quantity(each, "Pa", 3)
                for each in (contact.peak_pressure, ratio * stress, stress)
            )
            shape = "line" if contact.is_line else "point"
            found[f"{name} of {body.whose}"] = (
                f"{contact.when} the peak pressure of {peak} exceeds {limit}, at which a {shape} "
                f"contact of Hertz reaches the {name} of the {body.whose}, {own}, below its "
                "surface (Johnson 1985); plastic deformation and damage are not computed"
            )
    return found


def _of_body(body: LimitedBody, contact: Contact) -> dict[str, str]:
    compliance = body.compliance(max(contact.loaded, 0.0))
    strain = TABOR * contact.mean_pressure * compliance
    # Wide on its layer, a contact squeezes it as a whole.
    if contact.half_width > body.depth and math.isfinite(contact.approach):
        strain = min(strain, contact.approach / body.depth)
    stress = strain * body.modulus_ratio / compliance
    tested = body.range
    measures = (
        ("strain", strain, tested.strain, _percent),
        ("shear strain", math.sqrt(3) * strain, tested.shear_strain, _percent),
        ("stress", stress, tested.stress, lambda value: format_quantity(value, "Pa", 3)),
    )
    warnings = {}
    for name, value, limit, written in measures:
        if limit is not None and value > limit:
            warnings[f"tested {name} of {body.whose}"] = (
                f"{contact.when} the representative {name} is about {written(value)} (mean "
                f"pressure {format_quantity(contact.mean_pressure, 'Pa', 3)}), beyond the "
                f"{written(limit)} of the tests of the {body.whose}; the law is linear, and was "
                "measured only up to there"
            )
    return warnings


def temperature_warnings(
    materials: Iterable[Material], temperature: TemperatureHistory | None = None
) -> dict[str, str]:
    """Warn of laws that are used at a temperature, or a history, outside those of their tests."""
    varies = temperature is not None and not temperature.is_constant
    for material in materials:
        tested = material.measured_range
        if tested is None or tested.temperatures is None:
            continue
        used = None if tested.used_at is None else (tested.used_at, tested.used_at)
        if temperature is not None and varies and material.shift is not None:
            used = temperature.range
        low, high = tested.temperatures
        if used is None or (low - NEARLY <= used[0] and used[1] <= high + NEARLY):
            continue
        return {
            "tested temperature": (
                f"the law is used at {_span(*used)} °C, but was measured at {_span(low, high)} °C; "
                "its shift is an extrapolation from there"
            )
        }
    return {}


def _percent(part: float) -> str:
    return f"{format_number(100 * part, 2)} %"


def _span(low: float, high: float) -> str:
    return _celsius(low) if low == high else f"{_celsius(low)} to {_celsius(high)}"


def _celsius(kelvin: float) -> str:
    return f"{round(in_celsius(kelvin), 6):.4g}"
