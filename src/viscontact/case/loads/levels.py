"""Levels of a load: a force, an approach or a line load, distinguished by the unit."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import Control
from viscontact.case.quantities import WithUnit
from viscontact.units.dimensions import DIMENSIONS

#: Example of an approach; that of a length would be too large.
APPROACH_EXAMPLE = "0.1 mm"

#: Control of a load whose levels are forces per length of a line contact.
BY_LENGTH: Literal["line load"] = "line load"

#: What the levels of a history prescribe.
Prescribed = Control | Literal["line load"]

_DIMENSIONS: dict[str, Prescribed] = {
    "force": "force",
    "length": "approach",
    "line load": BY_LENGTH,
}

#: The level in sentences, by what it prescribes.
IN_WORDS: dict[Prescribed, str] = {
    "force": "a force",
    "approach": "a length",
    BY_LENGTH: "a force per length",
}


class Level(NamedTuple):
    """A force [N], an approach [m] or a line load [N/m], and which of them it is."""

    value: float
    control: Prescribed


def read_level(given: Any) -> Level:
    """Read a force, a length or a line load with its unit."""
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
            "description": "a force, for approach control a length, or for a line contact a force "
            "per length, with its unit",
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
