"""Histories, their comparisons, loops and curves draw the computed values over time."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from closeness import close_to
from drawing.matplotlib.drawn_runs import legend_texts, long_contact, sphere, sticking_sphere
from synthetic_results import maxwell_sphere, roller
from viscontact.laws import CreepSeries, Maxwell
from viscontact.plot import COMPARISONS, FIGURES, creep_curve
from viscontact.results.snapshots import take_snapshots

__all__ = ["long_contact", "sphere"]  # fixtures


def test_history_draws_the_dataset_in_readable_units(sphere: xr.Dataset) -> None:
    panels = {axes.get_ylabel(): axes for axes in FIGURES["history"](sphere).axes}
    assert set(panels) == {"Contact area [mm²]", "Approach [µm]", "Peak pressure [MPa]"}
    time, approach = panels["Approach [µm]"].get_lines()[0].get_data()
    np.testing.assert_allclose(time, sphere["time"], rtol=1e-12)
    np.testing.assert_allclose(approach, sphere["approach"] * 1e6, rtol=1e-12)


def test_history_shows_force_and_tilt_only_where_they_change(sphere: xr.Dataset) -> None:
    tilted = roller(tilt=0.2)
    tilted["force"][2:] *= 0.5
    labels = [axes.get_ylabel() for axes in FIGURES["history"](tilted).axes]
    assert "Force [kN]" in labels
    assert any(label.startswith("Tilt along x") for label in labels)
    assert not any(label.startswith("Tilt along y") for label in labels)


def test_time_axis_is_logarithmic_where_the_steps_are() -> None:
    growing = maxwell_sphere([0.0, *np.geomspace(0.1, 300.0, 12)], cells=8)
    uniform = maxwell_sphere(np.linspace(0.0, 300.0, 13), cells=8)
    assert FIGURES["history"](growing).axes[0].get_xscale() == "symlog"
    assert FIGURES["history"](uniform).axes[0].get_xscale() == "linear"


def test_logarithmic_axis_over_days_is_marked_in_seconds_minutes_hours_and_days() -> None:
    week = maxwell_sphere([0.0, *np.geomspace(0.5, 604800.0, 12)], cells=8)
    for name, start in (("history", ["0"]), ("creep", [])):
        axes = FIGURES[name](week).axes[0]
        labels = [text.get_text() for text in axes.get_xticklabels()]
        assert labels == [*start, "1 s", "1 min", "1 h", "1 d"], name
        wanted = np.array([1.0, 60.0, 3600.0, 86400.0]) / 86400  # the axis is in days
        np.testing.assert_allclose(axes.get_xticks()[len(start) :], wanted)
        assert axes.get_xlabel() in ("Time", "")  # only the lowest panels have a label
    assert FIGURES["history"](week).axes[-1].get_xlabel() == "Time"


def test_instants_are_drawn_while_the_contact_changes() -> None:
    """Final after 100 s of 1e5 s: one of five instants is the last, the others come before."""
    times = [0.0, *np.geomspace(0.1, 1e5, 25)]
    run = maxwell_sphere([0.0, *np.linspace(1, 25, 25)], cells=16).assign_coords(time=times)
    run["contact_area"] = ("time", 1e-6 * np.log10(1 + np.minimum(times, 100.0)) + 1e-6)
    labels = [snapshot.axis.quantity(snapshot.time) for snapshot in take_snapshots(run, None, "")]
    assert len(labels) == 5
    assert labels == ["0 s", "3.162 s", "10 s", "31.62 s", "27.78 h"]


def test_von_mises_over_time_is_logarithmic_where_the_history_is(
    long_contact: xr.Dataset,
) -> None:
    for name in ("history", "von-mises"):
        scales = {axes.get_xscale() for axes in FIGURES[name](long_contact).axes}
        assert scales == {"symlog"}, name


def test_panels_that_do_not_fill_their_rows_are_evenly_apart(long_contact: xr.Dataset) -> None:
    swings = np.linspace(0.5, 1, long_contact.sizes["time"])
    run = long_contact.assign(
        force=long_contact.force * swings, tilt_x=long_contact.force * 0 + 1e-3 * swings
    )
    figure = FIGURES["history"](run)
    assert len(figure.axes) == 5
    assert {axes.get_xlabel() for axes in figure.axes} == {"Time [s]"}


def test_comparison_names_its_runs(long_contact: xr.Dataset) -> None:
    figure = COMPARISONS["history"]({"e = 0": long_contact, "e = L": roller(tilt=0.2)})
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["e = 0", "e = L"]


@pytest.mark.parametrize("name", [pytest.param("history", marks=pytest.mark.slow), "hysteresis"])
def test_legend_of_many_runs_leaves_the_panels_their_height(name: str, sphere: xr.Dataset) -> None:
    few, many = (
        COMPARISONS[name]({f"ball_force={n}N": sphere for n in range(count)}) for count in (2, 24)
    )
    (legend,) = many.legends
    heights = []
    for figure in (few, many):
        figure.draw_without_rendering()
        heights.append(min(axes.bbox.height for axes in figure.axes))
    assert heights[1] > 0.7 * heights[0]
    assert not any(legend.get_window_extent().overlaps(axes.bbox) for axes in many.axes)


@pytest.mark.parametrize("name", sorted(COMPARISONS))
def test_comparison_of_nothing_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match=r"at least one run"):
        COMPARISONS[name]({})


def test_history_of_one_step_is_refused(sphere: xr.Dataset) -> None:
    with pytest.raises(ValueError, match=r"history: needs at least two steps.*got 1"):
        FIGURES["history"](sphere.isel(time=[0]))


def test_creep_curves_are_the_law_of_eq_15() -> None:
    law = CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 1 / 7.47e-3])
    compliance, modulus = creep_curve(law, np.geomspace(0.1, 1000.0, 30)).axes
    t, phi = compliance.get_lines()[0].get_data()
    expected = 0.7 - 6.17e-2 * np.exp(-0.1 * t) - 8.38e-2 * np.exp(-7.47e-3 * t)
    assert compliance.get_ylabel() == "Creep compliance Φ [1/GPa]"
    np.testing.assert_allclose(phi, expected, rtol=1e-12)
    assert modulus.get_ylabel() == "Relaxation modulus G [MPa]"
    # G(0) = 1/(2 Phi(0)), drawn as the dashed line.
    assert modulus.get_lines()[1].get_ydata()[0] == close_to(1e3 / (2 * 0.5545))


@pytest.mark.parametrize("times", [[1.0], [0.0, 1.0], [2.0, 1.0], [1.0, np.nan]])
def test_creep_curve_refuses_times_it_cannot_draw(times: list[float]) -> None:
    with pytest.raises(ValueError, match=r"creep: times must be"):
        creep_curve(Maxwell(1e9, 1e11), times)


def _swinging(times: np.ndarray, force: np.ndarray, approach: np.ndarray) -> xr.Dataset:
    """Scalars of a made-up run."""
    steady = maxwell_sphere(times.tolist(), cells=8, fields=False)
    steady["force"][:] = force
    steady["approach"][:] = approach
    return steady


def test_hysteresis_draws_force_over_approach_in_the_units_of_its_labels() -> None:
    t = np.linspace(0, 2, 65)
    force = 20e3 + 10e3 * np.sin(np.pi * t)
    approach = 2e-4 + 1e-4 * np.sin(np.pi * t - 0.3)
    run = _swinging(t, force, approach)
    run["loss_per_cycle"] = ("time", np.where(t < 2, np.nan, np.pi * 1e4 * 1e-4 * np.sin(0.3)))
    figure = FIGURES["hysteresis"](run)
    [line] = figure.axes[0].get_lines()
    np.testing.assert_allclose(line.get_xdata(), approach * 1e6)
    np.testing.assert_allclose(line.get_ydata(), force * 1e-3)
    assert figure.axes[0].get_xlabel() == "Approach [µm]"
    assert figure.axes[0].get_ylabel() == "Force [kN]"
    # the area of the ellipse, pi F w sin(lag) = 0.928 J
    assert figure.axes[0].get_title(loc="right") == "loss per cycle 928 mJ"
    half = FIGURES["hysteresis"](run, times=[0.0, 1.0])
    assert len(half.axes[0].get_lines()[0].get_xdata()) == 33
    assert half.axes[0].get_title(loc="right") == ""


def test_hysteresis_arrows_go_with_time() -> None:
    t = np.linspace(0, 1, 20)
    figure = FIGURES["hysteresis"](_swinging(t, t, 1e-3 * t))
    arrows = figure.axes[0].texts
    assert len(arrows) == 4
    for arrow in arrows:
        assert arrow.xy[0] > arrow.xyann[0]
        assert arrow.xy[1] > arrow.xyann[1]


def test_hysteresis_of_a_held_force_begins_at_zero_although_the_force_has_a_bar() -> None:
    t = np.linspace(0, 1, 20)
    run = _swinging(t, np.full_like(t, 10e3), 1e-3 + 1e-4 * t)
    run["force_error"] = ("time", np.full_like(t, 0.03))  # three tolerances of 1e-6 [N]
    axes = FIGURES["hysteresis"](run).axes[0]
    assert axes.get_ylim()[0] == 0
    assert axes.get_ylim()[1] > 10


@pytest.mark.parametrize(
    ("hold", "scale"), [(0.0, "symlog"), (1.0, "symlog"), (30.0, "linear"), (100.0, "linear")]
)
@pytest.mark.parametrize("control", ["force", "approach"])
def test_time_is_logarithmic_only_where_the_load_is_held_nearly_from_the_start(
    hold: float, scale: str, control: str
) -> None:
    t = np.append(0.0, np.geomspace(0.01, 100, 60))
    driven, follows = np.minimum(t, hold) if hold else np.ones_like(t), 2 + np.log10(1 + t)
    levels = {"force": (driven, 1e-4 * follows), "approach": (follows, 1e-4 * driven)}[control]
    figure = FIGURES["history"](_swinging(t, *levels))
    assert {axes.get_xscale() for axes in figure.axes} == {scale}


def test_force_curve_has_both_ways_the_jumps_and_the_limits_of_spheres() -> None:
    run = sticking_sphere()
    (axes,) = FIGURES["force-curve"](run).axes
    assert legend_texts(axes) == ["approach", "retraction"]
    # A line from before to after each jump, in the units of the axes: µm and µN.
    ends = np.reshape(run.attrs["event_force"], (-1, 2)) * 1e6
    drawn = [line.get_ydata() for line in axes.lines if len(line.get_xdata()) == 2]
    for pair in ends:
        assert any(np.allclose(np.asarray(line, float), pair, rtol=1e-6, atol=0) for line in drawn)
    # 3/2 and 2 times pi w R.
    unit = np.pi * 0.05 * 1e-3 * 1e6
    texts = {text.get_text() for text in axes.texts}
    assert {"JKR", "DMT"} <= texts
    level = [np.asarray(line, float) for line in drawn if line[0] == line[1]]
    for factor in (1.5, 2.0):
        assert any(np.allclose(line, -factor * unit, rtol=1e-6, atol=0) for line in level)


def test_force_curve_needs_adhesion(sphere: xr.Dataset) -> None:
    with pytest.raises(ValueError, match="force-curve: needs bodies that adhere"):
        FIGURES["force-curve"](sphere)
