"""Choice of a section, compared with that of pydantic, which builds all validators."""

from typing import Annotated, Any

import pytest
from pydantic import Field, TypeAdapter, ValidationError

from viscontact.case.indenters.shapes import AnyShape
from viscontact.case.section_choice import alternatives

GIVEN = [
    {"shape": "roller", "radius": "5 mm", "half_length": "9 mm"},
    {"shape": "roller", "radius": "5 Pa", "half_length": 9, "width": "3 mm"},
    {"shape": "roller", "radius": "5 mm", "half_length": "9 mm", "profile": {"kind": "ful"}},
    {"shape": "roller", "radius": "5 mm", "half_length": "9 mm", "profile": "cylindrical"},
    {"shape": "torus", "radius": "5 mm", "tube_radius": "6 mm"},
    {"shape": "sfere", "radius": "5 mm"},
    {"shape": 3},
    {"shape": ["sphere"]},
    {"radius": "5 mm"},
    {},
    "sphere",
    None,
]


def outcome(reader: TypeAdapter[Any], given: Any) -> Any:
    """Section, or all errors."""
    try:
        return reader.validate_python(given)
    except ValidationError as error:
        found = error.errors(include_url=False)
        return [{**each, "ctx": str(each.get("ctx"))} for each in found]


def in_full() -> TypeAdapter[Any]:
    """Union that pydantic itself discriminates, on the uppermost level."""
    return TypeAdapter(Annotated[AnyShape.__origin__, Field(discriminator="shape")])


@pytest.mark.parametrize("given", GIVEN, ids=str)
def test_sections_and_errors_are_those_of_a_discriminated_union(given: Any) -> None:
    assert outcome(TypeAdapter(AnyShape), given) == outcome(in_full(), given)


def test_json_schema_is_that_of_a_discriminated_union() -> None:
    assert TypeAdapter(AnyShape).json_schema() == in_full().json_schema()


def test_alternatives_are_named_by_the_key() -> None:
    assert {"sphere", "roller", "height-map"} <= alternatives(AnyShape).keys()
