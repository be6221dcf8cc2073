"""What users rely on where something is wrong: errors, warnings and refused arguments."""

from __future__ import annotations

import math
from typing import Any

import pytest

import viscontact as vc
from closeness import close_to
from project.promised_run import BALL, GRID, LOAD, RUBBER, TIMES, check_variables
from viscontact.results.descriptions import describe, rebuild

# A handful of steps is enough here; that they are few is warned about, and tested elsewhere.
pytestmark = [
    pytest.mark.filterwarnings("ignore:the load grows from nothing:viscontact.AccuracyWarning"),
    pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning"),
]


def test_contact_at_the_rim_is_a_domain_error_that_keeps_the_completed_steps() -> None:
    small = vc.Grid((32, 32), (1.35e-3, 1.35e-3))  # 1.1 mm at first, 1.4 mm in the end
    with pytest.raises(
        vc.DomainError, match=r"reaches the edge of the grid at t = .*grid\.size"
    ) as stop:
        vc.simulate(BALL, RUBBER, vc.step(0.1), small, vc.uniform_times(20.0, 20))
    partial = stop.value.partial
    assert 1 <= partial.sizes["time"] < 21
    check_variables(partial)


def test_error_at_the_first_step_has_no_partial_result() -> None:
    tiny = vc.Grid((32, 32), (0.5e-3, 0.5e-3))
    with pytest.raises(vc.DomainError) as stop:
        vc.simulate(BALL, RUBBER, vc.step(0.1), tiny, [0.0])
    assert stop.value.partial is None


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_fewer_than_four_cells_across_the_largest_contact_is_a_domain_error() -> None:
    coarse = vc.Grid((16, 16), (10e-3, 10e-3))
    with pytest.raises(vc.DomainError, match="cells lie across") as stop:
        vc.simulate(BALL, RUBBER, vc.step(0.1), coarse, [0.0])
    assert stop.value.partial.sizes["time"] == 1


def test_small_contacts_passed_through_are_no_error() -> None:
    ds = vc.simulate(BALL, RUBBER, vc.triangle(0.1, 1.0), GRID, vc.uniform_times(2.0, 40))
    assert 0 < float(ds.cells_across[1:-1].min()) < 8
    assert ds.attrs["warnings"] == ""


def test_fewer_than_ten_cells_across_is_a_warning_kept_with_the_result() -> None:
    coarse = vc.Grid((12, 12), (2.4e-3, 2.4e-3))
    with pytest.warns(vc.AccuracyWarning, match="6 cells lie across the largest"):
        ds = vc.simulate(BALL, RUBBER, vc.step(0.1), coarse, [0.0, 1.0])
    assert len(ds.attrs["warnings"].splitlines()) == 1
    assert "6 cells lie across" in ds.attrs["warnings"]


WIDE = (vc.Sphere(5e-4), RUBBER, vc.step(0.1), vc.Grid((32, 32), (9e-4, 9e-4)), [0.0])
PUNCH = (vc.FlatPunch(8e-4), RUBBER, vc.step(0.1), GRID, [0.0])
SOFTENING = vc.Material(vc.Zener(1e6, 2e5, 2e5), 0.5)  # creeps by five times its instant compliance
UNLOADED = vc.ForceHistory([0, 40], [0.1, 0.02])
HURRIED = (BALL, SOFTENING, UNLOADED, vc.Grid((48, 48), (3e-3, 3e-3)), [0.0, 20.0, 40.0])


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (WIDE, "slope within the contact"),
        (WIDE, "half width is"),
        (WIDE, "the approach is"),
        (PUNCH, "the end of the indenter's profile"),
        (HURRIED, "a time step of 20 s is long against the law"),
    ],
)
def test_theory_beyond_its_limits_and_long_steps_give_warnings(arguments: Any, said: str) -> None:
    with pytest.warns(vc.AccuracyWarning) as warned:
        ds = vc.simulate(*arguments)
    assert any(said in str(each.message) for each in warned)
    assert said in ds.attrs["warnings"]
    assert len(ds.attrs["warnings"].splitlines()) == len(warned)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_law_without_instant_compliance_is_accepted_and_refused_only_where_the_load_jumps() -> None:
    kelvin = vc.CreepSeries(0.0, [1e-6], [1.0])
    assert kelvin(0.0) == 0.0
    body = vc.Material(kelvin, 0.5)
    with pytest.raises(ValueError, match=r"jumps at t = 0 s.*use a ramp.*instant compliance"):
        vc.simulate(BALL, body, vc.step(0.1), GRID, [0.0, 1.0])
    ramped = vc.simulate(BALL, body, vc.ramp(0.1, 1.0), GRID, vc.uniform_times(2.0, 20))
    assert float(ramped.approach[-1]) > 0


@pytest.mark.parametrize(
    ("shape", "size", "said"),
    [
        (64, (1, 1), "grid.shape needs two entries, along x and y, got 64"),
        ((64, 64, 64), (1, 1), "grid.shape needs two entries"),
        ((64, 64), 1.0, "grid.size needs two entries, along x and y, got 1.0"),
        *(
            ((64, count), (1, 1), "ny must be a whole number >= 4")
            for count in (3, 64.5, math.nan, math.inf, "64", None, True, [64], 10**400)
        ),
        *(
            ((64, 64), (1, extent), "ly must be a positive finite number")
            for extent in (0, -1, math.nan, math.inf, "1", None, True, [1], 10**400)
        ),
    ],
)
def test_bad_grid_is_refused_with_what_was_got(shape: Any, size: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        vc.Grid(shape, size)


@pytest.mark.parametrize(
    ("centre", "said"),
    [
        (1.0, "grid.centre needs two entries, along x and y, got 1.0"),
        ((0.0, math.nan), "grid.centre: y must be a finite number in m, got nan"),
        (("1", 0.0), "grid.centre: x must be a finite number in m, got '1'"),
    ],
)
def test_bad_centre_of_a_grid_is_refused_with_what_was_got(centre: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        vc.Grid((64, 64), (1, 1), centre=centre)


def test_centre_of_a_grid_is_shown_and_recorded_only_if_given() -> None:
    plain, placed = GRID, vc.Grid((8, 4), (1.0, 2.0), centre=(-3, 4))
    assert "centre" not in describe(plain)
    assert "centre" not in f"{plain!r} {plain}"
    assert (plain.x == -plain.x[::-1]).all()
    assert eval(repr(placed), {"Grid": vc.Grid}) == rebuild(describe(placed)) == placed
    assert "-3 m, 4 m" in str(placed)
    assert placed.widened((12, 4)).x[2:-2] == close_to(placed.x, rel=1e-15)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"times": [1.0, 0.0]}, "times must be strictly increasing, got 1 s, then 0 s"),
        ({"times": [-1.0]}, "times must not be before 0"),
        ({"times": []}, "times must be one or more"),
        ({"times": [0.0, math.nan]}, "times must be one or more finite"),
        ({"times": [[0.0, 1.0]]}, "times must be one or more"),
        ({"times": [[0.0], [1.0, 2.0]]}, "times must be numbers in s"),
        ({"times": "soon"}, "times must be numbers in s, got 'soon'"),
        ({"times": [False, True]}, "times must be numbers in s"),
        ({"tolerance": -1e-6}, "tolerance must lie between"),
        ({"tolerance": math.nan}, "tolerance must lie between"),
        ({"threads": 0}, "threads must be a whole number >= 1, .* got 0"),
        ({"threads": 2**70}, "threads must be a whole number"),
        ({"fields": ["all"]}, "fields must be numbers in s, got 'all' at"),
        ({"fields": None}, "fields must be numbers in s, got None"),
        ({"load": vc.step(1e300)}, "load.force: .* is beyond what can be computed with"),
        ({"grid": vc.Grid((8, 8), (1e-200, 1.0))}, "grid.size: .* is beyond what can be"),
        ({"material": vc.Material(vc.Elastic(1e-200), 0.5)}, "material: .* is beyond what"),
        ({"fields": "some"}, "fields must be 'all', 'none' or instants"),
        ({"grid": (32, 32)}, "grid must be of kind Grid"),
        ({"load": 0.1}, "load must be of kind LoadHistory, got 0.1; write vc.step"),
        (
            {"material": vc.Elastic(1.0)},
            r"kind Material or Layered or Body, .*; write vc.Material",
        ),
        (
            {"material": "pmma-paper"},
            r"kind Material or Layered or Body, .*; write vc.shipped",
        ),
        ({"load": vc.step(0.1, eccentricity_x=0.02)}, "load.eccentricity_x: the force acts at"),
    ],
)
def test_bad_argument_is_refused_with_its_name_and_value(changed: Any, said: str) -> None:
    arguments = {"indenter": BALL, "material": RUBBER, "load": LOAD, "grid": GRID, "times": TIMES}
    with pytest.raises(ValueError, match=said.replace("(", r"\(")):
        vc.simulate(**{**arguments, **changed})
