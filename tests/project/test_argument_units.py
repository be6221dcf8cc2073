"""The unit of an argument is written once, with the dataclass field."""

from __future__ import annotations

import dataclasses
import re
import typing

import pytest

from viscontact.bodies.loads.history import Control
from viscontact.results.descriptions import STORED_CLASSES
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.numbers import unit_of

CLASSES = tuple(STORED_CLASSES.values())
NUMERIC = re.compile(r"\b(float|int|Floats)\b")
UNITS = {dimension.unit for dimension in DIMENSIONS.values()} | {"1", "N/s"}


@pytest.mark.parametrize("owner", CLASSES, ids=lambda owner: owner.__name__)
def test_numeric_fields_have_a_unit_and_other_fields_have_none(owner: type) -> None:
    wrong = [
        field.name
        for field in dataclasses.fields(owner)  # of which one profile has none
        if not {unit_of(owner, field.name, control) for control in typing.get_args(Control)}
        <= (UNITS if NUMERIC.search(str(field.type)) else {None})
    ]
    assert wrong == []


def test_a_unit_may_depend_on_what_a_load_controls() -> None:
    harmonic = STORED_CLASSES["HarmonicHistory"]
    assert unit_of(harmonic, "mean", "force") == "N"
    assert unit_of(harmonic, "mean", "approach") == "m"
    assert unit_of(harmonic, "phase") == "rad"
