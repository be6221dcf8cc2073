"""Checks of single numbers: one wording, readable units, and what counts as a number."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from decimal import Decimal

import numpy as np
import pint
import pytest
import xarray as xr

from closeness import close_to
from viscontact.units.numbers import (
    as_real,
    check_fields,
    finite,
    finite_array,
    non_negative,
    positive,
    real,
    real_array,
    unit_of,
    whole,
)

UREG = pint.UnitRegistry()


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


@pytest.mark.parametrize(
    ("given", "unit", "message"),
    [
        ([0.0, [1.0, "2"]], "s", "must be numbers in s, got '2' at [1] at [1]"),
        ([0.0, "1"], "s", "must be numbers in s, got '1' at [1]"),
        ([[0.0], [1.0, 2.0]], "1", "must be numbers, got rows of unequal length"),
        (UREG.Quantity([1.0], "m"), "s", "must be numbers in s, got a length in m"),
        # A frequency counts turns; 1 Hz is 2 pi rad/s, and 0 degC is 273.15 K.
        (UREG.Quantity([1.0], "Hz"), "rad/s", "numbers in rad/s, got a frequency or a rate in Hz"),
        (UREG.Quantity([1.0], "degC"), "K", "must be numbers in K, got a temperature in °C"),
        (
            xr.DataArray([1.0], attrs={"units": "m."}),
            "m",
            "numbers in m, got the unknown unit 'm.'",
        ),
    ],
)
def test_an_array_is_refused_with_its_name_and_what_was_given(
    given: object, unit: str, message: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(message)) as refusal:
        real_array("x", given, unit)
    assert str(refusal.value).startswith("x must be numbers")


def test_arrays_of_floats_are_taken_as_they_are_and_copied_where_they_are_kept() -> None:
    given = np.array([1.0, math.nan])
    assert real_array("x", given, "m") is given
    assert finite_array("x", given[:1]).base is not given
    with pytest.raises(ValueError, match="x must be finite, got nan"):
        finite_array("x", given)


def test_single_numbers_have_units_too() -> None:
    assert as_real(UREG.Quantity(5, "mm"), "m") == close_to(5e-3, rel=1e-15)
    assert as_real(xr.DataArray(10.0, attrs={"units": "mm"}), "m") == close_to(1e-2, rel=1e-15)
    assert as_real(UREG.Quantity(5, "s"), "m") is None
    assert as_real(np.ma.masked, "m") is None
    assert Ball(UREG.Quantity(5, "mm")) == Ball(UREG.Quantity(5e3, "um"))  # type: ignore[arg-type]


def test_fields_are_checked_in_their_units_and_optional_ones_may_be_none() -> None:
    assert Ball(1) == Ball(1.0, None)
    assert unit_of(Ball, "coating") == "m"
    with pytest.raises(ValueError, match=r"^Ball: coating must be a positive finite number, got 0"):
        Ball(1.0, 0.0)
    with pytest.raises(ValueError, match=r"^Ball: radius must be .* in m, got None"):
        Ball(None)  # type: ignore[arg-type]
