"""Displacement and stresses under a given pressure: closed forms, superposition, refused input."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.runs.given_pressure.near_field import NearField
from viscontact.runs.given_pressure.resolved import Effort, resolved

RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
BODY = vc.Material(vc.Elastic.from_uniaxial(1e9, 0.3), poisson_ratio=0.3)
GRID = vc.Grid((6, 8), (3e-3, 2e-3))
MAP = np.arange(48.0).reshape(6, 8) * 1e3


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize("layered", [False, True])
def test_pressure_of_a_contact_gives_its_displacement(layered: bool, tmp_path: Path) -> None:
    steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
    body = vc.Layered([vc.Layer(1e-3, RUBBER)], base=steel) if layered else RUBBER
    grid, times = vc.Grid((16, 12), (2.4e-3, 2.2e-3)), [0.0, 0.3, 1.0, 2.0]
    run = vc.simulate(vc.Sphere(0.01), body, vc.ramp(0.05, 1.0), grid, times, errors=False)
    found = vc.under_pressure(run, body)
    np.testing.assert_allclose(found.displacement, run.displacement, rtol=1e-12, atol=1e-20)
    np.testing.assert_allclose(found.force, run.force, rtol=1e-9)
    inside, own = vc.section_stresses(found, [1e-4], y=0.0), vc.section_stresses(run, [1e-4], y=0.0)
    np.testing.assert_allclose(inside.von_mises, own.von_mises, rtol=1e-6)
    vc.save(run, tmp_path / "run.nc")
    stored = vc.under_pressure(tmp_path / "run.nc", body)  # in single precision
    np.testing.assert_allclose(stored.displacement, run.displacement, rtol=1e-5, atol=1e-15)


def test_held_pressure_creeps_as_the_law() -> None:
    times = [0.0, 0.4, 3.0]
    found = vc.under_pressure(MAP, RUBBER, GRID, times).displacement.values
    creep = np.asarray(RUBBER.law(np.array(times)))
    expected = (creep / creep[0])[:, None, None] * found[0]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_pressures_and_axes_add_and_change_places() -> None:
    other = MAP[::-1] ** 2
    parts = [vc.under_pressure(each, BODY, GRID).displacement.values for each in (MAP, other)]
    both = vc.under_pressure(MAP + other, BODY, GRID).displacement.values
    np.testing.assert_allclose(both, parts[0] + parts[1], rtol=1e-12)
    turned = vc.under_pressure(MAP.T, BODY, vc.Grid((8, 6), (2e-3, 3e-3))).displacement.values
    np.testing.assert_allclose(turned[0].T, parts[0][0], rtol=1e-12)


def test_linear_rise_is_exact_whatever_the_instants() -> None:
    fluid = vc.Material(vc.Maxwell(1e6, 1e6), poisson_ratio=0.5)
    rising = np.stack([0 * MAP, MAP])
    few = vc.under_pressure(rising, fluid, GRID, [0.0, 2.0])
    held = vc.under_pressure(MAP, fluid, GRID, [0.0]).displacement.values[0]
    # Phi = (1 + t)/(2 MPa), and the mean over 2 s is twice that at 0.
    np.testing.assert_allclose(few.displacement.values[1], 2 * held, rtol=1e-12)
    formula = vc.under_pressure(lambda x, y, t: t / 2 + 0 * (x + y), fluid, GRID, [0.3, 2.0])
    uniform = vc.under_pressure(np.ones(GRID.shape), fluid, GRID, [0.0]).displacement.values[0]
    np.testing.assert_allclose(formula.displacement.values[1], 2 * uniform, rtol=1e-12)
    np.testing.assert_allclose(formula.displacement.values[0], (0.15 + 0.3**2 / 4) * uniform)


@pytest.mark.parametrize("periodic", [False, True])
def test_moving_map_is_the_map_elsewhere(periodic: bool) -> None:
    grid = vc.Grid((4, 12), (4.0, 12.0), periodic=periodic)
    spot = np.zeros(grid.shape)
    spot[1, 2:4] = 1e5, 2e5
    motion = vc.Travel([0.0, 3.0], y=[0.0, 6.0])
    found = vc.under_pressure(spot, BODY, grid, [0.0, 0.25, 3.0], motion=motion)
    for index, cells in ((0, 0), (2, 6)):
        there = vc.under_pressure(np.roll(spot, cells, axis=1), BODY, grid, [0.0])
        np.testing.assert_array_equal(found.pressure[index], there.pressure[0])
        np.testing.assert_allclose(found.displacement[index], there.displacement[0], rtol=1e-12)
    half = 0.5 * (spot + np.roll(spot, 1, axis=1))
    np.testing.assert_allclose(found.pressure[1], half, rtol=1e-12)


PEAK, RADIUS, MODULUS = 1e6, 1e-3, 1e9 / 0.91


def disc(x: Any, y: Any) -> Any:
    return PEAK * (x**2 + y**2 < RADIUS**2)


def hertz(x: Any, y: Any) -> Any:
    return PEAK * np.sqrt(np.maximum(1 - (x**2 + y**2) / RADIUS**2, 0.0))


def rectangle(x: Any, y: Any) -> Any:
    return PEAK * ((np.abs(x) < 0.8e-3) & (np.abs(y) < 0.53e-3))


FORMULAS: dict[str, tuple[Any, Any]] = {
    "disc": (
        disc,
        lambda x, y: vc.reference.circle_displacement(PEAK, RADIUS, MODULUS, np.hypot(x, y)),
    ),
    "hertz": (
        hertz,
        lambda x, y: vc.reference.hertz_displacement(PEAK, RADIUS, MODULUS, np.hypot(x, y)),
    ),
    "rectangle": (
        rectangle,
        lambda x, y: vc.reference.rectangle_displacement(PEAK, 0.8e-3, 0.53e-3, MODULUS, x, y),
    ),
}


@pytest.mark.parametrize(
    ("name", "turn", "grid"),
    [
        ("disc", 0.0, vc.Grid((14, 16), (2.9e-3, 2.7e-3), centre=(0.1e-3, -0.13e-3))),
        ("rectangle", 0.0, vc.Grid((17, 12), (2.3e-3, 2.1e-3), centre=(0.05e-3, 0.02e-3))),
        ("rectangle", 0.4, vc.Grid((12, 30), (2.6e-3, 2.4e-3))),  # longer cells, corners within
        pytest.param("hertz", 0.0, vc.Grid((12, 13), (2.6e-3, 2.4e-3)), marks=pytest.mark.slow),
        pytest.param("rectangle", 1.1, vc.Grid((61, 33), (2.8e-3, 2.5e-3)), marks=pytest.mark.slow),
    ],
)
def test_formula_is_exact_to_a_millionth_wherever_its_edges_lie(
    name: str, turn: float, grid: vc.Grid
) -> None:
    pressure, closed_form = FORMULAS[name]
    cos, sin = math.cos(turn), math.sin(turn)

    def turned(x: Any, y: Any) -> tuple[Any, Any]:
        return x * cos + y * sin, y * cos - x * sin

    found = vc.under_pressure(lambda x, y: pressure(*turned(x, y)), BODY, grid)
    exact = closed_form(*turned(grid.x[:, None], grid.y))
    apart = np.abs(found.displacement.values[0] - exact).max() / exact.max()
    stated = float(found.displacement_error[0]) / exact.max()
    assert apart < min(1e-6, stated)
    assert stated < 1e-5
    force = {"disc": math.pi, "hertz": 2 / 3 * math.pi, "rectangle": 4 * 0.8 * 0.53}[name]
    assert float(found.force[0]) == close_to(force * PEAK * 1e-6, rel=1e-6)


@pytest.mark.parametrize("cells", [12, 48])
@pytest.mark.parametrize("half_width", np.linspace(0.41e-3, 0.57e-3, 3))
def test_strip_of_a_layer_is_exact_to_a_millionth_with_edges_within_cells(
    cells: int, half_width: float
) -> None:
    thickness = 1e-3
    layer = vc.Layered([vc.Layer(thickness, BODY)], base="rigid", bonded=False)
    grid = vc.Grid((1, cells), (1e-3, 3e-3), periodic=(True, False))
    strip = vc.under_pressure(lambda x, y: PEAK * (np.abs(y) < half_width) + 0 * x, layer, grid)
    exact = np.array(
        [vc.reference.strip_on_layer(PEAK, half_width, thickness, MODULUS, y) for y in grid.y]
    )
    apart = np.abs(strip.displacement.values[0, 0] - exact).max()
    assert apart < min(1e-6 * exact.max(), float(strip.displacement_error[0])) < 2e-5 * exact.max()


@pytest.mark.parametrize("shape", [(1, 16), (12, 15)])
def test_wave_of_pressure_on_two_periods_is_exact_to_a_millionth(shape: tuple[int, int]) -> None:
    grid = vc.Grid(shape, (1e-3, 1.5e-3), periodic=True)
    wave = 2 * math.pi / 1.5e-3

    def pressure(x: Any, y: Any) -> Any:
        return PEAK * (1 + np.cos(wave * y)) + 0 * x

    found = vc.under_pressure(pressure, BODY, grid)
    exact = 2 * PEAK / (MODULUS * wave) * np.cos(wave * grid.y)  # Johnson 1985, eq. 13.2
    apart = np.abs(found.displacement.values[0] - exact).max() / exact.max()
    assert apart < min(1e-6, float(found.displacement_error[0]) / exact.max())


@pytest.mark.parametrize("place", [(0.11e-3, 0.07e-3), (0.31e-3, -0.22e-3)])
def test_spot_smaller_than_a_cell_is_not_missed(place: tuple[float, float]) -> None:
    radius, grid = 0.12e-3, vc.Grid((8, 9), (4e-3, 4.5e-3))

    def spot(x: Any, y: Any) -> Any:
        return PEAK * (np.hypot(x - place[0], y - place[1]) < radius)

    found = vc.under_pressure(spot, BODY, grid)
    r = np.hypot(grid.x[:, None] - place[0], grid.y - place[1])
    exact = vc.reference.circle_displacement(PEAK, radius, MODULUS, r)
    assert np.abs(found.displacement.values[0] - exact).max() < 1e-5 * exact.max()


@pytest.mark.slow
def test_stated_error_covers_a_pressure_without_bound() -> None:
    def punch(x: Any, y: Any) -> Any:
        inside = 1 - (x**2 + y**2) / RADIUS**2
        return np.where(inside > 0, PEAK / np.sqrt(np.maximum(inside, 1e-12)), 0.0)

    grid = vc.Grid((7, 8), (2.3e-3, 2.4e-3))
    found = vc.under_pressure(punch, BODY, grid)
    r = np.hypot(grid.x[:, None], grid.y)
    exact = 2 * PEAK * RADIUS / MODULUS * np.arcsin(np.minimum(RADIUS / r, 1.0))  # Boussinesq 1885
    apart = np.abs(found.displacement.values[0] - exact).max()
    assert apart < float(found.displacement_error[0]) < 0.2 * exact.max()


def test_noise_as_a_formula_is_not_divided_without_end(monkeypatch: pytest.MonkeyPatch) -> None:
    random, called = np.random.default_rng(1), []

    def noise(x: Any, y: Any) -> Any:
        called.append((x + y).size)
        return random.random((x + y).shape)

    means = resolved(noise, NearField(GRID), Effort(1e-6, 1000)).means
    assert means.mean() == close_to(0.5, rel=0.02)
    assert sum(called) < 400 * 1000


def test_stated_error_covers_that_of_a_map() -> None:
    for cells in (12, 24, 48):
        grid = vc.Grid((cells, cells + 2), (2.4e-3, 2.2e-3))
        r = np.hypot(grid.x[:, None], grid.y)
        found = vc.under_pressure(hertz(grid.x[:, None], grid.y), BODY, grid)
        exact = vc.reference.hertz_displacement(PEAK, RADIUS, MODULUS, r)
        apart = np.abs(found.displacement.values[0] - exact)[r < 0.9 * RADIUS].max()
        assert apart < float(found.displacement_error[0]) < 30 * apart


def test_formula_that_rises_is_that_held_times_the_mean_creep() -> None:
    # Phi = (1 + t)/(2 MPa): 1.5 of that at 0 as the mean over the first second.
    fluid = vc.Material(vc.Maxwell(1e6, 1e6), poisson_ratio=0.5)
    grid = vc.Grid((6, 6), (2.6e-3, 2.6e-3))
    rising = vc.under_pressure(lambda x, y, t: t * disc(x, y), fluid, grid, [0.0, 1.0])
    held = vc.under_pressure(disc, fluid, grid, [0.0, 1.0])
    np.testing.assert_allclose(rising.displacement[1], 1.5 * held.displacement[0], rtol=1e-4)
    np.testing.assert_allclose(held.displacement[1], 2 * held.displacement[0], rtol=1e-12)


def test_resultants_are_those_of_the_map() -> None:
    grid = vc.Grid((6, 8), (3e-3, 2e-3), centre=(1e-3, 0.0))
    spot = np.zeros(grid.shape)
    spot[4, 1:3] = 2e6
    found = vc.under_pressure(spot, BODY, grid)
    assert float(found.force[0]) == close_to(2 * 2e6 * grid.cell_area)
    assert float(found.eccentricity_x[0]) == close_to(grid.x[4])
    assert float(found.eccentricity_y[0]) == close_to((grid.y[1] + grid.y[2]) / 2)
    assert float(found.contact_length[0]) == close_to(0.5e-3)
    assert float(found.contact_width[0]) == close_to(0.5e-3)


def _labelled(x: Any, y: Any) -> xr.DataArray:
    return xr.DataArray(MAP, dims=("x", "y"), coords={"x": x, "y": y})


REFUSED: dict[str, tuple[Any, dict[str, Any], str]] = {
    "no grid": (MAP, {}, "grid: needed"),
    "another shape": (MAP.T, {"grid": GRID}, "shape .8, 6. does not fit the grid"),
    "holes": (np.where(MAP > 4e4, np.nan, MAP), {"grid": GRID}, "has holes"),
    "tension": (-MAP, {"grid": GRID}, "it pulls with .* tension=True"),
    "elsewhere": (_labelled(GRID.x + 1e-3, GRID.y), {"grid": GRID}, "interpolate"),
    "uneven": (_labelled(GRID.x**3, GRID.y), {}, "equally spaced"),
    "no times": (MAP, {"grid": GRID, "material": RUBBER}, "times: the material creeps"),
    "too few times": (np.stack([MAP, MAP]), {"grid": GRID, "times": [0.0]}, "as many times"),
    "late": (np.stack([MAP, MAP]), {"grid": GRID, "times": [1.0, 2.0]}, "increase from 0"),
    "no function": (lambda x: x, {"grid": GRID}, "must take .x, y."),
    "part": (lambda x, y: np.ones(3), {"grid": GRID}, "a value for each"),
    "one number": (lambda x, y: math.sqrt(x) + y, {"grid": GRID}, "with NumPy's functions"),
    "a condition": (lambda x, y: 1.0 if x > y else 0.0, {"grid": GRID}, "with NumPy's functions"),
    "a grid": (
        lambda x, y: disc(x[:, 0][:, None], y[0][None, :]),
        {"grid": GRID},
        "arrays x and y of any shape",
    ),
    "infinite": (lambda x, y: 1 / (0 * x + 0 * y), {"grid": GRID}, "must be finite"),
    "elsewhere as a formula": (lambda x, y: disc(x - 1, y), {"grid": GRID}, "is 0 wherever"),
    "text": ("nowhere.nc", {"grid": GRID}, "nowhere"),
    "a result without fields": (xr.Dataset(), {"grid": GRID}, "no stored pressure"),
    "a body": (MAP, {"grid": GRID, "material": 1e9}, "material must be"),
    "aged": (
        MAP,
        {
            "grid": GRID,
            "times": [1.0],
            "material": vc.Material(RUBBER.law, 0.5, ageing=vc.Ageing(3600.0, 0.8)),
        },
        "ages",
    ),
    "leaving": (
        MAP,
        {"grid": GRID, "times": [1.0], "motion": vc.Travel([0.0, 1.0], y=[0.0, 1e-3])},
        "leaves it",
    ),
}


@pytest.mark.filterwarnings("ignore:divide by zero")
@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused_with_the_remedy(name: str) -> None:
    pressure, given, message = REFUSED[name]
    given = {"material": BODY, **given}
    with pytest.raises((ValueError, FileNotFoundError), match=message):
        vc.under_pressure(pressure, **given)


def test_tension_is_taken_where_it_is_allowed() -> None:
    pulled = vc.under_pressure(-MAP, BODY, GRID, tension=True).displacement.values
    pressed = vc.under_pressure(MAP, BODY, GRID).displacement.values
    np.testing.assert_allclose(pulled, -pressed, rtol=1e-12)


def test_coordinates_take_the_place_of_a_grid() -> None:
    turned = _labelled(GRID.x, GRID.y).transpose("y", "x")
    found = vc.under_pressure(turned, BODY)
    expected = vc.under_pressure(MAP, BODY, GRID)
    np.testing.assert_allclose(found.displacement, expected.displacement, rtol=1e-9)


def test_table_of_points_is_the_map_in_any_order(tmp_path: Path) -> None:
    rows = [
        f"{1e3 * y}, {1e3 * x}, {MAP[i, j] / 1e6}, {time}"
        for time in (0, 2)
        for j, y in enumerate(GRID.y)
        for i, x in enumerate(GRID.x)
    ]
    table = tmp_path / "pressure.csv"
    table.write_text("\n".join(["y [mm], x [mm], pressure [MPa], time [s]", *rows[::-1]]))
    found = vc.under_pressure(table, RUBBER)
    expected = vc.under_pressure(MAP, RUBBER, GRID, [0.0, 2.0])
    np.testing.assert_allclose(found.time, [0.0, 2.0])
    np.testing.assert_allclose(found.displacement, expected.displacement, rtol=1e-6)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x [mm], force [N]\n1, 2\n2, 3\n", "columns 'x .mm., y .mm., pressure .MPa.'"),
        ("x [mm], y [mm], pressure [MPa]\n0, 0, 1\n0, 1, 1\n1, 0, 1\n", "1 of the 4 points"),
        ("x [mm], y [mm], p [MPa]\n0, 0, 1\n0, 1, 1\n1, 0, 1\n1, 1, 1\n1, 1, 2\n", "given twice"),
        ("x [mm], y [mm], p [MPa]\n0, 0, 1\n0, 1, 1\n", "lie on one line"),
        ("x [mm], y [mm], pressure\n0, 0, 1\n0, 1, 1\n1, 0, 1\n1, 1, 1\n", "unit"),
    ],
)
def test_bad_tables_are_refused(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "bad.csv").write_text(text)
    with pytest.raises(ValueError, match=message):
        vc.under_pressure(tmp_path / "bad.csv", BODY)
