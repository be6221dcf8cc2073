"""Types of values in a case file, with their checks and their JSON schema."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import COARSEST, FINEST
from viscontact.bodies.loads.harmonic_history import MOST_CYCLES
from viscontact.bodies.loads.motion import LARGEST_CREEPAGE
from viscontact.bodies.materials.hardness import RANGES
from viscontact.mechanics.time_integration.requested_times import (
    COARSEST_TIME_ERROR,
    FINEST_TIME_ERROR,
)
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.parsing import parse_quantity

# Limits whose squares and products do not overflow.
_SMALLEST, _LARGEST = 1e-100, 1e100

# Limits on cells along an axis, on steps and on speeds: without them arrays would be allocated
# before they are refused.
_MOST_CELLS, _MOST_STEPS, _MOST_SPEEDS = 10**9, 10**5, 1000

#: Word for a radius of curvature without end.
INFINITE = "infinite"

_ABSOLUTE_ZERO = "above absolute zero, -273.15 °C"

ANY, NOT_NEGATIVE, POSITIVE = "any", "zero or more", "more than zero"


@dataclass(frozen=True)
class WithUnit:
    """Annotation of a float that is written with a unit and converted to SI."""

    dimension: str
    sign: str = ANY
    infinite: bool = False  # the word "infinite" is accepted as well

    def read(self, given: Any) -> float:
        """Return the SI value of a value in the file."""
        wanted = DIMENSIONS[self.dimension]
        if self.infinite and given == INFINITE:
            return math.inf
        if not isinstance(given, str):
            given = _as_text(given, wanted.name, wanted.example)
        try:
            value = parse_quantity(given, self.dimension)
        except ValueError as error:
            raise _problem(str(error)) from error
        if value != 0.0 and not _SMALLEST <= abs(value) <= _LARGEST:
            raise _problem(
                f"{given!r} is beyond what can be computed with; write e.g. {wanted.example!r}"
            )
        refused = {ANY: False, NOT_NEGATIVE: value < 0, POSITIVE: value <= 0}[self.sign]
        if refused:
            least = _ABSOLUTE_ZERO if self.dimension == "temperature" else self.sign
            raise _problem(f"must be {least}, got {given!r}; write e.g. {wanted.example!r}")
        return value

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Return the pydantic schema, which reads the value with `read`."""
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Return the JSON schema: a text that begins with a number, with an example.

        `x-dimension` leads to the units to suggest, `x-sign` names the allowed sign, even
        where a key has a description of its own; editors skip what begins with x-.
        """
        wanted = DIMENSIONS[self.dimension]
        pattern = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*[^\s\d].*$"
        return {
            "type": "string",
            "pattern": f"^{INFINITE}$|{pattern}" if self.infinite else pattern,
            "description": f"{wanted.name} with its unit, {self.sign}",
            "examples": [wanted.example],
            "x-dimension": self.dimension,
            "x-sign": self.sign,
        }


def _as_text(given: Any, name: str, example: str) -> str:
    """Text of a bare number, for the message about missing units; other types are refused."""
    if isinstance(given, int | float) and not isinstance(given, bool):
        return f"{given}"
    shown = str(given) if len(str(given)) <= 40 else str(given)[:37] + "..."
    raise _problem(f"cannot read {shown} as {name}; write e.g. {example!r}")


def _problem(why: str) -> PydanticCustomError:
    # The text is passed as context, as braces in it are not placeholders.
    return PydanticCustomError("quantity", "{why}", {"why": why})


Length = Annotated[float, WithUnit("length", POSITIVE)]
LengthOrInfinite = Annotated[float, WithUnit("length", POSITIVE, infinite=True)]
NotNegativeLength = Annotated[float, WithUnit("length", NOT_NEGATIVE)]
Offset = Annotated[float, WithUnit("length")]
Angle = Annotated[float, WithUnit("angle")]
Spin = Annotated[float, WithUnit("spin")]
OpenAngle = Annotated[float, WithUnit("angle", POSITIVE)]
Force = Annotated[float, WithUnit("force", NOT_NEGATIVE)]
AnyForce = Annotated[float, WithUnit("force", ANY)]
StageStiffness = Annotated[float, WithUnit("stiffness", POSITIVE)]
LineLoad = Annotated[float, WithUnit("line load", NOT_NEGATIVE)]
Pressure = Annotated[float, WithUnit("pressure", NOT_NEGATIVE)]
Modulus = Annotated[float, WithUnit("pressure", POSITIVE)]
ModulusOrZero = Annotated[float, WithUnit("pressure", NOT_NEGATIVE)]
Compliance = Annotated[float, WithUnit("compliance", NOT_NEGATIVE)]
Viscosity = Annotated[float, WithUnit("viscosity", POSITIVE)]
Fluidity = Annotated[float, WithUnit("fluidity", NOT_NEGATIVE)]
Instant = Annotated[float, WithUnit("time", NOT_NEGATIVE)]
Duration = Annotated[float, WithUnit("time", POSITIVE)]
Speed = Annotated[float, WithUnit("speed", POSITIVE)]
Temperature = Annotated[float, WithUnit("temperature", POSITIVE)]
TemperatureDifference = Annotated[float, WithUnit("temperature difference", POSITIVE)]
Expansion = Annotated[float, WithUnit("expansion")]
MolarEnergy = Annotated[float, WithUnit("molar energy", POSITIVE)]
Exponent = Annotated[float, Field(gt=0, le=1)]
Scale = Annotated[float, Field(gt=0, allow_inf_nan=False)]
ShoreA = Annotated[float, Field(ge=RANGES["A"][0], le=RANGES["A"][1])]
ShoreD = Annotated[float, Field(ge=RANGES["D"][0], le=RANGES["D"][1])]
PoissonRatio = Annotated[float, Field(gt=-1, le=0.5)]
CellCount = Annotated[int, Field(ge=1, le=_MOST_CELLS)]
StepCount = Annotated[int, Field(ge=1, le=_MOST_STEPS)]
SpeedCount = Annotated[int, Field(ge=2, le=_MOST_SPEEDS)]
TimeTolerance = Annotated[float, Field(ge=FINEST_TIME_ERROR, le=COARSEST_TIME_ERROR)]
CycleCount = Annotated[int, Field(ge=1, le=MOST_CYCLES)]


def _fraction(given: Any) -> Any:
    """Number, or the value of a text such as ``"0.5 %"``."""
    if not isinstance(given, str):
        return given
    number, percent, rest = given.partition("%")
    try:
        value = float(number)
    except ValueError:
        rest = given
    if rest.strip():
        raise _problem(f"cannot read {given!r} as a share; write e.g. '0.5 %' or 0.005")
    return value / 100 if percent else value


Strain = Annotated[
    float,
    BeforeValidator(_fraction, json_schema_input_type=float | str),
    Field(gt=0, examples=["0.5 %", 0.005]),
]
Creepage = Annotated[
    float,
    BeforeValidator(_fraction, json_schema_input_type=float | str),
    Field(gt=-LARGEST_CREEPAGE, lt=LARGEST_CREEPAGE, examples=["0.3 %", 0.003]),
]
GridTolerance = Annotated[
    float,
    BeforeValidator(_fraction, json_schema_input_type=float | str),
    Field(ge=FINEST, le=COARSEST, examples=["0.5 %", 0.005]),
]


class Section(BaseModel):
    """Section of a case file: unknown keys and implicit conversions are refused."""

    # Built at first use: few of the sections occur in a case.
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, defer_build=True)
