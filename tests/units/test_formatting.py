"""Numbers and units as texts, and back."""

from __future__ import annotations

import pytest

from viscontact.units.axis_flags import AxisFlags
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.formatting import (
    ReadableUnit,
    clock_ticks,
    format_compact,
    quoted,
    readable_unit,
    time_labels,
    without_trailing_zeros,
)
from viscontact.units.parsing import (
    UnitScale,
    parse_any_quantity,
    parse_scale,
    parse_unit,
    split_quantity,
)
from viscontact.units.temperatures import in_celsius
from viscontact.units.tolerances import Toleranced, read_toleranced


def test_flags_that_agree_are_a_bool_and_others_a_pair():
    assert AxisFlags(True) == True == AxisFlags((True, True))  # noqa: E712
    assert AxisFlags((True, False)) == (True, False)
    assert not AxisFlags(False)
    assert any(AxisFlags((True, False)))


def test_values_are_in_the_unit_that_is_shown():
    assert ReadableUnit("mm", 1e-3)(0.0025).item() == 2.5
    assert DIMENSIONS["force"].units == ("mN", "N", "kN", "MN")
    assert in_celsius(293.15) == 20.0


def test_numbers_of_labels_have_no_zeros_at_the_end():
    given = ("1.500", "10.0", "100", "1e+06")
    assert [without_trailing_zeros(each) for each in given] == ["1.5", "10", "100", "1e+06"]
    assert (format_compact(8.33333), format_compact(1000.0)) == ("8.33", "1000")


def test_long_texts_are_shortened_in_quotation_marks():
    assert quoted("a long text", most=8) == "'a lon...'"


def test_ticks_over_hours_are_times_that_clocks_show():
    hours = clock_ticks(ReadableUnit("h", 3600.0), 0.1, 30.0)
    assert hours == {1 / 6: "10 min", 1.0: "1 h", 10.0: "10 h", 24.0: "1 d"}
    assert clock_ticks(readable_unit("s", [1000.0]), 1.0, 1000.0) == {}
    # Beyond four decades 10 h would be too close to 1 d.
    assert "10 h" not in clock_ticks(ReadableUnit("h", 3600.0), 0.02, 1000.0).values()


def test_long_times_are_in_hours_from_10000_s_on_and_in_days_from_three_days_on():
    symbols = [readable_unit("s", time).symbol for time in (1e4, 1.1e4, 2.5e5, 2.7e5)]
    assert symbols == ["s", "h", "h", "d"]


def test_instants_of_long_runs_are_in_the_largest_unit_that_they_have_two_of():
    assert time_labels([90.0, 5400.0, 1.5 * 86400, 4 * 86400]) == ("90 s", "90 min", "36 h", "4 d")


def test_compliance_is_below_a_thousand_in_the_largest_unit_of_modulus_that_leaves_it_so():
    assert [readable_unit("1/Pa", size).symbol for size in (5e-7, 2e-6)] == ["1/GPa", "1/MPa"]


def test_length_less_than_a_thousandth_below_a_millimetre_is_in_millimetres():
    assert readable_unit("m", 0.9995e-3).symbol == "mm"
    assert readable_unit("m", 0.998e-3).symbol == "µm"


def test_digits_of_a_number_stay_in_its_si_value():
    assert UnitScale(0.001).si("9.565") == 0.009565
    assert UnitScale(1.0, 273.15).si("60") == 333.15


def test_units_are_factors_and_temperatures_have_an_offset():
    assert parse_unit("min", "time") == 60.0
    assert parse_scale("°C", "temperature").si("-50") == 223.15
    assert parse_scale("degC", "temperature difference").si("51.6") == 51.6


@pytest.mark.parametrize(
    ("text", "value"), [("10 kN", (10000.0, "N")), ("0.3", (0.3, "1")), ("1 %", (0.01, "1"))]
)
def test_quantities_of_any_dimension_are_read(text, value):
    assert parse_any_quantity(text) == value


def test_number_and_unit_are_split():
    assert split_quantity("5.545e-4 / MPa") == ("5.545e-4", "/ MPa")
    assert split_quantity("0.3") == ("0.3", "")


def test_tolerances_have_the_unit_of_the_number():
    assert read_toleranced("12 mm ± 20 um") == Toleranced(
        "12 mm", "0.02 mm", "11.98 mm", "12.02 mm"
    )
