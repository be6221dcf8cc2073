"""Headings and places of cells."""

from __future__ import annotations

import pytest

from viscontact.tables.creep_tests import same_stress, split_stress
from viscontact.tables.names import meaning
from viscontact.tables.workbook import _letters


def test_headings_name_quantities_in_several_languages():
    assert meaning("E''").quantity == "loss_modulus"
    assert meaning("Zeit").quantity == "time"
    assert meaning("remark") is None


def test_stress_of_a_heading_is_split_off():
    assert split_stress("strain at 5 MPa") == ("strain", 5e6)
    assert split_stress("strain") == ("strain", None)


def test_stresses_of_one_test_differ_by_a_per_cent():
    assert same_stress(5e6, 5.05e6)
    assert not same_stress(5e6, 6e6)


@pytest.mark.parametrize(("number", "letters"), [(1, "A"), (26, "Z"), (27, "AA"), (16384, "XFD")])
def test_columns_of_sheets_are_counted_in_letters(number, letters):
    assert _letters(number - 1) == letters
