"""Checks of single numbers: one wording, readable units, and what counts as a number."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from decimal import Decimal

import numpy as np
import pytest

from viscontact.units.numbers import (
    as_real,
    check_fields,
    finite,
    non_negative,
    positive,
    real,
    unit_of,
    whole,
)


@dataclass(frozen=True)
class Ball:
    radius: float = field(metadata={"unit": "m"})
    coating: float | None = field(default=None, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "radius", "coating")


@pytest.mark.parametrize("given", [3, 3.0, np.float32(3), np.array(3.0), Decimal(3)])
def test_plain_numbers_of_any_type_are_floats(given: object) -> None:
    assert as_real(given) == 3.0
    assert type(as_real(given)) is float


@pytest.mark.parametrize("given", [True, np.True_, np.array(True), "3", None, [3.0], np.ones(1)])
def test_anything_else_is_not_a_number(given: object) -> None:
    assert as_real(given) is None


@pytest.mark.parametrize(
    ("check", "given", "message"),
    [
        (positive, -0.005, "x must be a positive finite number, got -5 mm"),
        (positive, 0, "x must be a positive finite number, got 0 m"),
        (positive, math.nan, "x must be a positive finite number in m, got nan"),
        (positive, "5 mm", "x must be a positive finite number in m, got '5 mm'"),
        (non_negative, -1.0, "x must be a finite number >= 0, got -1 m"),
        (finite, math.inf, "x must be a finite number in m, got inf"),
        (real, None, "x must be a number in m, got None"),
    ],
)
def test_a_refusal_names_the_argument_the_condition_and_the_value(
    check: object, given: object, message: str
) -> None:
    with pytest.raises(ValueError) as refusal:  # noqa: PT011 - the whole message is compared
        check("x", given, "m")  # type: ignore[operator]
    assert str(refusal.value) == message


@pytest.mark.parametrize("given", [3.5, 0, 11, math.nan, 10**400, "4", True])
def test_whole_numbers_are_refused_outside_their_bounds(given: object) -> None:
    with pytest.raises(ValueError, match="n must be a whole number from 1 to 10, got "):
        whole("n", given, 1, 10)
    assert whole("n", 4.0, 1, 10) == 4


def test_fields_are_checked_in_their_units_and_optional_ones_may_be_none() -> None:
    assert Ball(1) == Ball(1.0, None)
    assert unit_of(Ball, "coating") == "m"
    with pytest.raises(ValueError, match=r"^Ball: coating must be a positive finite number, got 0"):
        Ball(1.0, 0.0)
    with pytest.raises(ValueError, match=r"^Ball: radius must be .* in m, got None"):
        Ball(None)  # type: ignore[arg-type]
