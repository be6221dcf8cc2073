"""Punches and cones: how the largest pressure grows with finer cells, and that nothing else does.

Truth: the pressure falls with the square root of the distance from a straight or round edge
(Johnson 1985, eqs. 2.64 and 3.34), with its power 0.7034 from the corner of a square (Morrison &
Lewis 1976, SIAM J. Appl. Math. 31, 233-250), with its logarithm from a cone's tip (Love 1939).
Approach: Sneddon (1965) for the round punch; the square one is a charged plate, and
F = pi E* C approach with its capacitance C in units of 4 pi epsilon_0, 0.36679 times its side
(Read 1997, J. Comput. Phys. 133, 1-5).
"""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.pressing import FORCE, MODULUS, grid_around, order, press
from viscontact import reference

SIDE, HALF_ANGLE = 0.01, math.radians(87)
ASIDE = 0.1 * SIDE
CORNER_POWER = 0.7034
CAPACITANCE = 0.36679
ENDS = "end of the indenter's profile"

SQUARE = vc.FlatPunch(half_length=SIDE / 2, half_width=SIDE / 2)
MESHES = np.array([16, 32, 64, 128])  # cells on a side


def on_square(cells, **load):
    """The square punch, whose edges are those of cells."""
    n = int(cells) + 4
    with pytest.warns(vc.AccuracyWarning, match=ENDS):
        return press(SQUARE, vc.Grid((n, n), (n * SIDE / cells,) * 2), tolerance=1e-9, **load)


@pytest.fixture(scope="module")
def squares():
    return [on_square(cells) for cells in MESHES]


def tended_to(peaks):
    """Where the exponents tend to with which a peak grows, whenever cells are halved.

    What is left of the regular part beside the singular one is of first order.
    """
    coarse, fine = np.diff(np.log2(peaks))[-2:]
    return 2 * fine - coarse


def test_pressure_at_the_edge_of_a_square_punch_grows_with_the_square_root(squares):
    """In the middle of an edge; local exponents 0.468, 0.484, 0.492 tend to 0.4999."""
    peaks = [state.pressure[2, state.pressure.shape[1] // 2] for state in squares]
    assert tended_to(peaks) == close_to(0.5, abs=0.002)


def test_pressure_at_the_corner_of_a_square_punch_grows_with_its_power(squares):
    """Local exponents 0.680, 0.692, 0.698 tend to 0.7035."""
    peaks = [state.peak_pressure for state in squares]
    assert tended_to(peaks) == close_to(CORNER_POWER, abs=0.002)


def test_approach_of_a_square_punch_is_that_of_a_charged_plate(squares):
    """Of first order; extrapolated twice, it is as good as the capacitance is known.

    Measured: 2.1 % at 16 cells on a side, 0.27 % at 128, order 0.98; extrapolated, 6e-6.
    """
    found = np.array([FORCE / (math.pi * MODULUS * SIDE * state.approach) for state in squares])
    assert order(1 / MESHES, CAPACITANCE - found) == close_to(1.0, abs=0.05)
    once = 2 * found[1:] - found[:-1]
    coarse, fine = np.diff(once)
    assert once[-1] + fine**2 / (coarse - fine) == close_to(CAPACITANCE, rel=3e-5)


def test_resultants_of_an_eccentric_square_punch_converge():
    """Changes of approach and tilt are halved with the cells (measured: by 1.97 to 2.04).

    From 64 to 128 cells a side they are 0.26 and 0.8 %, where the peak grows by 62 %; the area is
    the punch's, known exactly but for its traced corners (3e-5).
    """
    states = [on_square(cells, eccentricity_x=ASIDE) for cells in MESHES]
    for name in ("approach", "tilt_x"):
        change = np.diff([getattr(state, name) for state in states])
        assert change[:-1] / change[1:] == close_to(2.0, abs=0.1)
        assert abs(change[-1]) < 0.01 * getattr(states[-1], name)
    assert states[-1].peak_pressure > 1.6 * states[-2].peak_pressure
    assert states[-1].contact_area == close_to(SIDE**2, rel=1e-4)


def test_pressure_at_the_edge_of_a_round_punch_grows_with_the_square_root():
    """Its edge is a staircase of cells: means of six meshes of like size. Measured: 0.491."""
    rng = np.random.default_rng(1)
    cells = np.array([8, 16, 32, 64])
    peaks = [np.mean([round_peak(n * rng.uniform(0.95, 1.05)) for _ in range(6)]) for n in cells]
    assert order(cells, peaks) == close_to(0.5, abs=0.03)


def round_peak(cells):
    radius = SIDE / 2
    grid = grid_around((radius,) * 2, (cells,) * 2, margin=1.1)
    with pytest.warns(vc.AccuracyWarning, match=ENDS):
        return press(vc.FlatPunch(radius), grid).peak_pressure


@pytest.mark.parametrize("odd", [False, True], ids=["tip between cells", "tip in a cell"])
def test_pressure_at_a_cones_tip_grows_with_the_logarithm(odd):
    """By the mean pressure whenever the cells are divided by e.

    Measured from 24 to 48 cells on the radius: 2.1e-4 and 2.4e-5 more.
    """
    exact = reference.cone(FORCE, HALF_ANGLE, MODULUS)
    cells, a = np.array([24.3, 48.3]), exact.contact_radius
    grids = [grid_around((a, a), (n, n), odd=odd) for n in cells]
    with pytest.warns(vc.AccuracyWarning, match="at a tip"):
        first, second = (press(vc.Cone(HALF_ANGLE), grid).peak_pressure for grid in grids)
    growth = (second - first) / math.log(cells[1] / cells[0])
    assert growth == close_to(exact.mean_pressure, rel=5e-4)
