"""Temperatures of a rolling body from a curve over speed: balances, tables, refusals."""

from __future__ import annotations

import dataclasses
import json
import warnings

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from rolling_curves import COVER, RUBBER, SHIFT, STEEL, rolling_curve
from viscontact.results.descriptions import describe

AREA = 2 * np.pi * 60e-3 * 0.5
AIR = {"cooling": 10.0, "ambient": 333.15}


def balanced(curve=None, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        return vc.rolling_temperature(rolling_curve() if curve is None else curve, **AIR | options)


def test_power_of_each_balance_flows_off_the_roll() -> None:
    """V R(V a_T) of the formula is h A (T - T_a), with the circumference of the case."""
    found = balanced(speed=[0.01, 0.1, 1.0])
    for speed, temperature in zip(found.table.speed.values, found.temperature.values, strict=True):
        hot = temperature[np.isfinite(temperature)]
        scaled = speed * SHIFT.factor(hot)
        power = speed * 40.0 * 2 * scaled / (1 + scaled**2)
        np.testing.assert_allclose(power, 10.0 * AREA * (hot - 333.15), rtol=2e-3)
    assert found.table.attrs["area"] == close_to(AREA, rel=1e-12)
    assert found.stable.dtype == bool
    # A relative error of the power of 1 % moves the temperature by as much of the rise, less
    # what the change of the power with the temperature takes.
    one = found.table.isel(speed=1, root=0)
    rise = float(one.temperature) - 333.15
    assert 0.002 * rise < float(one.temperature_error) < 0.02 * rise


def test_hot_spot_is_the_exact_slab_of_the_balance() -> None:
    found = balanced(speed=[0.05], conductivity=0.2)
    one = found.table.isel(speed=0, root=0)
    source = float(one.power) / (AREA * 8e-3)
    rise = source * 8e-3 / 10.0 + source * 8e-3**2 / (2 * 0.2)
    assert float(one.hot_spot) == close_to(333.15 + rise, rel=1e-10)
    assert float(one.surface_temperature) == close_to(333.15 + source * 8e-3 / 10.0, rel=1e-10)
    assert float(one.surface_temperature) < float(one.temperature) < float(one.hot_spot)
    held = balanced(speed=[0.05], conductivity=0.2, core_temperature=323.15)
    assert float(held.temperature[0, 0]) < float(one.temperature)


def test_heating_ends_at_the_coldest_stable_balance() -> None:
    found = balanced(speed=[0.02, 0.05], conductivity=0.2, heat_capacity=1800.0, density=1150.0)
    table = found.table
    assert table.heating_temperature.values[:, 0] == close_to([333.15, 333.15], rel=1e-12)
    last = table.heating_temperature.values[:, -1]
    coldest = table.temperature.values[:, 0]
    assert last - 333.15 == close_to(coldest - 333.15, rel=5e-3)
    assert table.heating_hot_spot.values[:, -1] == close_to(table.hot_spot.values[:, 0], rel=1e-3)


def test_curve_of_a_warm_law_gives_the_same_temperatures() -> None:
    """The same roll, computed at another temperature: V a_T is what counts."""
    factor = SHIFT.factor(350.0)
    speeds = np.geomspace(1e-4, 1e4, 33)
    warm = vc.Layered([vc.Layer(8e-3, RUBBER.at(350.0))], base=STEEL)
    curve = rolling_curve(speeds=speeds, indenter_material=warm)
    at_reference = curve.resistance_y.values
    scaled = curve.assign_coords(speed=speeds / factor)
    assert scaled.resistance_y.values.tolist() == at_reference.tolist()
    one, other = (balanced(each, speed=[0.03, 0.3]) for each in (rolling_curve(), scaled))
    np.testing.assert_allclose(one.temperature, other.temperature, rtol=1e-8)
    # A run with a temperature of its own records the law at its reference.
    case = json.loads(rolling_curve().attrs["case"])
    case["temperature"] = describe(vc.TemperatureHistory([0.0], 350.0))
    own = scaled.assign_attrs(case=json.dumps(case))
    np.testing.assert_allclose(balanced(own, speed=[0.03, 0.3]).temperature, one.temperature)


def test_what_the_curve_does_not_reach_is_named_and_not_a_number() -> None:
    short = rolling_curve(speeds=np.geomspace(1e-2, 1.0, 9))
    with pytest.warns(vc.AccuracyWarning, match=r"at 1 m/s the curve gives no power of the cold"):
        found = vc.rolling_temperature(short, **AIR, speed=[0.1, 1.0])
    assert "compute the curve up to 3.01 m/s" in found.notes[0]
    # At 380 K the shift factor is exp(150e3/R (1/380 - 1/340)) = 3.75e-3: the curve is too fast.
    with pytest.raises(ValueError, match=r"compute the curve down to 372 µm/s, which is the speed"):
        vc.rolling_temperature(short, **AIR | {"ambient": 380.0}, speed=[0.1, 1.0])
    assert found.table.coldest.values[0] == close_to(333.15)
    assert found.table.coldest.values[1] > 338.0
    unknown = found.table.power_at.isel(speed=1).where(
        found.table.at_temperature < found.table.coldest[1] - 0.01, drop=True
    )
    assert unknown.size > 10
    assert np.isnan(unknown).all()
    with pytest.raises(ValueError, match=r"reaches no balance .* hotter balances are not known"):
        balanced(short, speed=[0.5], cooling=0.01)


def test_vertical_shift_is_left_out_by_name() -> None:
    table = vc.TabulatedShift([300.0, 340.0, 400.0], [50.0, 1.0, 0.01], [0.9, 1.0, 1.2])
    cover = vc.Layered([vc.Layer(8e-3, dataclasses.replace(RUBBER, shift=table))], base=STEEL)
    found = balanced(rolling_curve(indenter_material=cover), speed=[0.1, 1.0])
    assert any("vertical shift is left out" in note for note in found.notes)


OTHER = dataclasses.replace(RUBBER, shift=vc.WLF(340.0, 8.86, 101.6))
BARE = dataclasses.replace(RUBBER, shift=None)


@pytest.mark.parametrize(
    ("curve", "options", "said"),
    [
        (lambda: "roll", {}, "curve: must be the result of a steady motion .* got str"),
        (lambda: rolling_curve().rename(speed="time"), {}, "got one over time"),
        (lambda: rolling_curve(indenter_material=None), {}, "neither body creeps"),
        (lambda: rolling_curve(speeds=[0.1, 1.0, 2.0]), {}, "needs the resistance at 4 speeds"),
        (lambda: rolling_curve(-1.0), {}, "the resistance must be positive"),
        (lambda: rolling_curve(indenter_material=BARE), {}, "indenter_material: has no shift"),
        (
            lambda: rolling_curve(material=OTHER),
            {"area": 0.1},
            r"material and indenter_material\.layer 1: both creep, with shifts that differ",
        ),
        (lambda: rolling_curve(material=RUBBER), {}, "area: must be given"),
        (lambda: rolling_curve(material=RUBBER, indenter_material=None), {}, "area: must be given"),
        (lambda: rolling_curve(rolling=False), {}, "area: must be given"),
        (rolling_curve, {"cooling": -1.0}, r"cooling must be a positive finite number.*W/\(m2 K\)"),
        (rolling_curve, {"ambient": 23 - 273.15}, "ambient must be"),
        (rolling_curve, {"core_temperature": 300.0}, "core_temperature: needs the conductivity"),
        (rolling_curve, {"density": 1150.0}, "density: the heating over time needs heat_capacity"),
        (rolling_curve, {"speed": [0.0]}, "speed must be positive"),
        (
            lambda: rolling_curve(indenter_material=RUBBER),
            {"conductivity": 0.2},
            r"thickness: must be given with conductivity.*\(indenter_material\)",
        ),
    ],
)
def test_bad_arguments_are_refused_by_name(curve, options, said) -> None:
    with pytest.raises(ValueError, match=said):
        balanced(curve(), **options)


def test_a_law_that_was_referred_to_a_temperature_has_the_shift_of_one_given_there() -> None:
    warm = OTHER.at(350.0)
    given = dataclasses.replace(warm, shift=vc.WLF(350.0, warm.shift.c1, warm.shift.c2))
    cover = vc.Layered([vc.Layer(8e-3, warm)], base=STEEL)
    both = rolling_curve(material=given, indenter_material=cover)
    alone = rolling_curve(indenter_material=cover)
    found, expected = (balanced(each, speed=[0.1], area=0.1).temperature for each in (both, alone))
    np.testing.assert_array_equal(found, expected)


def test_ambient_beyond_the_shift_is_refused() -> None:
    table = vc.TabulatedShift([335.0, 400.0], [2.0, 0.01])
    cover = vc.Layered([vc.Layer(8e-3, dataclasses.replace(RUBBER, shift=table))], base=STEEL)
    with pytest.raises(ValueError, match="ambient: TabulatedShift: must be used between 335"):
        balanced(rolling_curve(indenter_material=cover))


def test_both_bodies_of_one_material_are_taken_at_one_temperature() -> None:
    found = balanced(rolling_curve(material=RUBBER, indenter_material=COVER), area=0.1, speed=[1.0])
    assert any("both bodies creep" in note for note in found.notes)


def test_table_is_saved_and_read_again(tmp_path) -> None:
    found = balanced(speed=[0.1])
    found.table.to_netcdf(tmp_path / "heat.nc")
    assert json.loads(json.dumps(found.table.attrs["notes"])) == "\n".join(found.notes)
    assert "thermal runaway" in str(found) or "no runaway" in str(found)


LINE = vc.Grid((1, 48), (1.0, 3e-3), periodic=(True, False))
CREEPING = vc.Material(vc.Zener(9e6, 1e6, 1e4), 0.5, shift=vc.WLF(296.0, 8.86, 101.6))
SPEEDS = np.geomspace(0.05, 2.0, 7)


def rolled(material, speeds):
    """The solved line contact of a cylinder of 10 mm radius, over speed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)  # a line contact has no approach
        return vc.steady(
            *(vc.Paraboloid(np.inf, 0.01), material, vc.step(400.0, tilt_y=0.0), speeds),
            grid=LINE,
            errors=False,
            fields="none",
        )


@pytest.fixture(scope="module")
def solved_curve():
    return rolled(CREEPING, SPEEDS)


def test_steady_curve_of_a_case_with_a_temperature_has_the_shift(solved_curve) -> None:
    """The law of the run is slowed to its temperature; its shift is referred to it."""
    warm = rolled(CREEPING.at(301.0), SPEEDS / CREEPING.shift.factor(301.0))
    found = [
        balanced(curve, ambient=296.0, area=0.1, speed=[0.4]) for curve in (solved_curve, warm)
    ]
    one, other = (float(each.temperature[0, 0]) for each in found)
    assert one == close_to(other, abs=0.02)
    assert one > 299.0


def test_contact_at_the_temperature_of_a_balance_has_the_power_that_flows_off(solved_curve) -> None:
    """The contact with the law at the balance is solved, and its dissipation is h A (T - T_a)."""
    hot = float(balanced(solved_curve, ambient=296.0, area=0.1, speed=[0.4]).temperature[0, 0])
    contact = rolled(CREEPING.at(hot), 0.4)
    assert hot > 300.0
    assert float(contact.dissipation[0]) == close_to(10.0 * 0.1 * (hot - 296.0), rel=2e-3)
