"""Steady traction of dissimilar bodies, pressure and tractions together under one creepage."""

from __future__ import annotations

import itertools
import json
import math
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from verification.rolling_bodies import (
    ALUMINIUM,
    BENTALL,
    DISSIMILAR_FORCE,
    DISSIMILAR_RADIUS,
    HELD,
    IRON,
    RADIUS,
    bufler,
    dissimilar,
)
from viscontact.bodies.loads.steady_motion import steady_motion
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.runs.preparation import analysis_of

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def rolled(
    cells: int,
    friction: float,
    creepage: Any,
    *,
    exchanged: bool = False,
    errors: bool = False,
    speeds: list[float] | None = None,
) -> xr.Dataset:
    """A long roller in steady motion, at 1 m/s and then without dimensions of one, if not given."""
    cell, count = 0.2 / cells, cells + 16 + cells % 2
    plane, roller = (ALUMINIUM, IRON) if exchanged else (IRON, ALUMINIUM)
    found = vc.steady(
        *(vc.Paraboloid(math.inf, DISSIMILAR_RADIUS), plane, vc.step(DISSIMILAR_FORCE, **HELD)),
        speeds or 1.0,
        grid=vc.Grid((1, count), (1.0, count * cell), (True, False)),
        indenter_material=roller,
        rolling=True,
        friction=friction,
        creepage=creepage,
        errors=errors,
    )
    return found if speeds else found.squeeze()


def test_bodies_that_stick_roll_freely_at_the_creepage_of_bufler():
    """The force at it falls with the square of the cells, and the contact is as narrow as his."""
    exact, half = bufler()
    found = [rolled(cells, 10.0, exact) for cells in (10, 20, 40)]
    forces = [abs(float(each.tangential_force_y)) / DISSIMILAR_FORCE for each in found]
    assert forces[2] < 1e-4
    assert all(second < first / 3 for first, second in itertools.pairwise(forces))
    for each in found:
        assert each.slip_fraction == 0
        assert abs(each.resistance_y) < 1e-6 * DISSIMILAR_FORCE
    assert found[-1].contact_width / 2 == close_to(half, rel=1e-4)


@pytest.fixture(scope="module")
def over_creepages() -> xr.Dataset:
    """Contacts under the creepages that CONTACT prints for a force, in one result."""
    return rolled(40, 0.05, [creepage for creepage, _, _ in BENTALL.values()])


@pytest.mark.parametrize("part", BENTALL)
def test_dissimilar_rollers_have_the_forces_of_contact(part: float, over_creepages: xr.Dataset):
    """Under the creepages that CONTACT prints for a force; Bentall and Johnson 1967."""
    creepage, peak, sticking = BENTALL[part]
    found = over_creepages.sel(creepage=creepage)
    carried = 0.05 * DISSIMILAR_FORCE
    assert found.tangential_force_y / carried == close_to(part, abs=4e-3)
    assert found.peak_pressure == close_to(peak, rel=1e-3)
    if sticking is not None:
        assert 1 - found.slip_fraction == close_to(sticking / 200, abs=0.01)


def test_each_creepage_has_the_contact_of_a_run_of_its_own():
    creepages = [4e-4, 1e-4]
    speeds = {"errors": True, "speeds": [1.0, 2.0]}
    joint = rolled(12, 0.05, creepages, **speeds)
    assert joint.peak_pressure.dims == ("speed", "creepage")
    assert joint.pressure.dims == joint.traction_y.dims == ("speed", "creepage", "x", "y")
    assert json.loads(joint.attrs["case"])["motion"]["creepage"] == [4e-4, 1e-4]
    for creepage in creepages:
        own = rolled(12, 0.05, creepage, **speeds)
        chosen = joint.viscontact.at_creepage(creepage)
        xr.testing.assert_identical(chosen.drop_attrs(), own.drop_attrs())
        assert chosen.attrs["case"] == own.attrs["case"]
        assert set(chosen.attrs) == set(own.attrs)


def test_figures_show_the_forces_of_all_creepages_and_the_contact_of_one():
    joint = rolled(12, 0.05, [1e-4, 4e-4], speeds=[1.0])
    (line,) = joint.viscontact.plot.traction_creepage().get_lines()[:1]
    carried = 0.05 * DISSIMILAR_FORCE
    drawn = -np.asarray(line.get_ydata())
    assert drawn == close_to((joint.tangential_force_y / carried).values[0], rel=1e-9)
    for name in ("pressure-map", "motion-profile", "stick-map"):
        with pytest.raises(ValueError, match=r"^creepage: .* choose one, as in .*at_creepage"):
            joint.viscontact.plot(name)
    joint.viscontact.at_creepage(4e-4).viscontact.plot("motion-profile")
    assert "0.01 %, 0.04 %" in str(joint.viscontact)
    # The contact at a place along the creepage, of which xarray keeps the coordinate.
    assert "peak pressure" in str(joint.isel(creepage=0).viscontact)
    with pytest.raises(ValueError, match=r"must be one of those of the result \(0.0001, 0.0004\)"):
        joint.viscontact.at_creepage(2e-4)


def test_run_directories_hold_one_creepage_of_coupled_bodies():
    motion = steady_motion(1.0, "y", True, [1e-4, 2e-4])
    posed = contact_problem(
        indenter=vc.Paraboloid(math.inf, DISSIMILAR_RADIUS),
        material=IRON,
        load=vc.step(DISSIMILAR_FORCE, **HELD),
        grid=vc.Grid((1, 26), (1.0, 0.52), (True, False)),
        indenter_material=ALUMINIUM,
        motion=motion,
        friction=0.05,
    )
    with pytest.raises(ValueError, match=r"^creepage: .* got 2 creepages; give one"):
        analysis_of(posed, errors=False)


def test_steady_motion_is_the_end_of_a_run_over_time():
    march = dissimilar(12, 10.0, 0.05, creepage=2.5e-4)
    found = rolled(12, 0.05, 2.5e-4)
    assert found.tangential_force_y == close_to(march.tangential_force_y, rel=1e-3)
    assert found.friction_power == close_to(march.friction_power, rel=5e-3)
    assert found.peak_pressure == close_to(march.peak_pressure, rel=1e-5)
    assert found.slip_fraction == march.slip_fraction


def test_work_of_drive_and_resistance_is_heat_of_friction():
    """Nothing is lost in elastic bodies; in two dimensions and in three."""
    line = rolled(40, 0.05, 2.108e-4)
    cell, force = 1e-3 / 8, 4e-9 / (3 * RADIUS * (0.7 / 2e6 + 0.8 / 10e6))
    ball = vc.steady(
        *(vc.Paraboloid(RADIUS, RADIUS), vc.Material(vc.Elastic(1e6), 0.3)),
        *(vc.step(force, **HELD), 1.0),
        grid=vc.Grid((24, 24), (24 * cell, 24 * cell)),
        indenter_material=vc.Material(vc.Elastic(5e6), 0.2),
        rolling=True,
        friction=0.2,
        creepage=0.01,
        errors=False,
    ).squeeze()
    for found, creepage in ((line, 2.108e-4), (ball, 0.01)):
        put_in = found.resistance_y - found.tangential_force_y * creepage
        assert found.friction_power == close_to(float(put_in), rel=1.5e-2)
        assert found.dissipation == 0


def test_exchanged_bodies_are_driven_the_other_way():
    one, other = rolled(20, 0.05, 2e-4), rolled(20, 0.05, -2e-4, exchanged=True)
    assert one.tangential_force_y == close_to(-float(other.tangential_force_y), rel=1e-6)
    assert one.peak_pressure == close_to(float(other.peak_pressure), rel=1e-6)
    assert one.resistance_y == close_to(float(other.resistance_y), rel=1e-6)


@pytest.mark.parametrize("creepage", [4.294e-4, 2e-4])
def test_error_bars_hold_where_the_force_passes_through_zero(creepage: float):
    found, fine = rolled(24, 0.05, creepage, errors=True), rolled(120, 0.05, creepage)
    names = ("tangential_force_y", "friction_power", "slip_fraction", "resistance_y")
    for name in (*names, "peak_pressure"):
        assert abs(found[name] - fine[name]) < found[f"{name}_error"]
