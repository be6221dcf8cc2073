"""Line load and its largest value against closed forms and a graded mesh."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.independent import love
from viscontact.reference import hertz_elliptical

pytestmark = pytest.mark.filterwarnings("ignore:the contact reaches the end")

SHEAR_MODULUS, POISSON_RATIO = 1e9, 0.3
MATERIAL = vc.Material(vc.Elastic(SHEAR_MODULUS), POISSON_RATIO)
#: Mean of a parabola over the middle twentieth of its length, over its maximum.
PARABOLA = 1 - (1 / 20) ** 2 / 3
CONTACT_MODULUS = 2 * SHEAR_MODULUS / (1 - POISSON_RATIO)


def pressed(indenter, load, grid, **options):
    return vc.simulate(indenter, MATERIAL, load, grid, [0.0], **options)


def hertzian(grid, centre=(0.0, 0.0), **options):
    """An ellipse long along x, off the centre of the grid, and Hertz's solution."""
    indenter, force = vc.Paraboloid(0.08, 0.01), 50.0
    load = vc.step(force, eccentricity_x=centre[0], eccentricity_y=centre[1])
    exact = hertz_elliptical(force, 0.08, 0.01, CONTACT_MODULUS)
    return pressed(indenter, load, grid, **options), exact


def test_line_load_of_an_ellipse_is_hertz_across_and_away_from_the_centre():
    """q = 3 F/(4 a) (1 - (x - e)²/a²): p0 sqrt(1 - ..) integrated over y (Johnson, eq. 3.58)."""
    e_x, e_y = 0.2e-3, -0.05e-3
    ds, exact = hertzian(vc.Grid((90, 64), (4.2e-3, 1.3e-3)), (e_x, e_y), errors=False)
    a = exact.semi_axis_x
    expected = 0.75 * 50.0 / a * np.maximum(1 - ((ds.x - e_x) / a) ** 2, 0.0)
    peak = 0.75 * 50.0 / a * PARABOLA
    assert abs(ds.line_load.isel(time=0) - expected).max() < 0.01 * peak
    # The force and its moment are those of the line load.
    dx = float(ds.x[1] - ds.x[0])
    assert float(ds.line_load.sum() * dx) == close_to(50.0, rel=1e-6)
    assert float((ds.line_load * ds.x).sum() * dx) == close_to(50.0 * e_x, rel=1e-4)
    assert float(ds.peak_line_load[0]) == close_to(peak, rel=1e-3)


@pytest.mark.parametrize(("shape", "centre"), [((48, 40), (0.0, 0.0)), ((61, 33), (9e-6, 7e-6))])
def test_error_bar_of_the_peak_line_load_of_an_ellipse_contains_hertz(shape, centre):
    ds, exact = hertzian(vc.Grid(shape, (4.2e-3, 1.3e-3)), centre)
    error = abs(float(ds.peak_line_load[0]) - 0.75 * 50.0 / exact.semi_axis_x * PARABOLA)
    bar = float(ds.peak_line_load_error[0])
    assert error < bar < 0.02 * float(ds.peak_line_load[0])


def test_line_load_of_a_round_punch_is_the_same_all_over_it():
    """p = F/(2 pi a sqrt(a² - r²)) has the line load F/(2 a) at every x (Johnson, eq. 3.34)."""
    radius, force = 1e-3, 20.0
    ds = pressed(vc.FlatPunch(radius), vc.step(force), vc.Grid((96, 80), (2.4e-3, 2.2e-3)))
    expected = force / (2 * radius)
    inside = ds.line_load.isel(time=0).where(abs(ds.x) < 0.8 * radius, drop=True)
    assert float(inside.mean()) == close_to(expected, rel=0.01)
    # The cells follow its edge in steps.
    np.testing.assert_allclose(inside, expected, rtol=0.12)
    error = abs(float(ds.peak_line_load[0]) - expected)
    assert error < float(ds.peak_line_load_error[0]) < 0.3 * expected


LENGTH, WIDTH = 4e-3, 1.4e-3


def graded_end_load(cells):
    """Mean line load over the outer twentieth of a rectangular punch under unit force [1/m].

    Its pressure is constant on cells that become smaller towards the edges as cosines do, where it
    is singular, and displaces their centres by the same distance.
    """
    edges = [
        -extent / 2 * np.cos(np.pi * np.arange(count + 1) / count)
        for extent, count in zip((LENGTH, WIDTH), cells, strict=True)
    ]
    x, y = (
        each.ravel()
        for each in np.meshgrid(*((each[1:] + each[:-1]) / 2 for each in edges), indexing="ij")
    )
    dx, dy = (each.ravel() for each in np.meshgrid(*map(np.diff, edges), indexing="ij"))
    pressure = np.linalg.solve(love(x[:, None] - x, y[:, None] - y, dx, dy), np.ones(x.size))
    loads = (pressure * dx * dy).reshape(cells).sum(axis=1)
    before = np.append(0.0, np.cumsum(loads)) / loads.sum()
    angle = np.arccos(1 - 2 / 20)
    return np.interp(angle, np.arccos(-2 * edges[0] / LENGTH), before) / (LENGTH / 20)


def test_peak_line_load_has_a_limit_at_sharp_ends_where_the_pressure_has_none():
    """Its error falls with the cells to the value on a graded mesh; the pressure grows on."""
    expected = graded_end_load((24, 16))
    assert expected == close_to(graded_end_load((18, 12)), rel=1e-3)  # is resolved
    punch = vc.FlatPunch(half_length=LENGTH / 2, half_width=WIDTH / 2)
    # The edges of the punch lie between cells.
    grids = [vc.Grid((46 * k, 18 * k), (4.6e-3, 1.8e-3)) for k in (1, 2, 4)]
    runs = [pressed(punch, vc.step(1.0), grid) for grid in grids]
    peaks = np.array([float(ds.peak_line_load[0]) for ds in runs])
    errors = np.abs(peaks - expected)
    orders = np.log2(errors[:-1] / errors[1:])
    assert (orders > 0.8).all()
    assert errors[-1] < 0.015 * expected
    bars = np.array([float(ds.peak_line_load_error[0]) for ds in runs])
    assert (errors < bars).all()
    assert (bars < 0.25 * expected).all()
    # 0.41 at the inverse square root of the distance.
    pressures = np.array([float(ds.peak_pressure[0]) for ds in runs])
    assert (pressures[1:] > 1.35 * pressures[:-1]).all()
    largest = np.array([float(ds.line_load.max()) for ds in runs])
    assert (largest[1:] > 1.3 * largest[:-1]).all()
    assert all(np.isinf(ds.peak_pressure_error[0]) for ds in runs)
