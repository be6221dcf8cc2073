"""Line contacts in steady motion against Hunter's cylinder."""

import numpy as np
import pytest
from scipy.special import beta

import viscontact as vc
from closeness import close_to
from viscontact.reference import moving_cylinder

RADIUS, FORCE, CELLS = 10.0, 10.0, 64
SLOW_EXPONENTS = [pytest.param(each, marks=pytest.mark.slow) for each in (0.2, 0.5, 0.7, 0.9)]
CYLINDER, LEVEL = vc.Paraboloid(np.inf, RADIUS), vc.step(FORCE, tilt_y=0.0)


def hunter(speed, ratio=10):
    return moving_cylinder(FORCE, RADIUS, 1 / 2000, (ratio - 1) / 2000, float(ratio), speed)


def rubber(ratio=10):
    series = vc.CreepSeries(1 / 1000, [(ratio - 1) / 1000], [float(ratio)])
    return vc.Material(series, poisson_ratio=0.5)


def line(exact, cells=CELLS, pieces=1, shift=0.3):
    """Grid of one unit of length with so many cells across the contact, at any place in a cell."""
    cell = 2 * exact.half_width / cells
    count = 8 * round(cells * 1.25 / 8)
    centre = (0.0, exact.offset + shift * cell)
    return vc.Grid((pieces, count), (1.0, count * cell), periodic=(True, False), centre=centre)


# mu is within 1e-3 at 128 cells from speeds V tau/a of 0.01 on; here are 64.
@pytest.mark.parametrize(
    ("speed", "ratio", "limit"),
    [(0.005, 10, 5e-3), (0.02, 10, 1e-3), (0.1, 10, 2e-4), (10.0, 10, 2e-5), (1.0, 100, 1e-3)],
)
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_the_cylinder_is_hunters(speed, ratio, limit):
    exact = hunter(speed, ratio)
    ds = vc.steady(CYLINDER, rubber(ratio), LEVEL, speed, grid=line(exact)).isel(speed=0)
    for name, value in (
        ("friction_coefficient", exact.friction_coefficient),
        ("contact_width", 2 * exact.half_width),
    ):
        assert abs(ds[name] - value) < ds[f"{name}_error"], name
    assert ds.friction_coefficient == close_to(exact.friction_coefficient, rel=limit)
    assert ds.contact_width == close_to(2 * exact.half_width, rel=1e-2)
    # On a parabola the resultant lies ahead of the axis by mu R.
    assert ds.eccentricity_y == close_to(RADIUS * exact.friction_coefficient, rel=2e-2)


def with_warning(function, *arguments, **options):
    with pytest.warns(vc.AccuracyWarning, match="approach is not defined"):
        return function(*arguments, **options)


def test_pieces_along_the_cylinder_change_nothing_and_the_approach_has_no_datum():
    exact = hunter(0.1)
    one, many = (
        with_warning(vc.steady, CYLINDER, rubber(), LEVEL, 0.1, grid=line(exact, 32, pieces=pieces))
        for pieces in (1, 4)
    )
    assert np.isnan(one.approach).all()
    assert np.isnan(one.eccentricity_x).all()
    assert many.pressure.values.std(axis=1).max() < 1e-6 * many.pressure.values.max()
    assert float(many.friction_coefficient[0]) == close_to(
        float(one.friction_coefficient[0]), rel=1e-7
    )


def power_law_cylinder(exponent, coefficient, speed):
    """Length of the contact, its rear end and the friction coefficient for J(t) = c t^α.

    The slope of the surface is -D ∫ p(x') (x - x')^(α - 1) dx' behind x and cos(π α) D times that
    ahead, D = 2 c α V^-α/sin(π α): a generalized Abel equation (Carleman 1922; Samko, Kilbas and
    Marichev 1993, section 30). With -x/R under the body, p is proportional to
    s^(1/2) (1 - s)^(1/2 - α) at s from the rear end over the length. Without creep it is Hertz's.
    """
    slope = 2 * coefficient * exponent / speed**exponent / np.sin(np.pi * exponent)
    scale = FORCE * RADIUS * slope * np.pi * (1 - exponent) / beta(1.5, 1.5 - exponent)
    length = scale ** (1 / (2 - exponent))
    friction = length / RADIUS * exponent * (2 - exponent) / (3 - exponent) / (1 - exponent)
    return length, length * (exponent - 0.5) / (1 - exponent), friction


def test_closed_form_for_a_power_law_tends_to_hertz():
    length, rear, friction = power_law_cylinder(1e-9, 1 / 2000, 1.0)
    half = np.sqrt(4 * FORCE * RADIUS / (np.pi * 2000))
    assert (length, rear, friction) == close_to((2 * half, -half, 0.0), abs=1e-8)


# Close to flow, most of the slope is by creep long after the body has passed.
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize("exponent", [0.3, 0.8, 0.95, *SLOW_EXPONENTS])
def test_the_cylinder_on_a_power_law_is_the_exact_one(exponent):
    speed, cells = 0.1, 64
    material = vc.Material(vc.PowerLaw(1e-3, exponent, 1.0), poisson_ratio=0.0)
    length, rear, friction = power_law_cylinder(exponent, 1e-3, speed)
    cell, count = length / cells, 8 * round(cells * 1.5 / 8)
    centre = (0.0, rear + length / 2 + 0.3 * cell)
    grid = vc.Grid((1, count), (1.0, count * cell), periodic=(True, False), centre=centre)
    ds = vc.steady(CYLINDER, material, LEVEL, speed, grid=grid, tolerance=1e-8).isel(speed=0)
    # Measured: -1e-4 to 2e-4.
    assert float(ds.friction_coefficient) == close_to(friction, rel=3e-4)
    assert abs(float(ds.friction_coefficient) - friction) < float(ds.friction_coefficient_error)
    assert abs(float(ds.contact_width) - length) < float(ds.contact_width_error)
    assert np.isinf(ds.peak_pressure_error) == (exponent > 0.5)


def test_a_prescribed_approach_of_a_line_contact_is_refused():
    load = vc.step(approach=0.01, tilt_y=0.0)
    with pytest.raises(ValueError, match="datum"):
        vc.steady(CYLINDER, rubber(), load, 0.1, grid=line(hunter(0.1)))


def test_a_line_contact_on_a_fluid_has_no_steady_state_and_is_refused():
    """Hunter's friction on a delay that tends to flow grows as the logarithm of its time."""
    friction = [
        moving_cylinder(FORCE, RADIUS, 1 / 2000, time / 20000, time, 1.0).friction_coefficient
        for time in (1e4, 1e7, 1e10)
    ]
    assert friction[2] - friction[1] == close_to(friction[1] - friction[0], rel=1e-4)
    assert friction[1] - friction[0] > 0.5 * friction[0]
    fluid = vc.Material(vc.Maxwell(500.0, 5000.0), poisson_ratio=0.5)
    # A law that is no series is found to be a fluid as well.
    power = vc.Material(vc.PowerLaw(1e-3, 1.0, 1.0, instant=1e-3), poisson_ratio=0.5)
    for material in (fluid, power):
        with pytest.raises(ValueError, match="material: the material flows"):
            vc.steady(CYLINDER, material, LEVEL, 1.0, grid=line(hunter(1.0)))
