"""Checks of the temperature of a case against the shifts of its materials."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from viscontact.bodies.laws import Elastic, Shift
from viscontact.bodies.loads import TemperatureHistory
from viscontact.case.aliases import value_at
from viscontact.case.errors import KeyPath
from viscontact.case.materials.base import Medium
from viscontact.case.overrides import key_path
from viscontact.case.sections import CaseFile
from viscontact.units.temperatures import in_celsius

_EXAMPLE = "'shift: {kind: wlf, reference_temperature: 25 degC, c1: 17.44, c2: 51.6 K}'"


def temperature_problems(found: CaseFile, data: dict[str, Any]) -> Iterator[tuple[KeyPath, str]]:
    """Yield keys and problems of the temperature of a case and of its materials."""
    top = None if found.temperature is None else found.temperature.built
    for name, medium in found.media.items():
        key = _written(data, name)
        if top is None:
            if medium.lacks_temperature:
                yield (
                    _of_material(data, key, "shift"),
                    "needs a temperature to shift to: write that of all bodies at the top of the "
                    "case, e.g. 'temperature: 60 degC'",
                )
        else:
            yield from _under(top, medium, key, data)


def _under(
    top: TemperatureHistory, medium: Medium, key: KeyPath, data: dict[str, Any]
) -> Iterator[tuple[KeyPath, str]]:
    """Problems of a material under the temperature of the case."""
    if medium.own_temperature is not None:
        yield (
            _of_material(data, key, "temperature"),
            f"is {in_celsius(medium.own_temperature):.6g} °C, and the case gives the temperature "
            "of all bodies at its top; leave one of them out",
        )
        return
    shift = medium.built.shift
    if shift is not None:
        if why := _beyond(shift, top):
            yield ("temperature",), f"{'.'.join(map(str, key))}.{why}"
    elif not (top.is_constant or isinstance(medium.built.law, Elastic)):
        yield (
            key,
            "creeps, and needs a shift under a temperature that varies; write in it e.g. "
            f"{_EXAMPLE}",
        )


def _beyond(shift: Shift, temperature: TemperatureHistory) -> str:
    """Reason why a shift does not hold at a temperature of a history; empty if it does."""
    try:
        shift.factor(np.array(temperature.range))
    except ValueError as error:
        low, high = (f"{in_celsius(each):.6g}" for each in temperature.range)
        span = f"{low} °C" if temperature.is_constant else f"{low} to {high} °C"
        return f"shift does not hold at {span}: {error}"
    return ""


def _written(data: dict[str, Any], name: str) -> KeyPath:
    """Key of a material as the file has it: a layer's may be nested or beside its thickness."""
    key = key_path(name)
    nested = (*key, "material")
    return nested if "layers" in key and value_at(data, nested) is not None else key


def _of_material(data: dict[str, Any], key: KeyPath, inner: str) -> KeyPath:
    """Key within a material if the file has it there, else that of the material."""
    return (*key, inner) if value_at(data, (*key, inner)) is not None else key
