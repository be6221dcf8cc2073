"""Profiles, sections, maps and outlines draw the computed values in the unit of their labels."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.patches import PathPatch
from matplotlib.text import Text

from closeness import close_to
from drawing.matplotlib.drawn_runs import legend_texts, long_contact, sphere
from synthetic_results import maxwell_pressure
from viscontact.drawing.content.rim import rim_curves
from viscontact.plot import FIGURES
from viscontact.results.snapshots import take_snapshots
from viscontact.units.formatting import readable_unit

__all__ = ["long_contact", "sphere"]  # fixtures


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
