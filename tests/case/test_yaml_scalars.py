"""Values that are written over in a YAML text."""

from functools import reduce
from operator import getitem

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viscontact.case import yaml_source
from viscontact.case.yaml_scalars import written_over

TEXT = """\
# a case
load:   {force: 10 kN, kind: step}   # on top
grid:
    shape: [64, 64]  # cells
    size: &size [3 mm, 4 mm]
    other: *size
depth: !!str 5
title: 'as typed'
note: >
  two
  lines
open:
speed:
- 1e-3
-   2 mm/s
"""

PLACES = [("load", "force"), ("grid", "shape", 1), ("speed", 0), ("speed", 1)]
NUMBERS = st.integers() | st.floats(allow_nan=False, allow_infinity=False)
QUANTITIES = st.builds("{} {}".format, st.floats(0, 1e9), st.sampled_from(["mm", "µm/s", "°C"]))


def value_at(data, path):
    return reduce(getitem, path, data)


@given(st.sampled_from(PLACES), NUMBERS | QUANTITIES)
def test_a_value_is_read_as_what_was_written_and_all_else_stays(path, value):
    found = written_over(TEXT, {path: value})
    assert found is not None
    before, after = yaml_source.parse(TEXT)[0], yaml_source.parse(found)[0]
    assert value_at(after, path) == value
    assert type(value_at(after, path)) is type(value)
    value_at(after, path[:-1])[path[-1]] = value_at(before, path)
    assert after == before
    assert sum(a != b for a, b in zip(TEXT.splitlines(), found.splitlines(), strict=True)) <= 1


def test_several_values_are_written_at_once():
    values = {("speed", 1): "3 mm/s", ("load", "force"): "2N", ("grid", "shape", 0): 7}
    found = written_over(TEXT, values)
    expected = TEXT.replace("2 mm/s", "3 mm/s").replace("10 kN", "2N").replace("[64,", "[7,")
    assert found == expected


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("grid", "size", 0), "5 mm"),  # stands in two places
        (("depth",), 6),  # a tag makes a text of it
        (("title",), 6),
        (("note",), 6),
        (("open",), 6),
        (("load", "tilt"), 6),  # is not there
        (("load", "force"), "1e5"),  # a text that reads as a number
        (("load", "force"), "0x10"),
        (("load", "force"), True),
        (("load", "force"), float("nan")),
        (("load",), {"force": 1}),
    ],
    ids=str,
)
def test_what_cannot_be_written_over_is_written_anew(path, value):
    assert written_over(TEXT, {path: value}) is None


@pytest.mark.parametrize("path", [("title",), ("open",), ("load", "tilt"), ("load", "force")])
def test_both_ways_give_the_same_data(path):
    found = yaml_source.parse(yaml_source.with_overrides(TEXT, {path: "7 kN"}))[0]
    assert value_at(found, path) == "7 kN"
