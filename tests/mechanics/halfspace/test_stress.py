"""Stresses inside the half-space, against closed forms and the laws of equilibrium.

Johnson: K. L. Johnson, Contact Mechanics, Cambridge (1985).
"""

from __future__ import annotations

import numpy as np
import pytest
import scipy
from scipy import integrate

from closeness import close_to
from returned import some
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace import stress
from viscontact.mechanics.halfspace.stress import Stress, stress_on_section
from viscontact.mechanics.halfspace.stress_influence import stress_coefficients


def ball_pressure(grid: Grid) -> np.ndarray:
    """Hertz's pressure over a circle of radius 1, with peak 1."""
    return np.sqrt(np.maximum(0, 1 - grid.x[:, None] ** 2 - grid.y[None, :] ** 2))


def direct_sum(pressure: np.ndarray, grid: Grid, depth: float, y: float) -> np.ndarray:
    """Stresses on a section by Love's closed form, cell by cell."""
    (dx, dy), half = grid.cell_size, np.array([0.5, -0.5])
    found = np.zeros((6, grid.shape[0]))
    for place, x in enumerate(grid.x):
        for i, j in zip(*np.nonzero(pressure), strict=True):
            edges = x - grid.x[i] + half * dx, y - grid.y[j] + half * dy
            found[:, place] += pressure[i, j] * stress_coefficients(*edges, depth, 0.3)[:, 0, 0]
    return found


@pytest.mark.parametrize("line", [3.0, 3.5, 3.2, 0.0, 12.0, -1.0])
@pytest.mark.parametrize(
    "loaded", [(slice(None),) * 2, (slice(2, 5), slice(1, 6)), (slice(0),) * 2]
)
def test_section_is_the_direct_sum_over_cells(line: float, loaded: tuple[slice, slice]) -> None:
    """Through a line of cells, an edge and neither, where the lines are symmetric and where not."""
    grid = Grid((9, 8), (1.8, 2.0), centre=(0.3, -0.1))
    pressure = np.zeros((2, *grid.shape))
    pressure[(slice(None), *loaded)] = np.random.default_rng(7).uniform(
        0.5, 1, (2, *pressure[(0, *loaded)].shape)
    )
    y = float(grid.y[0] + line * grid.cell_size[1])
    found = stress_on_section(pressure, grid, [0.02, 0.7], 0.3, y=y).components
    for place, field in some(enumerate(pressure)):
        for row, depth in enumerate((0.02, 0.7)):
            exact = direct_sum(field, grid, depth, y)
            assert found[:, place, row] == close_to(exact, abs=1e-14)


def test_lines_on_either_side_of_a_section_are_added_before_they_are_transformed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At each depth, one transform of each of four pairs of components for half of the lines."""
    lengths = []
    original = scipy.fft.rfft

    def counted(field: np.ndarray, *given: object, **named: object) -> np.ndarray:
        lengths.append(field[0].size if named.get("axis") == 0 else 0)
        return original(field, *given, **named)

    monkeypatch.setattr(scipy.fft, "rfft", counted)
    grid = Grid((41, 41), (2.2, 2.2))
    loaded = int(ball_pressure(grid).any(axis=0).sum())
    ball(41, np.array([0.1, 0.2, 0.3]))
    assert sum(lengths) == 3 * 4 * (loaded + 1) // 2


def test_progress_of_a_section_counts_its_depths(monkeypatch: pytest.MonkeyPatch) -> None:
    grid = Grid((8, 8), (1.0, 1.0))
    fields = np.ones((3, 8, 8))
    said: list[tuple[int, int]] = []
    monkeypatch.setattr(stress, "TOGETHER", 2 * 64 * 64)  # bytes of two fields
    stress_on_section(fields, grid, [0.1, 0.2], 0.3, progress=lambda *each: said.append(each))
    assert said == [(1, 4), (2, 4), (3, 4), (4, 4)]


def ball(cells: int, depths: np.ndarray, poisson_ratio: float = 0.3) -> Stress:
    grid = Grid((cells, cells), (2.2, 2.2))
    return stress_on_section(ball_pressure(grid), grid, depths, poisson_ratio)


def on_axis(depths: np.ndarray, poisson_ratio: float) -> tuple[np.ndarray, np.ndarray]:
    """Radial and axial stress under a ball: Johnson, eqs. 3.45."""
    axial = -1 / (1 + depths**2)
    radial = -(1 + poisson_ratio) * (1 - depths * np.arctan(1 / depths)) - axial / 2
    return radial, axial


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.5])
def test_stress_on_the_axis_of_a_ball_is_johnsons_with_second_order(poisson_ratio: float) -> None:
    depths = np.linspace(0.2, 3, 15)
    radial, axial = on_axis(depths, poisson_ratio)
    errors = []
    for cells in (21, 41, 81):
        stress = ball(cells, depths, poisson_ratio)
        middle = cells // 2
        errors.append(
            max(
                np.abs(stress["zz"][:, middle] - axial).max(),
                np.abs(stress["xx"][:, middle] - radial).max(),
                np.abs(stress["yy"][:, middle] - radial).max(),
            )
        )
        assert np.abs(stress["xz"][:, middle]).max() < 1e-13
    assert errors[2] < 1e-3
    # 1.5 is what a square root at the rim leaves of 2 in the sum over cells.
    assert errors[0] / errors[2] > 4**1.4


def test_ball_yields_first_where_johnson_says() -> None:
    depths = np.linspace(0.4, 0.56, 81)
    stress = ball(129, depths)
    largest = np.unravel_index(stress.von_mises.argmax(), stress.von_mises.shape)
    # Johnson, section 4.5: 0.310 p0 of shear at 0.48 a, for nu = 0.3
    assert float(stress.von_mises[largest]) == close_to(0.620, rel=1e-3)
    assert depths[largest[0]] == close_to(0.481, abs=0.003)
    assert largest[1] == 64
    assert float(stress.max_shear[largest]) == close_to(0.310, rel=2e-3)


def test_surface_under_a_ball_is_johnsons() -> None:
    stress = ball(129, np.array([0.0]))
    x = Grid((129, 129), (2.2, 2.2)).x
    # eqs. 3.42, 3.43: the middle, and the largest tension of all at the edge
    assert stress["xx"][0, 64] == close_to(-0.8, rel=1e-3)
    beyond = np.abs(x) > 1.03
    assert stress["xx"][0][beyond] == close_to((1 - 0.6) / 3 / x[beyond] ** 2, rel=2e-3)
    assert stress["yy"][0][beyond] == close_to(-(1 - 0.6) / 3 / x[beyond] ** 2, rel=2e-3)
    assert stress["zz"][0][beyond] == close_to(0, abs=1e-12)


def test_stress_jumps_with_the_pressure_at_the_surface_only() -> None:
    # under an edge between a loaded and a free half-plane the stress is half way, Johnson sec. 2.5
    grid = Grid((41, 40), (41.0, 40.0))
    pressure = np.zeros(grid.shape)
    pressure[:, :20] = 1.0
    stress = stress_on_section(pressure, grid, [0.0, 1e-3], 0.3, y=0.0)
    assert stress["zz"][:, 20] == close_to(-0.5, abs=1e-3)
    assert np.isfinite(stress.components).all()


def test_long_roller_shears_most_where_johnson_says() -> None:
    # half width 1; plane strain in the middle is approached with one over the length
    grid = Grid((5, 64), (1e5, 2.2))
    edges = np.clip(np.linspace(-1.1, 1.1, 65), -1, 1)
    means = np.diff(edges * np.sqrt(1 - edges**2) + np.arcsin(edges)) / 2 / grid.cell_size[1]
    pressure = np.tile(means, (5, 1))
    depths = np.linspace(0.7, 0.9, 81)
    stress = stress_on_section(pressure, grid, depths, 0.3, x=0.0)
    in_plane = np.hypot((stress["yy"] - stress["zz"]) / 2, stress["yz"])
    largest = np.unravel_index(in_plane.argmax(), in_plane.shape)
    # Johnson, eq. 4.47: 0.300 p0 at 0.786 b
    assert float(in_plane[largest]) == close_to(0.300, rel=2e-3)
    assert depths[largest[0]] == close_to(0.786, abs=0.005)
    # plane strain: nothing is strained along the roller
    along = 0.3 * (stress["yy"] + stress["zz"])
    assert stress["xx"] == close_to(along, rel=1e-4)


def test_far_below_it_is_boussinesqs_point_load() -> None:
    grid = Grid((8, 6), (2.0, 1.5))
    pressure = np.random.default_rng(1).uniform(0, 1, grid.shape)
    force = pressure.sum() * grid.cell_area
    # the load's own middle
    x0 = (pressure * grid.x[:, None]).sum() / pressure.sum()
    for depth, tolerance in ((30.0, 6e-3), (300.0, 6e-5)):
        stress = stress_on_section(pressure, grid, [depth], 0.25, y=0.0)
        r = np.hypot(grid.x - x0, depth)
        exact = -3 * force * depth**3 / (2 * np.pi * r**5)  # Johnson, eq. 3.23
        assert stress["zz"][0] == close_to(exact, rel=tolerance)


def divergence(step: float) -> np.ndarray:
    """Divergence of the stress at a point, by central differences, over its largest term."""
    grid = Grid((12, 10), (2.0, 1.6))
    pressure = np.random.default_rng(2).uniform(0, 1, grid.shape)
    i, j, depth = 5, 6, 0.4
    x, y = float(grid.x[i]), float(grid.y[j])
    before, after = (
        (
            stress_on_section(pressure, grid, [depth], 0.3, x=x + way).components[:, 0, j],
            stress_on_section(pressure, grid, [depth], 0.3, y=y + way).components[:, 0, i],
            stress_on_section(pressure, grid, [depth + way], 0.3, y=y).components[:, 0, i],
        )
        for way in (-step, step)
    )
    dx, dy, dz = (Stress(far - near) for near, far in zip(before, after, strict=True))
    rows = [
        (dx["xx"], dy["xy"], dz["xz"]),
        (dx["xy"], dy["yy"], dz["yz"]),
        (dx["xz"], dy["yz"], dz["zz"]),
    ]
    return np.array([abs(sum(row)) / max(map(abs, row)) for row in rows])


def test_stresses_are_in_equilibrium() -> None:
    coarse, fine = divergence(0.02), divergence(0.005)
    assert fine.max() < 2e-3
    # what is left is the differences' own error, of second order
    assert (coarse / fine > 14).all()
    assert (coarse / fine < 18).all()


def test_the_load_goes_through_every_depth() -> None:
    grid = Grid((41, 41), (2.2, 2.2))
    pressure = ball_pressure(grid)
    force = pressure.sum() * grid.cell_area
    for depth in (0.3, 1.0, 2.5):
        # a circle of radius 1: axial stress over rings, to where a point load's tail is left
        wide = Grid((401, 41), (401 * grid.cell_size[0], 2.2))
        spread = np.zeros(wide.shape)
        spread[180:221] = pressure
        stress = stress_on_section(spread, wide, [depth], 0.3)["zz"][0, 200:]
        radii = wide.x[200:]
        within = -2 * np.pi * integrate.simpson(stress * radii, x=radii)
        tail = force * depth**3 / np.hypot(depth, radii[-1]) ** 3
        assert within + tail == close_to(force, rel=2e-3)


def test_turned_problem_gives_turned_stresses() -> None:
    grid = Grid((7, 9), (1.4, 2.7))
    pressure = np.random.default_rng(3).uniform(0, 1, grid.shape)
    one = stress_on_section(pressure, grid, [0.1, 0.9], 0.2, y=0.05)
    other = stress_on_section(pressure.T, Grid((9, 7), (2.7, 1.4)), [0.1, 0.9], 0.2, x=0.05)
    for name, turned in (("xx", "yy"), ("yy", "xx"), ("zz", "zz"), ("xz", "yz"), ("xy", "xy")):
        assert one[name] == close_to(other[turned], rel=1e-12, abs=1e-14)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"x": 0.0, "y": 0.0}, "give one of them"),
        ({"depths": [-1.0]}, "0 or positive"),
        ({"depths": [float("nan")]}, "0 or positive"),
        ({"body": 0.6}, "between 0 and 0.5"),
    ],
)
def test_what_makes_no_section_is_refused(wrong: dict[str, object], words: str) -> None:
    arguments: dict[str, object] = {"depths": [0.1], "body": 0.3, **wrong}
    with pytest.raises(ValueError, match=words):
        stress_on_section(np.ones((4, 4)), Grid((4, 4), (1.0, 1.0)), **arguments)
