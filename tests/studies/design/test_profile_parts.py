"""Parts of the design of a free profile: curves, minimax search, files and arguments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from numpy.typing import NDArray

import viscontact as vc
from closeness import close_to
from returned import some
from viscontact.studies.design.profiles.convex_curve import ConvexCurves
from viscontact.studies.design.profiles.minimax import least_largest
from viscontact.studies.design.profiles.named import amplitude_of
from viscontact.studies.design.profiles.profile_runs import MARGIN, search_grids
from viscontact.studies.design.profiles.result_files import profile_csv
from viscontact.studies.design.profiles.tables import deviating
from viscontact.studies.evaluation import BudgetSpentError
from viscontact.tables import read_line

Array = NDArray[np.float64]

ROLLER = """
indenter: {shape: roller, radius: 5 mm, half_length: 10 mm}
material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.35}
load: {kind: step, force: 967 N}
time: {end: 1 s, steps: 1}
"""


@dataclass(frozen=True)
class Values:
    values: Array
    forbidden: Array


@pytest.mark.parametrize("symmetric", [True, False])
def test_curves_with_positive_coefficients_are_convex(symmetric: bool) -> None:
    curves = ConvexCurves(10e-3, 6, symmetric)
    coefficients = np.random.default_rng(3).uniform(0, 1e-5, curves.size)
    drop = curves.drop(coefficients, curves.table())
    assert drop.min() == drop[100] == 0.0
    assert (np.diff(drop, 2) > -1e-18).all()
    assert np.array_equal(drop, drop[::-1]) == symmetric
    # Each coefficient is what its knot adds to the drop at an end.
    halves = coefficients.reshape(-1, 6).sum(axis=1)
    np.testing.assert_allclose([drop[0], drop[-1]], np.resize(halves, 2), rtol=1e-12)


def test_a_curve_is_smooth_to_its_second_derivative() -> None:
    curves = ConvexCurves(1.0, 5, symmetric=True)
    knot = curves.places[2]
    # The jump of the second derivative at a knot vanishes with the step of the differences.
    jumps = []
    for step in (1e-2, 5e-3, 2.5e-3):
        around = curves.shapes(knot + step * np.array([-2, -1, 0, 1, 2]))[:, 2]
        second = np.diff(around, 2) / step**2
        jumps.append(abs(second[2] - second[0]) / abs(second[1]))
    assert jumps[2] < jumps[1] / 1.9 < jumps[0] / 3.6


def test_more_knots_fit_a_johns_gohar_profile_more_closely() -> None:
    misfits = []
    for knots in (5, 8, 16):
        curves = ConvexCurves(10e-3, knots, symmetric=True)
        x = curves.table()
        line = vc.LogarithmicProfile.johns_gohar(5e-3, 10e-3, 967.0, 3.08e9).drop(x, 10e-3)
        misfits.append(abs(curves.drop(curves.fitted(line), x) - line).max() / line.max())
    assert misfits[2] < misfits[1] < misfits[0] < 0.08
    assert misfits[1] < 0.03


@pytest.mark.parametrize("degree", [2, 3, 5])
def test_the_least_largest_deviation_is_that_of_chebyshev(degree: int) -> None:
    # Polynomials of lower degree come to x^n on [-1, 1] within 2^(1 - n) (Chebyshev).
    x = np.cos(np.linspace(0, np.pi, 401))

    def deviations(points: Sequence[Array]) -> list[Values]:
        found = [x**degree - np.polynomial.Polynomial(point)(x) for point in points]
        return [Values(np.concatenate([each, -each]), np.zeros(1)) for each in found]

    found = least_largest(deviations, np.zeros(degree), np.ones(degree), np.full(degree, -np.inf))
    assert found.cost == close_to(2.0 ** (1 - degree), rel=2e-3)
    assert not found.is_cut_short


def test_the_search_finds_a_curved_minimum_that_a_forbidden_value_bounds() -> None:
    # Least largest of (a - 2)^2 and (a - 2)^2 + b^2 with a <= 1 and b >= 0: 1 at (1, 0).
    def values(points: Sequence[Array]) -> list[Values]:
        return [
            Values(np.array([(a - 2) ** 2, (a - 2) ** 2 + b**2]), np.array([a - 1.0]))
            for a, b in points
        ]

    found = least_largest(values, np.array([0.0, 1.0]), np.ones(2), np.array([-np.inf, 0.0]))
    assert found.cost == close_to(1.0, rel=5e-3)
    assert found.point[0] == close_to(1.0, abs=5e-3)


def test_a_search_without_further_calls_keeps_its_best_point() -> None:
    calls = 0

    def values(points: Sequence[Array]) -> list[Values]:
        nonlocal calls
        calls += len(points)
        if calls > 6:
            raise BudgetSpentError
        return [Values(np.array([(a - 3.0) ** 2]), np.zeros(1)) for (a,) in points]

    found = least_largest(values, np.zeros(1), np.ones(1), np.array([-np.inf]))
    assert found.is_cut_short
    assert 0.0 < found.point[0] <= 3.0


def test_deviations_stay_within_the_tolerance_and_reach_it() -> None:
    u = np.linspace(-1, 1, 201)
    found = deviating(u**2, u, 0.1)
    assert len(found) == 7
    for name, drop in found.items():
        assert abs(drop - u**2).max() == close_to(0.0 if name == "none" else 0.1)


def test_the_amplitude_of_a_hertzian_width_is_lundbergs() -> None:
    hertz = vc.reference.hertz_line(1e5, 5e-3, 3e9)
    exact = vc.LogarithmicProfile.lundberg(10e-3, 1e5 * 20e-3, 3e9).amplitude
    assert amplitude_of(2 * hertz.half_width, 5e-3) == close_to(exact, rel=1e-12)


def test_cells_of_the_search_end_where_the_roller_and_its_free_part_do() -> None:
    for grid in some(search_grids(10e-3, (0.6e-3, 1e-3))):
        edges = grid.x[:-1] + grid.cell_size[0] / 2
        for place in (10e-3, (1 - MARGIN) * 10e-3):
            assert abs(edges - place).min() < 1e-12


def test_a_drawing_states_millimetres_and_has_the_profile_as_a_polyline(tmp_path: Path) -> None:
    x, drop = np.linspace(-10e-3, 10e-3, 21), 1e-6 * np.linspace(-10, 10, 21) ** 2
    vc.write_dxf(tmp_path / "line.dxf", x, drop, radius=5e-3)
    drawing = ezdxf.readfile(tmp_path / "line.dxf")
    assert drawing.header["$INSUNITS"] == 4  # millimetres
    assert drawing.header["$MEASUREMENT"] == 1  # metric
    assert not drawing.audit().errors
    (line,) = drawing.modelspace().query("LWPOLYLINE")
    assert line.dxf.layer == "PROFILE"
    points = np.array(line.get_points("xy"))
    np.testing.assert_allclose(points, np.column_stack([1e3 * x, 5 - 1e3 * drop]), atol=1e-12)


def test_the_table_is_read_as_it_was_written(tmp_path: Path) -> None:
    x, drop = np.array([-1e-2, 0.0, 1e-2]), np.array([12.3456e-6, 0.0, 1e-10])
    (tmp_path / "profile.csv").write_text(profile_csv(x, drop))
    found = read_line(tmp_path / "profile.csv", "x")
    np.testing.assert_allclose(found, [x, drop], rtol=1e-12)


@pytest.mark.parametrize(
    ("case", "arguments", "message"),
    [
        (ROLLER, {"knots": 2}, "knots"),
        (ROLLER, {"drop_tolerance": -1e-6}, "drop_tolerance"),
        (ROLLER, {"at": "never"}, "at: must be 'worst', 'end' or a time"),
        (ROLLER, {"at": 0.5}, "at: 500 ms is no instant of the case"),
        (ROLLER, {"over": {"load.force": "1 N"}}, "over: load.force: must be a list"),
        (ROLLER, {"over": {"indenter.half_length": ["8 mm", "9 mm"]}}, "different lengths"),
        (ROLLER, {"settings": {"load.force": "1 mm"}}, "load.force"),
        (
            ROLLER.replace("radius: 5 mm", "radius: 100 mm").replace("967 N", "16 kN")
            + "grid: {shape: [64, 64], size: [22 mm, 22 mm]}",
            {},
            "longer than wide",
        ),
        (
            ROLLER.replace("half_length: 10 mm", "half_length: 10 mm, crown_radius: 1 m"),
            {},
            "the roller has no end; give length",
        ),
        (
            ROLLER.replace("shape: roller, radius: 5 mm, half_length", "shape: sphere, radius"),
            {},
            "a free profile is that of one roller",
        ),
        (ROLLER.replace("steps: 1", "spacing: adaptive, tolerance: 0.01"), {}, "adaptive steps"),
    ],
)
def test_a_case_without_a_free_profile_is_refused_in_one_line(
    tmp_path: Path, case: str, arguments: dict[str, object], message: str
) -> None:
    path = tmp_path / "roller.yaml"
    path.write_text(case)
    with pytest.raises(ValueError, match=message) as refused:
        vc.design_profile(path, workers=1, **arguments)  # type: ignore[arg-type]
    assert len(str(refused.value).splitlines()) == 1
