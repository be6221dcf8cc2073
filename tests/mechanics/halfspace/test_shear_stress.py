"""Stresses inside the half-space under a traction on its surface, against closed forms.

Johnson: K. L. Johnson, Contact Mechanics, Cambridge (1985).
"""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.shear_stress_influence import shear_stress_coefficients
from viscontact.mechanics.halfspace.stress import stress_on_plane, stress_on_section
from viscontact.mechanics.halfspace.stress_response import HalfSpaceShearStress

XX, YY, ZZ, YZ, XZ, XY = range(6)
NU = 0.3


def of_rectangle(x: float, y: float, z: float) -> np.ndarray:
    """Stresses at a point under a unit traction along x on a rectangle of 1 by 0.8."""
    edges = np.array([x + 0.5, x - 0.5]), np.array([y + 0.4, y - 0.4])
    return shear_stress_coefficients(*edges, z, NU)[:, 0, 0]


def slopes(place: np.ndarray, step: float = 1e-4) -> np.ndarray:
    """Differences of the stresses along x, y and z; (3, 6)."""
    ways = step * np.eye(3)
    pairs = [(of_rectangle(*(place + way)), of_rectangle(*(place - way))) for way in ways]
    return np.array([(after - before) / (2 * step) for after, before in pairs])


PLACES = [(0.1, 0.2, 0.3), (-0.7, 0.35, 0.5), (1.3, -0.9, 0.2), (0.5, 0.4, 0.4)]


@pytest.mark.parametrize("place", PLACES)
def test_stresses_of_a_rectangle_are_in_equilibrium(place: tuple[float, float, float]) -> None:
    """Divergence of the stress tensor."""
    along_x, along_y, along_z = slopes(np.array(place))
    assert along_x[XX] + along_y[XY] + along_z[XZ] == close_to(0.0, abs=2e-7)
    assert along_x[XY] + along_y[YY] + along_z[YZ] == close_to(0.0, abs=2e-7)
    assert along_x[XZ] + along_y[YZ] + along_z[ZZ] == close_to(0.0, abs=2e-7)


@pytest.mark.parametrize("place", PLACES)
def test_stresses_of_a_rectangle_are_compatible(place: tuple[float, float, float]) -> None:
    """Beltrami and Michell: (1 + ν) ∇²σ_ij + (tr σ)_,ij = 0."""
    step, middle = 1e-3, np.array(place)
    ways = step * np.eye(3)
    around = [of_rectangle(*(middle + sign * way)) for way in ways for sign in (1, -1)]
    laplacian = (sum(around) - 6 * of_rectangle(*middle)) / step**2

    def trace(*way: int) -> float:
        return float(of_rectangle(*(middle + step * np.array(way)))[:3].sum())

    along = (trace(1, 0, 0) + trace(-1, 0, 0) - 2 * trace(0, 0, 0)) / step**2
    mixed = trace(1, 1, 0) - trace(1, -1, 0) - trace(-1, 1, 0) + trace(-1, -1, 0)
    assert (1 + NU) * laplacian[XX] + along == close_to(0.0, abs=2e-3)
    assert (1 + NU) * laplacian[XY] + mixed / (4 * step**2) == close_to(0.0, abs=2e-3)


def test_surface_bears_the_traction_inside_the_rectangle_and_nothing_outside() -> None:
    inside, outside = of_rectangle(0.2, -0.1, 1e-9), of_rectangle(0.8, 0.1, 1e-9)
    assert inside[[ZZ, YZ, XZ]] == close_to(np.array([0.0, 0.0, -1.0]), abs=1e-8)
    assert outside[[ZZ, YZ, XZ]] == close_to(np.zeros(3), abs=1e-8)


def test_far_away_a_rectangle_acts_as_a_force() -> None:
    """Johnson, eqs. 3.76 (Cerruti): σzz = -(3 Q/2π) x z²/r⁵ and σxz = -(3 Q/2π) x² z/r⁵."""
    x, y, z = 30.0, 20.0, 25.0
    found, r = of_rectangle(x, y, z), np.sqrt(x**2 + y**2 + z**2)
    factor = -3 * 0.8 / (2 * np.pi * r**5)
    expected = factor * x * np.array([z * z, y * z, x * z])
    assert found[[ZZ, YZ, XZ]] == close_to(expected, rel=1e-3)


def random_loads(shape: tuple[int, int]) -> np.ndarray:
    return np.random.default_rng(11).uniform(-1, 1, (2, *shape))


def without_shortest_waves(load: np.ndarray) -> np.ndarray:
    """Load without the waves of two cells, whose slope the cells do not show."""
    spectrum = np.fft.fft2(load)
    spectrum[load.shape[0] // 2] = spectrum[:, load.shape[1] // 2] = 0
    return np.fft.ifft2(spectrum).real


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("line", [3.0, 3.5, 3.2])
def test_section_is_the_direct_sum_over_cells(axis: int, line: float) -> None:
    """Through a line of cells, an edge and neither, where the lines are symmetric and where not."""
    grid, body = Grid((9, 8), (1.8, 2.0), centre=(0.3, -0.1)), HalfSpaceShearStress(NU, axis)
    loads, half = random_loads(grid.shape), np.array([0.5, -0.5])
    y = float(grid.y[0] + line * grid.cell_size[1])
    found = stress_on_section(loads, grid, [0.02, 0.7], body, y=y).components
    for row, depth in enumerate((0.02, 0.7)):
        exact = np.zeros((6, 2, 9))
        for place, x in enumerate(grid.x):
            for i, j in np.ndindex(grid.shape):
                ways = (x - grid.x[i], y - grid.y[j])
                edges = (w + half * d for w, d in zip(ways, grid.cell_size, strict=True))
                own = body.coefficients(*edges, depth)[:, 0, 0]
                exact[:, :, place] += own[:, None] * loads[:, i, j]
        assert found[:, :, row] == close_to(exact, abs=1e-13)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("periodic", [(False, False), (True, False), (False, True), (True, True)])
def test_sections_along_both_axes_and_planes_agree(axis: int, periodic: tuple[bool, bool]) -> None:
    """The same points by three routes, on all kinds of grids."""
    grid, body = Grid((8, 6), (2.0, 1.8), periodic), HalfSpaceShearStress(NU, axis)
    load, depth = without_shortest_waves(random_loads(grid.shape)[0]), 0.4
    plane = stress_on_plane(load, grid, depth, body).components
    along_x = stress_on_section(load, grid, [depth], body, y=grid.y[2]).components
    along_y = stress_on_section(load, grid, [depth], body, x=grid.x[5]).components
    assert along_x[:, 0] == close_to(plane[:, :, 2], abs=1e-6)
    assert along_y[:, 0] == close_to(plane[:, 5], abs=1e-6)


@pytest.mark.parametrize("axis", [0, 1])
def test_period_along_one_axis_is_a_row_of_images(axis: int) -> None:
    """Without a resultant, what images beyond a distance add falls with its square at least."""
    body, errors = HalfSpaceShearStress(NU, axis), []
    load = random_loads((4, 6))[0]
    load -= load.mean()
    one = stress_on_section(load, Grid((4, 6), (1.0, 1.5), (True, False)), [0.3], body, y=0.1)
    for count in (20, 40):
        rows = Grid((4 * (2 * count + 1), 6), (2 * count + 1.0, 1.5))
        many = stress_on_section(np.tile(load, (2 * count + 1, 1)), rows, [0.3], body, y=0.1)
        middle = slice(4 * count, 4 * count + 4)
        errors.append(np.abs(many.components[:, :, middle] - one.components).max())
    assert errors[1] < errors[0] / 3.5
    assert errors[1] < 5e-5


@pytest.mark.parametrize("axis", [0, 1])
def test_periods_along_both_axes_are_images_of_one_along_y(axis: int) -> None:
    """Lines without a resultant decay exponentially along x; cells against waves: second order."""
    body, errors = HalfSpaceShearStress(NU, axis), []
    for n in (12, 24):
        both, rows = (
            Grid((n, n), (1.5, 1.0), (True, True)),
            Grid((9 * n, n), (13.5, 1.0), (False, True)),
        )
        phases = 2 * np.pi * (both.x[:, None] / 1.5 + both.y[None, :])
        load = np.cos(phases + 0.4) + 0.5 * np.sin(2 * phases - 0.3)
        own = stress_on_section(load, both, [0.2], body, y=both.y[n // 3]).components
        many = stress_on_section(np.tile(load, (9, 1)), rows, [0.2], body, y=both.y[n // 3])
        errors.append(np.abs(many.components[:, :, 4 * n : 5 * n] - own).max())
    assert errors[1] < errors[0] / 3.5
    assert errors[1] < 0.01


def test_wave_of_traction_has_the_stresses_of_its_line_loads() -> None:
    """Johnson, eq. 2.15: σxx = -(2/π) x³/r⁴ of a unit line load along x, and likewise.

    Over the loads cos(q x) these give σxx = -(2 - q z) sin(q x) exp(-q z), and for the others
    -q z sin(q x) exp(-q z) (zz) and -(1 - q z) cos(q x) exp(-q z) (xz); along y, with
    σxy = -x/(π r²), -sin(q x) exp(-q z) (xy) and -cos(q x) exp(-q z) (yz).
    """
    grid, z = Grid((32, 4), (2.0, 1.0), (True, True)), 0.3
    q = 2 * np.pi / 2.0
    sine, cosine, decay = np.sin(q * grid.x), np.cos(q * grid.x), np.exp(-q * z)
    load = np.repeat(cosine[:, None], 4, axis=1)
    in_plane = stress_on_section(load, grid, [z], HalfSpaceShearStress(NU, 0)).components[:, 0]
    zero = np.zeros(32)
    xx, zz = -(2 - q * z) * sine * decay, -q * z * sine * decay
    xz = -(1 - q * z) * cosine * decay
    expected = np.array([xx, NU * (xx + zz), zz, zero, xz, zero])
    assert in_plane == close_to(expected, abs=1e-12)
    antiplane = stress_on_section(load, grid, [z], HalfSpaceShearStress(NU, 1)).components[:, 0]
    expected = np.array([zero, zero, zero, -cosine * decay, zero, -sine * decay])
    assert antiplane == close_to(expected, abs=1e-12)


@pytest.mark.parametrize("cells", [40, 80])
def test_sliding_cylinder_stretches_the_surface_behind_it(cells: int) -> None:
    """McEwen, Phil. Mag. 40 (1949) 454: σxx = -2 q_0 x/a at the surface under q_0 √(1 - x²/a²)."""
    grid = Grid((2 * cells, 1), (2.0, 1.0), (False, True))
    x = grid.x
    load = np.sqrt(np.maximum(0, 1 - x**2))[:, None]
    found = stress_on_section(load, grid, [0.0], HalfSpaceShearStress(0.3, 0), y=0.0)
    inside = np.abs(x) < 0.8
    assert found["xx"][0, inside] == close_to(-2 * x[inside], abs=2 / cells)
