"""Figures of heat balances against the table."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from rolling_curves import rolling_curve
from viscontact import plot
from viscontact.drawing.content.heat_balance import balance_panel, heating_panel, temperature_panel


@pytest.fixture(scope="module")
def table() -> xr.Dataset:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        return vc.rolling_temperature(
            rolling_curve(),
            **{"cooling": 0.036, "ambient": 300.0, "area": 1.0},
            speed=[0.004, 0.01, 0.013, 0.02, 0.1],
            **{"thickness": 8e-3, "heat_capacity": 1800.0, "density": 1150.0},
        ).table


def test_balances_are_drawn_where_power_and_cooling_meet(table: xr.Dataset) -> None:
    panel = balance_panel(table)
    cooling = next(curve for curve in panel.curves if curve.name == "cooling")
    markers = [curve for curve in panel.curves if not curve.is_line]
    assert sum(curve.x.size for curve in markers) == np.isfinite(table.temperature.values).sum()
    for curve in markers:
        np.testing.assert_allclose(np.interp(curve.x, cooling.x, cooling.y), curve.y, rtol=1e-6)
    looks = {"points": table.stable.values.sum(), "hollow": (~table.stable.values).sum()}
    looks["hollow"] -= np.isnan(table.temperature.values).sum()
    for look, count in looks.items():
        assert sum(curve.x.size for curve in markers if curve.look == look) == count > 0


def test_branches_over_speed_pass_through_the_balances_and_turn_at_the_runaway(
    table: xr.Dataset,
) -> None:
    panel = temperature_panel(table)
    stable, unstable = (
        next(curve for curve in panel.curves if curve.name == name)
        for name in ("stable", "unstable")
    )
    runaway = table.attrs["runaway_speed"]
    assert [mark.place for mark in panel.marks] == [runaway]
    cold = stable.y + 273.15 <= table.attrs["runaway_temperature"]
    assert np.nanmax(stable.x[cold]) == close_to(runaway, rel=1e-3)
    assert np.nanmax(unstable.x) == close_to(runaway, rel=1e-2)
    lowest = table.temperature.values[1, 0] - 273.15
    inside = cold & np.isfinite(stable.x)
    assert np.interp(0.01, stable.x[inside], stable.y[inside]) == close_to(lowest, abs=0.01)


def test_heating_of_each_speed_begins_at_rest(table: xr.Dataset) -> None:
    panel = heating_panel(table)
    assert len(panel.curves) == 5
    assert all(curve.y[0] == close_to(26.85, rel=1e-12) for curve in panel.curves)


def test_figures_of_a_table_are_drawn(table: xr.Dataset) -> None:
    labels = {
        plot.heat_balance: ("Temperature [°C]", "Power [W]"),
        plot.rolling_temperature: ("Speed [mm/s]", "Temperature [°C]"),
        plot.rolling_heating: ("Time [d]", "Temperature [°C]"),
    }
    for draw, (x, y) in labels.items():
        axes = draw(table).axes[0]
        assert (axes.get_xlabel(), axes.get_ylabel()) == (x, y)
    with pytest.raises(ValueError, match="the table has no heating over time; give heat_capacity"):
        plot.rolling_heating(table.drop_dims("time"))
