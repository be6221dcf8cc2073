"""Numbers with a tolerance, as drawings have them."""

import pytest

from viscontact.units.tolerances import read_toleranced


@pytest.mark.parametrize(
    ("text", "nominal", "low", "high"),
    [
        ("12 mm ± 0.02 mm", "12 mm", "11.98 mm", "12.02 mm"),
        ("12 ± 0.02 mm", "12 mm", "11.98 mm", "12.02 mm"),
        ("12mm±0.02", "12 mm", "11.98 mm", "12.02 mm"),
        ("12 mm +- 20 um", "12 mm", "11.98 mm", "12.02 mm"),
        ("12 mm +/- 1 %", "12 mm", "11.88 mm", "12.12 mm"),
        ("0.38 ± 0.02", "0.38", "0.36", "0.4"),
        ("50 % ± 5 %", "50 %", "45 %", "55 %"),
        ("0 mm ± 0.5 mm", "0 mm", "-0.5 mm", "0.5 mm"),
        ("-2 mrad ± 1 mrad", "-2 mrad", "-3 mrad", "-1 mrad"),
        ("-2 mrad ± 10 %", "-2 mrad", "-2.2 mrad", "-1.8 mrad"),
        ("5e-4 / MPa ± 1e-5 / MPa", "5e-4 / MPa", "0.00049 / MPa", "0.00051 / MPa"),
        ("23 degC ± 2 degC", "23 degC", "21 degC", "25 degC"),
        ("23 degC ± 2 K", "23 degC", "21 degC", "25 degC"),
        ("23 degC ± 9 degF", "23 degC", "18 degC", "28 degC"),
        ("± 20 um", "0 um", "-20 um", "20 um"),
    ],
)
def test_a_tolerance_gives_bounds_in_the_unit_of_the_number(text, nominal, low, high):
    found = read_toleranced(text)
    assert (found.nominal, found.low, found.high) == (nominal, low, high)


@pytest.mark.parametrize("text", ["12 mm", "pmma-paper", "-0.5 mm", "move at 1 um/s", "1e+3 mm"])
def test_other_texts_have_no_tolerance(text):
    assert read_toleranced(text) is None


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("12 mm ± 0.02 N", "does not fit 12 mm"),
        ("12 mm ± 0 mm", "must be more than zero"),
        ("12 mm ± -1 mm", "must be more than zero"),
        ("12 mm ±", "is not a number with a unit"),
    ],
)
def test_a_tolerance_that_cannot_be_read_is_refused(text, why):
    with pytest.raises(ValueError, match=why):
        read_toleranced(text)
