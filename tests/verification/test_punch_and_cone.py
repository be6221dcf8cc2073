"""Elastic contacts with a singular pressure: the flat-ended punch and the cone."""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.pressing import FORCE, MODULUS, grid_around, order, press
from viscontact import reference

PUNCH_RADIUS = 0.005
ECCENTRICITY = (0.15 * PUNCH_RADIUS, -0.2 * PUNCH_RADIUS)  # both axes; within a third together

HALF_ANGLE = math.radians(87)
CONE = reference.cone(FORCE, HALF_ANGLE, MODULUS)


def punch_errors(cells, *, odd):
    """Relative errors of approach and both tilts of the eccentric punch."""
    grid = grid_around((PUNCH_RADIUS,) * 2, (cells, cells), margin=1.1, odd=odd)
    # Pressure is infinite at the edge, and the run says that its peak means nothing.
    with pytest.warns(vc.AccuracyWarning, match="end of the indenter's profile"):
        state = press(
            vc.FlatPunch(PUNCH_RADIUS),
            grid,
            eccentricity_x=ECCENTRICITY[0],
            eccentricity_y=ECCENTRICITY[1],
        )
    along_x, along_y = (
        reference.flat_punch(FORCE, PUNCH_RADIUS, MODULUS, eccentricity)
        for eccentricity in ECCENTRICITY
    )
    found = np.array([state.approach, state.tilt_x, state.tilt_y])
    return found / np.array([along_x.approach, along_x.tilt_x, along_y.tilt_x]) - 1


@pytest.mark.parametrize("odd", [False, True])
def test_eccentric_punch_at_128_cells_a_radius(odd):
    """Sneddon (1965) for the approach, F/(2 a E*); tilt 3 F e/(4 a³ E*) about either axis.

    The punch's edge is a staircase of cells, whose area alone jitters by some 0.1 %, and the
    tilt goes with a³. Measured: approach 0.09 and 0.13 %, tilts 0.28 and 0.38 %.
    """
    assert np.abs(punch_errors(128, odd=odd)).max() < 4e-3


@pytest.mark.slow
def test_errors_of_the_punch_fall_with_the_cell_size():
    """Sneddon (1965); six meshes, each the mean of eight drawn about it: the staircase jitters.

    Measured: order 1.00 in the approach and 1.01 in the tilts.
    """
    rng = np.random.default_rng(0)
    cells = np.array([8, 14, 24, 42, 73, 128])
    errors = np.array([_mean_errors(n, rng) for n in cells])
    for kind in errors.T:
        assert order(1 / cells, kind) == close_to(1.0, abs=0.2)


def _mean_errors(cells, rng):
    drawn = [
        punch_errors(cells * rng.uniform(0.95, 1.05), odd=bool(rng.integers(2))) for _ in range(8)
    ]
    return np.abs(drawn).mean(axis=0)


def test_area_under_a_punch_is_that_of_the_punch():
    """The rim is the body's outline, known exactly. Measured at 24 cells a radius: 2.7e-4."""
    grid = grid_around((PUNCH_RADIUS,) * 2, (23.7, 23.7), margin=1.1)
    with pytest.warns(vc.AccuracyWarning, match="end of the indenter's profile"):
        state = press(vc.FlatPunch(PUNCH_RADIUS), grid)
    assert state.contact_area == close_to(math.pi * PUNCH_RADIUS**2, rel=1e-3)
    assert state.contact_length == close_to(2 * PUNCH_RADIUS, rel=1e-3)


def test_pressure_under_the_eccentric_punch_leans_as_in_closed_form():
    """Johnson (1985), eq. 3.34, with the leaning factor 1 + 3 (e·r)/a² of a tilted punch.

    Inside 0.6 a the pressure is smooth and its error is that of the staircase's radius, the
    same first order as above. Measured at 128 cells a radius: 0.22 % of the mean pressure.
    """
    a = PUNCH_RADIUS
    grid = grid_around((a, a), (127.6, 127.6), margin=1.1)
    with pytest.warns(vc.AccuracyWarning, match="end of the indenter's profile"):
        state = press(
            vc.FlatPunch(a), grid, eccentricity_x=ECCENTRICITY[0], eccentricity_y=ECCENTRICITY[1]
        )
    x, y = grid.x[:, None], grid.y[None, :]
    lean = 1 + 3 * (ECCENTRICITY[0] * x + ECCENTRICITY[1] * y) / a**2
    inside = x**2 + y**2 < (0.6 * a) ** 2
    height = np.sqrt(np.where(inside, a**2 - x**2 - y**2, a**2))
    expected = FORCE / (2 * math.pi * a) * lean / height
    error = np.abs(state.pressure - expected)[inside].max()
    assert error < 5e-3 * FORCE / (math.pi * a**2)


@pytest.mark.filterwarnings("ignore:the largest pressure lies at a tip:viscontact.AccuracyWarning")
@pytest.mark.parametrize("odd", [False, True], ids=["tip between cells", "tip in a cell"])
def test_cone_follows_sneddon(odd):
    """Love (1939), Sneddon (1965): radius, approach, mean pressure, pressure off the tip.

    Measured at 50 cells a radius: approach 9.7e-6, length 1.5e-3, mean pressure and area 9.3e-4,
    pressure between 0.2 a and 0.9 a 1.3e-4 of the mean (it is infinite at the tip).
    """
    a = CONE.contact_radius
    grid = grid_around((a, a), (50.3, 50.3), odd=odd)
    state = press(vc.Cone(HALF_ANGLE), grid)
    r = np.hypot(grid.x[:, None], grid.y[None, :])
    smooth = (r > 0.2 * a) & (r < 0.9 * a)
    error = np.abs(state.pressure - CONE.pressure(r))[smooth].max()
    assert state.approach == close_to(CONE.approach, rel=5e-5)
    assert state.contact_length / 2 == close_to(a, rel=4e-3)
    assert state.contact_area == close_to(math.pi * a**2, rel=2e-3)
    assert state.mean_pressure == close_to(CONE.mean_pressure, rel=2e-3)
    assert error < 4e-4 * CONE.mean_pressure


@pytest.mark.filterwarnings("ignore:the largest pressure lies at a tip:viscontact.AccuracyWarning")
def test_error_of_the_cone_s_approach_falls_with_the_square_of_the_cell_size():
    """Sneddon (1965); odd and even meshes averaged. Measured: 1.98."""
    a, cells = CONE.contact_radius, np.array([12.3, 17.7, 25.3, 36.1, 50.3])
    errors = [np.mean([_cone_error(n, a, odd=odd) for odd in (False, True)]) for n in cells]
    assert order(1 / cells, errors) == close_to(2.0, abs=0.25)


def _cone_error(cells, a, *, odd):
    grid = grid_around((a, a), (cells, cells), odd=odd)
    return abs(press(vc.Cone(HALF_ANGLE), grid, tolerance=1e-8).approach / CONE.approach - 1)
