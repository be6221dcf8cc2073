"""Error bars of area and extents where all grids agree on them better than they are known."""

import math

import numpy as np
import pytest

import viscontact as vc
from verification.creeping_bodies import BODIES
from verification.pressing import ELASTIC, FORCE, MODULUS, RADIUS, grid_around
from viscontact import reference

SCALARS = ("contact_area", "contact_length", "contact_width")


def bars_over_errors(radius_ratio: float) -> np.ndarray:
    """Bars over true errors of area, length and width, on eight grids; shape (8, 3)."""
    exact = reference.hertz_elliptical(FORCE, radius_ratio * RADIUS, RADIUS, MODULUS)
    axes = np.array([exact.semi_axis_x, exact.semi_axis_y])
    truth = np.array([math.pi * axes[0] * axes[1], *(2 * axes)])
    rng = np.random.default_rng(3)
    found = []
    for cells in (6, 8, 10, 12, 14, 17, 20, 24):
        grid = grid_around(axes, (cells, cells), odd=bool(rng.integers(2)))
        aside = rng.uniform(-0.5, 0.5, 2) * grid.cell_size
        body = vc.Paraboloid(radius_ratio * RADIUS, RADIUS).shifted(*aside)
        load = vc.step(FORCE, tilt_x=0.0, tilt_y=0.0)
        ds = vc.simulate(body, ELASTIC, load, grid, [0.0], tolerance=1e-7)
        values = np.array([float(ds[name][0]) for name in SCALARS])
        bars = np.array([float(ds[f"{name}_error"][0]) for name in SCALARS])
        found.append(bars / np.abs(values - truth))
    return np.array(found)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # few cells, on purpose
@pytest.mark.parametrize(
    "radius_ratio", [*(pytest.param(each, marks=pytest.mark.slow) for each in (10.0, 100.0)), 1e3]
)
def test_bars_of_the_length_hold(radius_ratio: float) -> None:
    """Hertz's ellipses (1882) of 4.5, 18 and 68 to 1 on cells as slender as they are.

    They are too short by up to 0.4 cells on 12 to 48 cells, as the rim is curved within a cell.
    """
    ratios = bars_over_errors(radius_ratio)
    assert (ratios > 1 / 3).all()
    assert np.mean(ratios[:, 1] >= 1) >= 0.8
    assert np.median(ratios[:, 1]) < 5


@pytest.mark.parametrize(
    "name",
    ["zener", *(pytest.param(name, marks=pytest.mark.slow) for name in ("maxwell", "burgers"))],
)
def test_bars_of_the_area_hold_where_a_contact_begins_to_shrink(name: str) -> None:
    """Graham (1965), a haversine of force: within two cells of its largest extent.

    There the surface that the contact has left is almost closed; the area is up to 4 % too large.
    """
    times, half_width = vc.uniform_times(120.0, 80), 12
    force = FORCE * np.sin(np.pi * times / 120) ** 2
    force[-1] = 0.0
    exact = reference.press_axisymmetric(
        reference.SphereProfile(RADIUS),
        times,
        force=force,
        creep_compliance=BODIES[name].creep,
        elements=200,
        substeps=2,
    )
    cell = exact.contact_radius.max() / half_width
    aside = np.random.default_rng(1).uniform(-0.5, 0.5, 2) * cell
    grid = vc.Grid((32, 32), (32 * cell, 32 * cell))
    body, load = vc.Paraboloid(RADIUS, RADIUS).shifted(*aside), vc.ForceHistory(times, force)
    ds = vc.simulate(body, BODIES[name].material, load, grid, times)
    radius = exact.contact_radius
    late = (times > 60) & (radius > radius.max() - 2 * cell)
    errors = np.abs(ds.contact_area.values - np.pi * radius**2)[late]
    ratios = ds.contact_area_error.values[late] / errors
    assert ratios.min() > 1 / 3
    assert np.mean(ratios >= 1) >= 0.9
    # Errors change sign here, and bars cannot know where: 2.8 to 6.1 by the laws.
    assert np.median(ratios) < 7
