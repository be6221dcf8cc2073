"""Arguments of an object as a table: names, and values in readable units.

Units and special names are the metadata of the classes' fields.
"""

from __future__ import annotations

import dataclasses
import functools
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from viscontact.bodies.laws import Law
from viscontact.bodies.loads import LoadHistory, LoadProgram, TemperatureHistory
from viscontact.bodies.loads.motion import Motion
from viscontact.results.descriptions import rebuild, stored_classes
from viscontact.units.formatting import format_quantity

_STORED = stored_classes()
_LAWS = {name for name, each in _STORED.items() if issubclass(each, Law)}
#: Classes whose part of the table says what they are.
_PLAIN = {"Material", "Grid", "AutomaticGrid", "CombinedIndenter", "PlacedIndenter"}
_PLAIN |= {"Layer", "Layered"}
_OVER_TIME = LoadHistory | Motion | TemperatureHistory
_PLAIN |= {name for name, each in _STORED.items() if issubclass(each, _OVER_TIME)}
#: Arguments that are left out if this is their value.
_DEFAULTS: dict[str, tuple[object, ...]] = {
    **dict.fromkeys(["eccentricity_x", "eccentricity_y", "fluidity", "phase"], (0,)),
    **dict.fromkeys(["phase_x", "phase_y", "angle", "second_exponent"], (0,)),
    "cross_section": ("circle",),
}
#: People after whom laws and shifts are named, with a capital in running text.
PEOPLE = ("Maxwell", "Zener", "Burgers", "Arrhenius")
#: Significant digits: enough to recognise what was typed.
_DIGITS = 6
#: Longer lists are shown by their ends.
_MAX_LISTED = 8


def argument_rows(description: Mapping[str, Any], owner: str = "") -> Iterator[tuple[str, str]]:
    """Yield names and values of an object's arguments, with those of the objects within it."""
    kind = str(description.get("type", ""))
    if kind and kind not in _PLAIN:
        # A class of the user's own may be a shape, a law or a load.
        known = "law" if kind in _LAWS else "shape"
        yield owner or (known if kind in _STORED else "kind"), in_plain_words(kind)
    if description.get("program"):
        yield from _program_rows(rebuild(description["program"]))
        return
    for key, value in description.items():
        name = f"{owner} {_words(kind, key)}".strip()
        if isinstance(value, Mapping) and "sha256" in value:
            size = " × ".join(map(str, value.get("shape", ())))
            yield name, f"{size} points, fingerprint {str(value['sha256'])[:12]}"
        elif isinstance(value, Mapping):
            yield from argument_rows(value, owner if key in ("law", "body") else name)
        elif _holds_objects(value):
            for index, each in enumerate(value, 1):
                one = "layer" if key == "layers" else "part"
                yield from argument_rows(each, f"{owner} {one} {index}".strip())
        elif key != "type" and not _is_default(kind, key, value):
            yield name, _value(_unit(kind, key, description.get("control", "")), key, value)


def _program_rows(program: LoadProgram) -> Iterator[tuple[str, str]]:
    """Rows of a load program: its segments, stops, and what is not the default."""
    for number, segment in enumerate(program.parts, start=1):
        yield f"segment {number}", str(segment)
    for condition in program.stop:
        yield "stop when", str(condition)
    for name in ("eccentricity_x", "eccentricity_y"):
        if value := getattr(program, name):
            yield name.replace("_", " "), format_quantity(value, "m", _DIGITS)
    for name in ("tilt_x", "tilt_y"):
        if (value := getattr(program, name)) is not None:
            yield name.replace("_", " "), format_quantity(value, "rad", _DIGITS)


@functools.cache
def _metadata() -> dict[tuple[str, str], Mapping[str, Any]]:
    """Metadata of the fields that have a unit, by class and field."""
    return {
        (name, item.name): item.metadata
        for name, each in _STORED.items()
        for item in dataclasses.fields(each)
        if "unit" in item.metadata
    }


def _words(kind: str, key: str) -> str:
    plain = key.replace("_", " ").replace("poisson", "Poisson's")
    return str(_metadata().get((kind, key), {}).get("name", plain))


def _unit(kind: str, key: str, control: str) -> str:
    if kind in _STORED:
        unit = _metadata().get((kind, key), {}).get("unit", "SI")
        return str(unit.get(control, "SI") if isinstance(unit, Mapping) else unit)
    # A class of the user's own: the unit that all others have in a field of that name.
    units = {str(each["unit"]) for (_, name), each in _metadata().items() if name == key}
    return units.pop() if len(units) == 1 else "SI"


def _is_default(kind: str, key: str, value: Any) -> bool:
    if value is None or value is False or (kind == "PlacedIndenter" and value == 0):
        return True
    given = value if isinstance(value, list) else [value]
    return key in _DEFAULTS and all(each in _DEFAULTS[key] for each in given)


def _holds_objects(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) for v in value)


def _value(unit: str, key: str, value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, int | float | list):
        return "yes" if value is True else str(value)
    if key == "bonded" and isinstance(value, list):
        return ", ".join("yes" if each else "no" for each in value)
    if isinstance(value, list) and all(isinstance(each, bool) for each in value):
        return "along " + " and ".join(
            axis for axis, holds in zip("xy", value, strict=True) if holds
        )
    if isinstance(value, list) and all(isinstance(each, str) for each in value):
        return ", ".join(each.replace("_", " ") for each in value)
    try:
        numbers = np.atleast_1d(np.asarray(value, dtype=np.float64)).ravel().tolist()
    except (TypeError, ValueError):
        return str(value)
    if key in ("shape", "size", "largest_cell"):
        return " × ".join(_format(number, unit) for number in numbers)
    if isinstance(value, list) and isinstance(value[0], list):
        return f"{len(value)} × {len(value[0])} points, {_ends(numbers, unit)}"
    if len(set(numbers)) == 1 and key != "centre":
        numbers = numbers[:1]
    if len(numbers) > _MAX_LISTED:
        return f"{len(numbers)} values, {_ends(numbers, unit)}"
    return ", ".join(_format(number, unit) for number in numbers)


def _ends(numbers: Sequence[float], unit: str) -> str:
    least, most = (_format(number, unit, digits=4) for number in (min(numbers), max(numbers)))
    return f"from {least} to {most}"


def _format(value: float, unit: str, digits: int = _DIGITS) -> str:
    if unit == "1":
        return f"{value:.6g}"
    if unit == "K":  # never in kilokelvins
        return f"{value:.6g} K"
    if unit == "rad" and value:
        return (
            f"{format_quantity(value, 'rad')} ({format_quantity(float(np.degrees(value)), '1')}°)"
        )
    if unit in ("1/(Pa s)", "SI"):
        return f"{value:.4g} {unit}".replace(" SI", " (SI)")
    # As case files write it: 0.55 / GPa.
    return format_quantity(value, unit, digits).replace(" 1/", " / ")


def in_plain_words(kind: str) -> str:
    """Name of a type in words, such as "creep series" for ``"CreepSeries"``."""
    parts = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", kind).split()
    kept = (part.isupper() or part in PEOPLE for part in parts)
    return " ".join(p if keep else p.lower() for p, keep in zip(parts, kept, strict=True))
