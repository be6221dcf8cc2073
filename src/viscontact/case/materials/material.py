"""Material section of a case file: any law, or a name of the library."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from viscontact.case.materials.measured_laws import CardLaw, TableLaw
from viscontact.case.materials.series_laws import CreepSeries, PowerLaw, RelaxationSeries
from viscontact.case.materials.spring_laws import (
    Burgers,
    Elastic,
    FractionalMaxwell,
    FractionalZener,
    Maxwell,
    Zener,
)
from viscontact.materials import library


def _from_library(given: Any) -> Any:
    if not isinstance(given, str):
        return given
    if given not in library.names():
        raise PydanticCustomError("library", "{why}", {"why": library.unknown_name(given)})
    entry = library.entry(given)
    # A run beyond the measured range issues a warning.
    return {**entry.material, "measured_until": f"{entry.measured[1]!r} s"}


class _OrName:
    """Schema annotation that allows the name of a shipped material in place of the section."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {"anyOf": [{"enum": list(library.names())}, handler(schema)]}


AnyMaterial = Annotated[
    Annotated[
        Elastic
        | Maxwell
        | Zener
        | Burgers
        | CreepSeries
        | RelaxationSeries
        | PowerLaw
        | FractionalMaxwell
        | FractionalZener
        | TableLaw
        | CardLaw,
        Field(discriminator="law"),
    ],
    BeforeValidator(_from_library),
    _OrName(),
]
