"""Levels of a load: a force or an approach, distinguished by the unit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, NamedTuple

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from viscontact.bodies.loads.history import Control
from viscontact.case.quantities import WithUnit
from viscontact.units.dimensions import DIMENSIONS

#: Example of an approach; that of a length would be too large.
APPROACH_EXAMPLE = "0.1 mm"

_DIMENSIONS: dict[str, Control] = {"force": "force", "length": "approach"}


class Level(NamedTuple):
    """A force [N] or an approach [m], and which of the two it is."""

    value: float
    control: Control


def read_level(given: Any) -> Level:
    """Read a force or a length with its unit."""
    why = ""
    for dimension, control in _DIMENSIONS.items():
        try:
            return Level(WithUnit(dimension).read(given), control)
        except PydanticCustomError as error:
            why = why or error.message()
    force = DIMENSIONS["force"]
    why = why.replace(force.name, f"{force.name} or a length")
    why = why.replace(repr(force.example), f"{force.example!r} or {APPROACH_EXAMPLE!r}")
    raise PydanticCustomError("quantity", "{why}", {"why": why})


@dataclass(frozen=True)
class _LevelQuantity:
    """Annotation of a `Level` that is written with a unit."""

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(read_level)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {
            "type": "string",
            "description": "a force, or for approach control a length, with its unit",
            "examples": [DIMENSIONS["force"].example, APPROACH_EXAMPLE],
            "x-dimension": list(_DIMENSIONS),
        }


ForceOrApproach = Annotated[Level, _LevelQuantity()]


@dataclass(frozen=True)
class _TiltQuantity(WithUnit):
    """Annotation of a tilt: an angle, 0 without a unit, or the word for one free of moment."""

    def read(self, given: Any) -> Any:
        """Return the angle [rad], None where the tilt is free."""
        if given is None or given == "free":
            return None
        if not isinstance(given, bool) and given in (0, "0"):
            return 0.0
        try:
            return super().read(given)
        except PydanticCustomError as error:
            why = f"{error.message()}, or 'free' for a tilt that is free of moment"
            raise PydanticCustomError("quantity", "{why}", {"why": why}) from error

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Return the JSON schema: an angle, zero or the word."""
        angle = super().__get_pydantic_json_schema__(schema, handler)
        return {"anyOf": [angle, {"const": "free"}, {"const": 0}]}


Tilt = Annotated[float | None, _TiltQuantity("angle")]
