"""Clocks of the materials in words: what the reduced time follows from, and how long it becomes."""

from __future__ import annotations

import xarray as xr

from viscontact.bodies.laws import Shift
from viscontact.bodies.materials.layers import named_parts
from viscontact.bodies.materials.material import Material
from viscontact.report.drawings import BODIES
from viscontact.results.argument_table import in_plain_words
from viscontact.results.creep_times import follows_clock, reduced_name
from viscontact.results.recorded_case import case_of
from viscontact.results.recorded_objects import recorded_object, recorded_temperature
from viscontact.units.formatting import format_quantity
from viscontact.units.temperatures import in_celsius


def clock_line(ds: xr.Dataset, title: str) -> str:
    """Sentence about the clock of a body, by its title; empty if its law is used as it is."""
    part = next((part for part, name in BODIES.items() if name == title), "")
    temperature = recorded_temperature(ds)
    if case_of(ds).get(part) is None or not (temperature or follows_clock(ds, part)):
        return ""
    materials = named_parts(recorded_object(ds, part, "clock")).values()
    shift = next((each.shift for each in materials if each.shift is not None), None)
    if not follows_clock(ds, part):
        if temperature is None or shift is None:
            return ""
        return f"The law at {_celsius(temperature.range[0])}, by {_shift(shift)}."
    causes = [] if temperature is None or shift is None else [_shift(shift)]
    causes += [f"its ageing ({_ageing(each)})" for each in materials if each.ageing is not None][:1]
    reduced = float(ds[reduced_name(part)].values[-1])
    passed = format_quantity(float(ds["time"].values[-1]), "s", 3)
    return (
        f"Its creep is that over the reduced time, which follows from {' and '.join(causes)}: "
        f"{format_quantity(reduced, 's', 3)} after {passed}. The curves are those of the law over "
        "the reduced time."
    )


def _shift(shift: Shift) -> str:
    return f"its shift with temperature ({in_plain_words(type(shift).__name__)})"


def _ageing(material: Material) -> str:
    assert material.ageing is not None  # chosen
    age = format_quantity(material.ageing.age, "s", 3)
    return f"age {age} at first, exponent {material.ageing.exponent:g}"


def _celsius(kelvin: float) -> str:
    return f"{in_celsius(kelvin):.4g} °C"
