"""Bars of peak pressures next to the end of a body, from results of coarser runs."""

import math
from dataclasses import replace

import numpy as np
import pytest

import viscontact as vc
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.coarser_results import history_of
from viscontact.simulation.accuracy.coarser_runs import march_coarser_run, plan_coarser_runs
from viscontact.simulation.accuracy.singular_peaks import (
    SINGULAR,
    coarse_peak_warnings,
    peak_bars,
    singular_warnings,
)
from viscontact.simulation.transient.setup import prepare_run
from viscontact.simulation.transient.state_generator import march_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
BALL, RUBBER = vc.Paraboloid(0.01, 0.01), vc.Material(vc.Elastic(1e6), 0.5)
BARS = np.array([1.0])


@pytest.fixture(scope="module")
def ball():
    """History and coarser results of a ball, 20 cells across."""
    grid = vc.Grid((32, 32), (2.7e-3, 2.7e-3))
    run = prepare_run(Problem(BALL, RUBBER, vc.step(0.1), grid, [0.0]))
    history = history_of(list(march_run(run)))
    return history, [march_coarser_run(each) for each in plan_coarser_runs(run, history)]


def at_end(ball, exponent, beside, inner):
    """The results with peaks that grow by an exponent, at an end that carries parts of them."""
    history, results = ball
    changed = []
    for each in results:
        peaks = history["peak_pressure"] * each.spacing**-exponent
        ends = np.array([[beside, inner]]) * peaks[:, None]
        scalars = each.scalars | {"peak_pressure": peaks}
        reached = np.ones_like(each.at_end)
        changed.append(replace(each, scalars=scalars, end_pressures=ends, at_end=reached))
    return history, changed


@pytest.mark.parametrize(
    ("exponent", "beside", "is_endless"),
    [
        (0.5, 1.0, True),
        (0.25, 1.0, True),
        (0.05, 1.0, False),
        (-0.2, 1.0, False),
        (0.5, 0.7, False),
    ],
    ids=["sharp", "sharp on few cells", "logarithmic", "falling", "elsewhere"],
)
def test_peak_at_an_end_has_no_limit_if_it_lies_there_and_grows(ball, exponent, beside, is_endless):
    """As 1/sqrt(h) at a sharp end (Johnson 1985, eq. 2.64)."""
    (bar,) = peak_bars(BARS, *at_end(ball, exponent, beside, inner=0.9))
    assert math.isinf(bar) == is_endless


def test_bar_of_a_peak_near_an_end_is_at_least_its_excess(ball):
    history, results = at_end(ball, exponent=0.0, beside=0.5, inner=0.8)
    (bar,) = peak_bars(BARS, history, results)
    assert 0.2 <= bar / history["peak_pressure"][0] <= 0.6


def test_peak_that_an_automatic_grid_left_out_has_no_limit_at_an_end(ball):
    changed = at_end(ball, exponent=0.0, beside=0.5, inner=1.0)
    assert math.isinf(peak_bars(BARS, *changed, left_out=True)[0])
    assert peak_bars(BARS, *changed)[0] == 1.0
    assert peak_bars(BARS, *ball, left_out=True)[0] == 1.0  # no end is reached


def test_peak_has_no_limit_between_instants_that_coarser_runs_have_far_apart(ball):
    """Cells in which a round edge lies on the finer one of the two grids may hide its growth."""
    history, results = ball
    many = {name: np.repeat(values, 9) for name, values in history.items()}
    many["time"] = np.arange(9.0)
    changed = []
    for each, instants, exponent in zip(results, ([0, 8], [0, 4, 8]), (0.5, 0.02), strict=True):
        count = len(instants)
        scalars = {name: np.repeat(values, count) for name, values in each.scalars.items()}
        peaks = np.full(count, history["peak_pressure"][0] * each.spacing**-exponent)
        repeated = (
            "bend_growth",
            "near_bend_growth",
            "spots",
            "peak_drops",
            "apex_exponents",
            "rises_to_ends",
        )
        changed.append(
            replace(
                each,
                scalars=scalars | {"time": np.array(instants, float), "peak_pressure": peaks},
                end_pressures=np.stack([peaks, peaks / 2], axis=1),
                at_end=np.ones(count, bool),
                **{name: np.repeat(getattr(each, name), count, axis=0) for name in repeated},
            )
        )
    assert np.isinf(peak_bars(np.ones(9), many, changed)).all()


def test_infinite_bars_come_with_a_warning_and_a_remedy_once():
    endless, cone = np.array([1.0, np.inf]), vc.Cone(1.4)
    (text,) = singular_warnings(endless, cone, issued=["the steps are long"])
    assert text.startswith(SINGULAR)
    assert "under indenter" in text
    assert singular_warnings(BARS, cone) == ()
    (issued,) = vc.march(cone, RUBBER, vc.step(0.1), vc.Grid((32, 32), (1.6e-3,) * 2), [0.0])
    assert singular_warnings(endless, cone, issued.warnings) == ()


def peak_at_edge(radius, cells):
    """Run of a flat face of 1 mm whose edge is rounded with a radius [m]."""
    r = np.append(0.0, np.linspace(1e-3, 2e-3, 60))
    body = vc.Revolved(r, np.maximum(r - 1e-3, 0.0) ** 2 / (2 * radius))
    grid = vc.Grid((cells, cells), (3e-3, 3e-3))
    return vc.simulate(body, RUBBER, vc.step(0.05), grid, [0.0])


@pytest.mark.parametrize("radius", [1e-3, 2e-3, 4e-3])
def test_peaks_at_an_edge_rounded_within_a_cell_are_within_bars_that_are_not_wide(radius) -> None:
    """The rounding in contact takes 0.4 to 1.4 cells; 2 to 5 cells give the peak within 2 %."""
    true = float(peak_at_edge(radius, 240).peak_pressure[0])
    for cells in (28, 34, 48, 60, 80):
        ds = peak_at_edge(radius, cells)
        error = abs(float(ds.peak_pressure[0]) - true)
        bar = float(ds.peak_pressure_error[0])
        assert error < 1.15 * bar + 0.02 * true
        assert np.isinf(bar) or bar < 2 * error + 0.2 * true


@pytest.mark.parametrize(("cells", "is_coarse"), [(28, True), (60, False), (120, False)])
def test_peak_near_a_rounded_edge_of_few_cells_is_warned_of(cells: int, is_coarse: bool) -> None:
    """The peak is 20 %, 3 % and 2 % too small."""
    warnings = peak_at_edge(2e-3, cells).attrs["warnings"]
    assert ("smaller cells if the peak" in warnings) == is_coarse


def test_largest_part_of_a_coarse_peak_is_said_without_instants_of_small_peaks() -> None:
    history = {"time": np.arange(3.0), "peak_pressure": np.array([1.0, 4.0, 3.0])}
    bars, least = np.array([0.9, 1.0, np.inf]), np.array([0.9, 0.9, 0.9])
    (text,) = coarse_peak_warnings(bars, least, history)
    assert text.startswith("the peak pressure is known to 25% only, at 1 s")
    assert coarse_peak_warnings(bars, np.zeros(3), history) == ()
