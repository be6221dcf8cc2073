"""Figures draw the computed values in the unit of their labels."""

from __future__ import annotations

import subprocess
import sys
import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib import pyplot, rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.text import Text

import viscontact as vc
from closeness import close_to
from returned import some
from synthetic_results import gripping_sphere, maxwell_pressure, maxwell_sphere, roller
from viscontact.drawing.content.rim import rim_curves
from viscontact.laws import CreepSeries, Maxwell
from viscontact.plot import COMPARISONS, FIGURES, creep_curve, save_figure
from viscontact.results.snapshots import take_snapshots
from viscontact.units.formatting import readable_unit


@pytest.fixture(scope="module")
def sphere() -> xr.Dataset:
    return maxwell_sphere(cells=40)


@pytest.fixture(scope="module")
def long_contact() -> xr.Dataset:
    return roller()


def data_axes(figure: Figure) -> list[Axes]:
    return [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]


def legend_texts(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


#: Figures that only runs under friction have.
OF_FRICTION = {"stick-map", "traction-profile", "fretting-loop", "slip-history"}


#: Figures of bodies that adhere.
OF_ADHESION = {"force-curve"}


#: Figures of contacts on a period.
OF_PERIODS = {"area-pressure"}


@cache
def pressed_waves() -> xr.Dataset:
    """Crossed waves under a force that rises."""
    grid = vc.Grid((16, 16), (1e-3, 1e-3), periodic=True)
    waves = vc.Waviness(1e-6, wavelength_x=1e-3, wavelength_y=1e-3)
    body = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        return vc.simulate(
            waves, body, vc.ramp(0.01, 1.0), grid, [0.0, 0.5, 1.0, 2.0], errors=False
        )


@cache
def sticking_sphere() -> xr.Dataset:
    """Sphere of a Tabor number of 1 that jumps into contact and is pulled off."""
    gel = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)
    load = vc.ApproachHistory([0.0, 1.0, 2.0], [-2.5e-6, 1e-6, -2.5e-6])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        return vc.simulate(
            *(vc.Paraboloid(1e-3, 1e-3), gel, load, vc.Grid((32, 32), (2.4e-4, 2.4e-4))),
            np.linspace(0.0, 2.0, 21),
            adhesion=vc.Adhesion(0.05, range=1.36e-6),
            errors=False,
        )


def run_for(name: str, sphere: xr.Dataset, gripping: xr.Dataset) -> xr.Dataset:
    """Result that a figure is for."""
    if name in OF_PERIODS:
        return pressed_waves()
    if name in OF_ADHESION:
        return sticking_sphere()
    return gripping if name in OF_FRICTION else sphere


# --- every figure ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def drawn(sphere: xr.Dataset) -> Callable[[str], Figure]:
    """Every figure of the sphere, drawn once; those of friction of one under friction."""
    gripping = gripping_sphere(cells=40)
    return cache(lambda name: FIGURES[name](run_for(name, sphere, gripping)))


@pytest.mark.parametrize("name", sorted(FIGURES))
def test_every_figure_of_a_sphere_draws(
    name: str,
    drawn: Callable[[str], Figure],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 80)
    path = tmp_path / f"{name}.png"
    save_figure(drawn(name), path)
    assert path.stat().st_size > 5000


#: What a contact that is long and at an edge changes most, by default.
LONG = {"history", "pressure-map", "pressure-profile"}


@pytest.mark.parametrize(
    "name",
    [
        name if name in LONG else pytest.param(name, marks=pytest.mark.slow)
        for name in sorted(
            set(FIGURES)
            - (OF_FRICTION | OF_PERIODS | OF_ADHESION)
            - {"pressure-radial", "exact", "leak-channel", "fluid-pressure"}
        )
    ],
)
def test_every_figure_of_a_roller_draws(name: str, long_contact: xr.Dataset) -> None:
    FIGURES[name](long_contact, times=[0.0, 1000.0]).draw_without_rendering()


#: Comparisons that put runs side by side or draw outlines, and hold no lines; and of steady motion.
SIDE_BY_SIDE = {"pressure-3d", "pressure-map", "contact-outline", "friction"}


@pytest.mark.parametrize("name", sorted(set(COMPARISONS) - SIDE_BY_SIDE))
def test_every_comparison_draws_every_run(name: str, long_contact: xr.Dataset) -> None:
    figure = COMPARISONS[name]({"straight": long_contact, "tilted": roller(tilt=0.2)})
    figure.draw_without_rendering()
    for axes in some(figure.axes):
        assert len(axes.get_lines()) == 2


@pytest.mark.parametrize("name", sorted(FIGURES))
def test_every_labelled_axis_states_its_unit(name: str, drawn: Callable[[str], Figure]) -> None:
    labels = [
        label
        for axes in drawn(name).axes
        for label in (axes.get_xlabel(), axes.get_ylabel())
        if label
    ]
    assert len(labels) >= 2
    for label in labels:
        assert label.endswith("]"), label


def test_plotting_leaves_global_settings_and_pyplots_figures_alone() -> None:
    pyplot.close("all")
    before = dict(rcParams)
    FIGURES["contact-outline"](maxwell_sphere(cells=8)).draw_without_rendering()
    assert dict(rcParams) == before
    assert not pyplot.get_fignums()


@pytest.mark.slow  # a process that imports everything
def test_importing_the_figures_leaves_global_settings_alone() -> None:
    program = (
        "import matplotlib, matplotlib.pyplot as pyplot; before = dict(matplotlib.rcParams)\n"
        "from synthetic_results import maxwell_sphere\n"
        "from viscontact.plot import FIGURES\n"
        "FIGURES['pressure-map'](maxwell_sphere(cells=24)).draw_without_rendering()\n"
        "assert dict(matplotlib.rcParams) == before and not pyplot.get_fignums()\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, cwd=Path(__file__).parents[2])


# --- which instants ---------------------------------------------------------------------------


def test_legend_names_the_drawn_instant_not_the_requested_one(sphere: xr.Dataset) -> None:
    figure = FIGURES["pressure-profile"](sphere, times=[8.0])
    assert legend_texts(figure.axes[0]) == ["10 s"]


def test_fields_stored_at_chosen_instants_are_found_by_field_time(sphere: xr.Dataset) -> None:
    fields = sphere[["pressure", "gap"]].isel(time=[0, 3]).rename(time="field_time")
    thinned = xr.merge([sphere.drop_vars(["pressure", "gap", "displacement"]), fields])
    figure = FIGURES["pressure-profile"](thinned)
    assert legend_texts(figure.axes[0]) == ["0 s", "300 s"]


@pytest.mark.parametrize(
    "name",
    [
        *("pressure-map", "pressure-profile", "pressure-radial", "contact-outline"),
        *("pressure-3d", "surface-3d", "contact-area"),
    ],
)
def test_figures_of_fields_refuse_a_result_without_them(name: str) -> None:
    with pytest.raises(ValueError, match=rf"{name}: .*no pressure.*fields"):
        FIGURES[name](maxwell_sphere(cells=16, fields=False))


def test_figures_of_scalars_need_no_fields() -> None:
    bare = maxwell_sphere(cells=16, fields=False)
    for name in ("history", "creep"):
        FIGURES[name](bare).draw_without_rendering()


@pytest.mark.parametrize("times", [[np.nan], [], [0.0, np.inf]])
def test_times_that_are_no_numbers_are_refused(times: list[float], sphere: xr.Dataset) -> None:
    gripping = gripping_sphere(cells=8)
    for name in sorted(FIGURES):
        with pytest.raises(ValueError, match=r"times must be finite"):
            FIGURES[name](run_for(name, sphere, gripping), times=times)


def test_instants_without_contact_are_refused_by_name(sphere: xr.Dataset) -> None:
    apart = sphere.copy(deep=True)
    apart["pressure"][:] = 0.0
    apart["peak_pressure"][:] = 0.0
    for times in (None, [100.0]):
        with pytest.raises(ValueError, match=r"contact-outline: the bodies do not touch"):
            FIGURES["contact-outline"](apart, times=times)


# --- what is drawn ----------------------------------------------------------------------------


def test_profile_peak_is_the_mean_of_the_two_middle_rows_in_megapascal(
    long_contact: xr.Dataset,
) -> None:
    axes = FIGURES["pressure-profile"](long_contact, times=[0.0]).axes[0]
    middle = long_contact["pressure"].isel(time=0, y=[15, 16]).mean("y")
    assert axes.get_ylabel() == "Pressure [MPa]"
    assert np.nanmax(axes.get_lines()[0].get_ydata()) == close_to(
        float(middle.max()) / 1e6, rel=1e-12
    )


def test_section_off_the_grid_is_refused(sphere: xr.Dataset) -> None:
    with pytest.raises(ValueError, match=r"at must lie on the grid.*got 1 m"):
        FIGURES["pressure-profile"](sphere, at=1.0)


def test_map_levels_cover_the_peak_and_start_at_zero(sphere: xr.Dataset) -> None:
    figure = FIGURES["pressure-map"](sphere)
    (bar,) = (axes for axes in figure.axes if axes.get_label() == "<colorbar>")
    low, high = bar.get_ylim()
    peak = float(sphere["pressure"].max()) / 1e6
    assert bar.get_ylabel() == "Pressure [MPa]"
    assert low == 0.0
    assert peak <= high <= 1.25 * peak


def test_long_contact_is_stretched_with_a_note(long_contact: xr.Dataset) -> None:
    axes = FIGURES["contact-outline"](long_contact).axes[0]
    assert axes.get_title(loc="right") == f"y stretched {axes.get_aspect():g}×"
    assert float(axes.get_aspect()) >= 10


def test_round_contact_is_drawn_in_its_true_shape(sphere: xr.Dataset) -> None:
    axes = FIGURES["contact-outline"](sphere).axes[0]
    assert axes.get_aspect() == 1.0
    assert axes.get_title(loc="right") == ""


def test_outlines_are_drawn_in_millimetres(long_contact: xr.Dataset) -> None:
    axes = FIGURES["contact-outline"](long_contact, times=[0.0]).axes[0]
    (patch,) = (patch for patch in axes.patches if isinstance(patch, PathPatch))
    (outline,) = rim_curves(take_snapshots(long_contact, [0.0], "figure")[0])
    assert axes.get_xlabel() == "x [mm]"
    np.testing.assert_allclose(patch.get_path().vertices, outline * 1e3, rtol=1e-12)


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


def test_headings_of_a_stress_section_lie_within_the_page_and_apart(
    long_contact: xr.Dataset,
) -> None:
    figure = FIGURES["stress-section"](long_contact, width="single")
    figure.draw_without_rendering()
    boxes = [
        text.get_window_extent() for text in figure.findobj(Text) if text.get_text()[:3] == "t ="
    ]
    assert len(boxes) == 2
    assert not boxes[0].overlaps(boxes[1])
    for box in boxes:
        assert box.x1 < figure.bbox.x1
        assert not any(box.overlaps(axes.bbox) for axes in figure.axes)


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


# --- against the exact solution ---------------------------------------------------------------


def test_radial_lines_are_the_hereditary_integral(sphere: xr.Dataset) -> None:
    """Table 1's Maxwell row, here by the trapezoidal rule, good to some 1e-4 of the peak."""
    above, below = FIGURES["pressure-radial"](sphere, times=[100.0]).axes
    exact, computed = above.get_lines()
    r = np.asarray(exact.get_xdata()) * readable_unit("m", sphere["x"].max()).factor
    expected = maxwell_pressure(r, 100.0) / 1e6
    assert np.abs(exact.get_ydata() - expected).max() < 3e-4 * expected.max()
    difference = below.get_lines()[0].get_ydata()
    assert np.abs(difference).max() < 0.03  # percent: the same trapezoidal rule
    assert np.max(computed.get_ydata()) == close_to(float(sphere["pressure"][2].max()) / 1e6)
    assert legend_texts(above) == ["100 s", "computed", "paraboloid (Lee–Radok)"]


def test_radial_difference_shows_an_error_of_one_percent(sphere: xr.Dataset) -> None:
    wrong = sphere.copy()
    wrong["pressure"] = sphere["pressure"] * 1.01
    _, below = FIGURES["pressure-radial"](wrong, times=[0.0]).axes
    r, difference = below.get_lines()[0].get_data()
    assert np.max(difference) == close_to(1.0, abs=0.01)
    # It is relative to the peak, Hertz's sqrt(1 - r²/a²) of it, and the cells at the edge are out.
    r = np.asarray(r) * readable_unit("m", sphere["x"].max()).factor
    radius, cell = float(sphere["contact_length"][0]) / 2, float(sphere["x"][1] - sphere["x"][0])
    assert difference == close_to(np.sqrt(1 - (r / radius) ** 2), abs=0.01)
    assert radius - 2.1 * cell < r.max() < radius - cell


def test_radial_without_closed_form_draws_the_computed_pressure_alone(
    sphere: xr.Dataset,
) -> None:
    case = sphere.attrs["case"].replace('"force": [50.0]', '"force": [50.0, 20.0]')
    unloading = sphere.assign_attrs(case=case.replace('"times": [0.0],', '"times": [0.0, 300.0],'))
    figure = FIGURES["pressure-radial"](unloading)
    assert len(figure.axes) == 1
    assert "computed" not in legend_texts(figure.axes[0])


def test_radial_figure_of_a_roller_is_refused(long_contact: xr.Dataset) -> None:
    with pytest.raises(ValueError, match=r"body of revolution, got a Roller"):
        FIGURES["pressure-radial"](long_contact)


def test_figures_that_need_the_case_are_refused_without_it(sphere: xr.Dataset) -> None:
    bare = sphere.drop_attrs()
    for name in ("creep", "pressure-radial"):
        with pytest.raises(ValueError, match=rf"{name}: .*no attribute 'case'"):
            FIGURES[name](bare)


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


# --- hysteresis, and time that is even or not -------------------------------------------------


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
