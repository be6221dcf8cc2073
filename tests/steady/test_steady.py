"""Contacts in steady motion: exact limits, identities, laws, two bodies, results, refusals."""

import warnings

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.reference import (
    fast_sphere_friction_coefficient,
    hertz_sphere,
    slow_friction_coefficient,
)

RADIUS, FORCE = 10.0, 10.0
BALL = vc.Paraboloid(RADIUS, RADIUS)
LEVEL = vc.step(FORCE, tilt_x=0.0, tilt_y=0.0)
COARSE = vc.AutomaticGrid(tolerance=0.04)  # 30 cells across the contact
# Contact compliance 1/2000 at once and 10/2000 at last, retarded by 10 s.
RUBBER = vc.Material(vc.CreepSeries(1 / 1000, [9 / 1000], [10.0]), poisson_ratio=0.5)


def steady(speed, *, body=BALL, material=RUBBER, load=LEVEL, grid=COARSE, **options):
    options = {"along": "x", "errors": False, "fields": "none"} | options
    return vc.steady(body, material, load, speed, grid=grid, **options)


def coefficient(*arguments, **options):
    return float(steady(*arguments, **options).friction_coefficient[0])


def test_slow_and_fast_contacts_are_those_of_hertz_with_the_exact_friction():
    slow, fast = 1e-4, 1e4
    ds = steady([slow, fast], errors=True)
    friction = ds.friction_coefficient.values
    # The cells, of 27 mm, are long against the retardation length of 1 mm; the bar shows it.
    exact = slow_friction_coefficient(RADIUS, 9.0, slow)
    assert friction[0] == close_to(exact, rel=0.05)
    assert abs(friction[0] - exact) < ds.friction_coefficient_error[0]
    exact = fast_sphere_friction_coefficient(FORCE, RADIUS, 1 / 2000, 9 / 2000 / 10, fast)
    assert friction[1] == close_to(exact, rel=2e-4)
    for index, compliance in enumerate((10 / 2000, 1 / 2000)):
        hertz = hertz_sphere(FORCE, RADIUS, 1 / compliance)
        here = ds.isel(speed=index)
        for name, value in (
            ("approach", hertz.approach),
            ("contact_area", np.pi * hertz.contact_radius**2),
            ("peak_pressure", hertz.peak_pressure),
        ):
            assert abs(here[name] - value) < here[f"{name}_error"], name
            assert here[name] == close_to(value, rel=5e-3)


@pytest.mark.slow
def test_error_bars_hold_the_values_of_a_finer_grid():
    speeds = [0.05, 0.5, 5.0]
    coarse = steady(speeds, errors=True)
    fine = steady(speeds, grid=vc.AutomaticGrid(tolerance=0.004))
    outside = [
        name
        for name in coarse
        if f"{name}_error" in coarse
        for here in range(len(speeds))
        if abs(coarse[name] - fine[name])[here] > coarse[f"{name}_error"][here]
    ]
    assert outside == []
    friction = coarse.friction_coefficient
    assert (coarse.friction_coefficient_error / friction < 0.02).all()
    assert np.abs(friction / fine.friction_coefficient - 1).max() < 5e-3


def test_a_body_that_turns_freely_has_the_friction_of_a_level_one():
    with pytest.warns(vc.AccuracyWarning, match=r"tilt_x = 0"):
        free = steady(0.1, load=vc.step(FORCE, tilt_y=0.0))
    assert float(free.tilt_x[0]) == close_to(-float(free.friction_coefficient[0]), rel=1e-6)
    assert float(free.friction_coefficient[0]) == close_to(coefficient(0.1), rel=1e-3)
    assert abs(float(free.eccentricity_x[0])) < 1e-9


def test_motion_along_y_is_motion_along_x_of_the_turned_body():
    body, turned = vc.Paraboloid(RADIUS, 3.0), vc.Paraboloid(3.0, RADIUS)
    x, y = steady(0.1, body=body), steady(0.1, body=turned, along="y")
    assert float(y.resistance_y[0]) == close_to(float(x.resistance_x[0]), rel=1e-9)
    # Both are solved to 1e-6, and the search in single precision rounds along other axes.
    assert float(y.contact_width[0]) == close_to(float(x.contact_length[0]), rel=1e-7)
    assert float(y.dissipation[0]) == close_to(0.1 * float(x.resistance_x[0]), rel=1e-9)
    assert abs(float(y.resistance_x[0])) < 1e-12


@pytest.mark.slow
def test_a_prescribed_approach_gives_back_the_force():
    ds = steady(0.1, tolerance=1e-9)
    back = steady(0.1, load=vc.step(approach=float(ds.approach[0]), tilt_x=0.0, tilt_y=0.0))
    assert float(back.force[0]) == close_to(FORCE, rel=2e-3)  # on other cells
    assert float(back.friction_coefficient[0]) == close_to(coefficient(0.1), rel=2e-3)


def test_an_elastic_body_has_no_resistance():
    steel = vc.Material(vc.Elastic(500.0), poisson_ratio=0.5)
    ds = steady(0.1, material=steel)
    assert abs(float(ds.friction_coefficient[0])) < 1e-9
    assert abs(float(ds.eccentricity_x[0])) < 1e-6 * float(ds.contact_length[0])


def loss_under_hertz(length):
    """∫ p (u - E u) dA/(F l) with the pressure p and the displacement u of Hertz's ball.

    Displacement outside the contact: Johnson 1985, eq. 3.42a.
    """
    a = (0.75 * FORCE * RADIUS / 2000) ** (1 / 3)
    # Pressure is even over s = sqrt(1 - r²/a²): dA = 2 π a² s ds, p = 3 F s/(2 π a²).
    node, weight = np.polynomial.legendre.leggauss(40)
    s, angle = (1 + node) / 2, np.pi * (1 + node) / 2
    along = a * np.sqrt(1 - s**2)[:, None] * np.cos(angle)
    across = a * np.sqrt(1 - s**2)[:, None] * np.sin(angle)
    share = 1.5 * (s**2 * weight)[:, None] * weight / 2  # of the force

    def surface(x):
        r = np.hypot(x, across[..., None]) / a
        out = np.maximum(r, 1.0)
        beyond = ((2 - out**2) * np.arcsin(1 / out) + np.sqrt(out**2 - 1)) / np.pi
        return a**2 / RADIUS * np.where(r < 1, 1 - r**2 / 2, beyond)

    z = np.concatenate([part + (1 + node) / 2 for part in range(40)])  # over the length
    late = surface(along[..., None] + length * z) @ (np.tile(weight / 2, 40) * np.exp(-z))
    return float((share * (surface(along[..., None])[..., 0] - late)).sum()) / length


@pytest.mark.parametrize(
    ("speed", "error"), [(0.1, 5e-3), pytest.param(10.0, 5e-4, marks=pytest.mark.slow)]
)
def test_a_body_that_hardly_creeps_loses_as_hertz_contact_does(speed, error):
    """To first order in the creep, by the slope of the body and by the dissipation."""
    material = vc.Material(vc.CreepSeries(1e-3, [1e-6], [1.0]), poisson_ratio=0.5)
    # Measured: 3e-3 and -2e-4.
    found = coefficient(speed, material=material, tolerance=1e-9)
    assert found == close_to(1e-3 * loss_under_hertz(speed), rel=error)


def test_a_fluid_has_the_friction_of_its_flow_and_no_approach():
    fluid = vc.Material(vc.Maxwell(shear_modulus=500.0, viscosity=5000.0), poisson_ratio=0.5)
    with pytest.warns(vc.AccuracyWarning, match="the material flows"):
        ds = steady([1e3, 0.1], material=fluid)
    # J(t) = (1 + t/10 s)/2000; the next term of the limit is of the order 1/V.
    exact = fast_sphere_friction_coefficient(FORCE, RADIUS, 1 / 2000, 1 / 20000, 1e3)
    assert float(ds.friction_coefficient[0]) == close_to(exact, rel=2e-3)
    assert np.isnan(ds.approach).all()
    slow = vc.Material(vc.CreepSeries(1 / 1000, [1e7], [1e11]), poisson_ratio=0.5)
    retarded = coefficient(0.1, material=slow)
    assert float(ds.friction_coefficient[1]) == close_to(retarded, rel=1e-3)  # other cells


def test_a_law_that_is_no_series_is_approximated():
    """A power of time has no time scale: friction depends on speed by a power as well."""
    creep = vc.Material(vc.PowerLaw(1e-3, 0.5, 1.0), poisson_ratio=0.5)
    with pytest.warns(vc.AccuracyWarning, match="no instant compliance"):
        ds = steady([0.01, 1.0], material=creep)
    # a^3 ~ J(a/V) = sqrt(a/V), so that a ~ V^(-1/5), and F/W ~ a/R.
    ratio = float(ds.friction_coefficient[0] / ds.friction_coefficient[1])
    assert ratio == close_to(100**0.2, rel=2e-3)
    assert ds.attrs["memory_error"] < 1e-5


@pytest.mark.slow
def test_rolling_bodies_may_be_exchanged_and_a_sliding_one_is_relaxed():
    stiff = vc.Material(vc.CreepSeries(2e-3, [3e-3], [1.0]), poisson_ratio=0.5)
    one = coefficient(0.1, indenter_material=stiff, rolling=True)
    other = coefficient(0.1, material=stiff, indenter_material=RUBBER, rolling=True)
    assert one == close_to(other, rel=1e-4)  # less what returns after a turn of 63 m
    slides = coefficient(0.1, indenter_material=stiff, rolling=False)
    relaxed = vc.Material(vc.Elastic(100.0), poisson_ratio=0.5)
    assert slides == close_to(coefficient(0.1, indenter_material=relaxed), rel=1e-5)
    assert slides < one


def test_a_roller_that_returns_before_it_recovers_resists_less():
    fast = 100.0  # its retardation length of 1 km is 16 turns
    once = coefficient(fast, material=RUBBER)
    steel = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    again = steady(fast, material=steel, indenter_material=RUBBER, rolling=True)
    assert 0 < float(again.friction_coefficient[0]) < once
    hertz = hertz_sphere(FORCE, RADIUS, 2000.0)
    assert float(again.approach[0]) > hertz.approach


def test_results_are_saved_with_fields_of_some_speeds(tmp_path):
    speeds = [0.1, 10.0, 1.0]
    ds = vc.steady(BALL, RUBBER, LEVEL, speeds, along="x", grid=COARSE, fields=[1.0, 10.0])
    assert ds.speed.values.tolist() == speeds
    assert ds.field_speed.values.tolist() == [10.0, 1.0]
    assert ds.pressure.dims == ("field_speed", "x", "y")
    area = np.diff(ds.x)[0] * np.diff(ds.y)[0]
    assert (ds.pressure.sum(("x", "y")) * area).values == close_to([FORCE, FORCE], rel=1e-6)
    assert float(ds.line_load[1].idxmax()) > 0  # the load lies ahead of the axis
    vc.save(ds, tmp_path / "curve.nc")
    with vc.open_results(tmp_path / "curve.nc") as stored:
        assert stored.identical(ds)


def test_progress_counts_the_speeds_in_their_order():
    seen = []
    steady([1.0, 0.1], progress=lambda state, done, total: seen.append((state, done, total)))
    assert [each[1:] for each in seen] == [(1, 2), (2, 2)]
    assert seen[0][0].friction_coefficient < seen[1][0].friction_coefficient


def test_a_contact_at_the_rim_of_a_given_grid_is_refused_with_the_speeds_before():
    grid = vc.Grid((48, 48), (0.8, 0.8))
    with pytest.raises(vc.DomainError, match="edge of the grid at 100 mm/s") as stop:
        steady([100.0, 0.1], grid=grid)
    assert stop.value.partial.speed.values.tolist() == [100.0]


def test_a_sharp_end_has_an_unknown_peak_and_a_resistance():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        ds = steady(0.1, body=vc.FlatPunch(1.0), errors=True)
    assert np.isinf(ds.peak_pressure_error[0])
    assert 0 < ds.friction_coefficient_error[0] < 0.1 * ds.friction_coefficient[0]


MATE = {"indenter_material": RUBBER}
FLUID = vc.Material(vc.Maxwell(500.0, 5000.0), poisson_ratio=0.5)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"speed": 0.0}, "speed must be positive"),
        ({"speed": [1.0, 1.0]}, "needed once"),
        ({"along": "z"}, "along must be"),
        ({"load": vc.ramp(1.0, 1.0)}, "changes in time"),
        ({"load": vc.harmonic(2.0, 1.0, 1.0, 3)}, "changes in time"),
        ({"load": vc.ForceHistory([0, 1, 1, 2], [1, 1, 0, 0])}, "changes in time"),
        ({"load": vc.ForceHistory([0, 1, 1, 2], [0, 0, 1, 1])}, "changes in time"),
        ({"load": vc.ForceHistory([0, 1], [2, 2], tilt_x=[0, 0.1])}, "changes in time"),
        ({"load": vc.step(0.0)}, "force must be positive"),
        ({"load": vc.step(approach=-1.0, tilt_x=0.0, tilt_y=0.0)}, "does not touch"),
        ({"load": vc.step(approach=-1.0, tilt_x=0.0)}, "does not touch"),
        (
            MATE | {"rolling": True, "grid": vc.Grid((32, 32), (40.0, 40.0))},
            r"grid\.size: the grid is 40 m long .* half its circumference, 31\.4 m",
        ),
        ({"fields": [2.0]}, "some of the speeds"),
        ({"rolling": "yes"}, "rolling must be"),
        (MATE, "rolling and sliding differ"),
        (MATE | {"rolling": True, "body": vc.FlatPunch(1.0)}, "cannot roll"),
        ({"indenter_material": FLUID, "rolling": False}, "creeps without limit"),
        ({"indenter_material": FLUID, "rolling": True}, "creeps without limit"),
        ({"grid": vc.Grid((8, 8), (1.0, 1.0), periodic=(True, False))}, "across the motion"),
        ({"body": vc.Paraboloid(RADIUS, np.inf), "along": "y"}, "without end"),
        (
            MATE | {"rolling": True, "grid": vc.Grid((8, 8), (1.0, 1.0), periodic=True)},
            "cannot roll",
        ),
    ],
)
def test_problems_without_a_steady_state_are_refused(options, message):
    with pytest.raises(ValueError, match=message):
        steady(**({"speed": 1.0} | options))


def test_speeds_whose_contacts_differ_much_in_size_are_reported():
    """Hertz: a third power of the ratio of compliances is that of the sizes, here 6.3."""
    wide = vc.Material(vc.CreepSeries(1e-5, [250e-5], [10.0]), poisson_ratio=0.5)
    grid = vc.AutomaticGrid(tolerance=0.09)  # 20 cells across
    # 20 cells times 4/6.3 across the smallest contact.
    with pytest.warns(
        vc.AccuracyWarning, match=r"about 0\.2\d in place of 0\.09; compute the fast"
    ):
        ds = steady([1e-3, 1e5], material=wide, grid=grid)
    assert ds.cells_across.values[1] == close_to(20 * 4 / 251 ** (1 / 3), abs=2)
    wider = vc.Material(vc.CreepSeries(1e-8, [1e-2], [10.0]), poisson_ratio=0.5)
    with pytest.raises(vc.DomainError, match=r"cells lie across .* different runs"):
        steady([1e8, 1e-5], material=wider, grid=grid)


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_law_is_extrapolated_where_the_passage_is_longer_than_its_data(along):
    """An elastic contact is as at rest, here three times as long along y as along x."""
    body, grid = vc.Paraboloid(RADIUS, 5 * RADIUS), vc.Grid((24, 40), (0.9, 2.0))

    def at_2_metres_a_second(measured_until):
        measured = vc.Material(vc.Elastic(1000), 0.5, measured_until=measured_until)
        return steady(2.0, body=body, material=measured, grid=grid, along=along)

    free = at_2_metres_a_second(1e9)
    assert float(free.contact_width[0] / free.contact_length[0]) == close_to(3.0, rel=0.1)
    # Longer than the passage along x, and shorter than that along y.
    middle = np.sqrt(4 / np.pi * float(free.contact_area[0])) / 2.0
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        at_2_metres_a_second(middle)
    assert any("where the material's data end" in str(each.message) for each in found) == (
        along == "y"
    )


def test_curve_at_a_temperature_is_that_of_the_slowed_law_and_has_the_temperature():
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), 0.5, shift=vc.WLF(293.15, 8.86, 101.6))
    ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    grid = vc.Grid((40, 40), (4e-3, 4e-3))
    warm, slowed = (
        vc.steady(ball, body, load, [0.1, 1.0], grid=grid, errors=False, temperature=temperature)
        for body, temperature in ((rubber, 303.15), (rubber.at(303.15), None))
    )
    np.testing.assert_array_equal(warm.friction_coefficient, slowed.friction_coefficient)
    assert warm.temperature.values.tolist() == [303.15, 303.15]
    assert "reduced_time" not in warm
    assert "temperature" not in slowed
