"""The figure of a sweep: the largest values of its runs over the varied keys."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import viscontact as vc
from closeness import close_to
from synthetic_sweeps import hertz_sweep, listed
from viscontact.drawing.content.key_axis import key_axis
from viscontact.drawing.content.look import RED
from viscontact.plot import pull_off, response
from viscontact.results.largest_values import chief_scalars, compared_scalars, largest_values
from viscontact.results.sweep_axes import varied_keys
from viscontact.studies.sweep.axes import coordinate

FORCES = ([1e3, 2e3, 8e3], "N")
RADII = ([0.02, 0.01], "m")


def panel(figure: Figure, label: str) -> Axes:
    [found] = [axes for axes in figure.axes if axes.get_ylabel().startswith(label)]
    return found


def test_curves_are_the_largest_values_over_time() -> None:
    axes = panel(response(hertz_sweep(load__force=FORCES, indenter__radius=RADII)), "Approach")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("Load force [kN]", "Approach [mm]")
    curves = [line for line in axes.lines if line.get_linestyle() != "None"]
    for radius, line in zip(sorted(RADII[0]), curves, strict=True):
        np.testing.assert_allclose(line.get_xdata(), [1, 2, 8])
        expected = 1e-3 * (np.array(FORCES[0]) ** 2 / radius) ** (1 / 3)
        np.testing.assert_allclose(line.get_ydata(), expected)
    [legend] = axes.figure.legends
    assert legend.get_title().get_text() == "Indenter radius"
    assert [text.get_text() for text in legend.get_texts()] == ["10 mm", "20 mm"]


def test_curve_is_in_the_order_of_the_values_and_breaks_at_a_run_without_a_result() -> None:
    ds = hertz_sweep(load__force=([4e3, 1e3, 8e3, 2e3], "N"))
    ds["state"][3] = "failed"
    ds["approach"][3] = np.nan
    figure = response(ds)
    curve, cross = panel(figure, "Approach").lines
    assert curve.get_xdata().tolist() == [1, 2, 4, 8]
    assert np.isnan(curve.get_ydata()).tolist() == [False, True, False, False]
    assert (cross.get_marker(), cross.get_xdata().tolist()) == ("x", [2])
    assert figure.get_suptitle() == (
        "Largest values over time, with error bars; ×: no result (1 run of 4)"
    )


def test_bars_are_the_errors() -> None:
    axes = panel(response(hertz_sweep(load__force=FORCES)), "Approach")
    [bars] = axes.collections
    heights = [float(np.ptp(path.vertices[:, 1])) for path in bars.get_paths()]
    np.testing.assert_allclose(heights, 0.2 * axes.lines[0].get_ydata())


def test_varied_force_and_equal_values_have_no_panel() -> None:
    ds = hertz_sweep(load__force=FORCES)
    assert compared_scalars(ds) == ["approach", "contact_area", "peak_pressure"]
    ds["contact_area"][:] = 1e-6
    assert compared_scalars(ds) == ["approach", "peak_pressure"]
    assert compared_scalars(hertz_sweep(indenter__radius=RADII))[0] == "approach"


def test_line_load_is_compared_where_one_contact_is_three_widths_long_along_x() -> None:
    ds = hertz_sweep(indenter__radius=([0.01, 0.02, 0.03], "m"))
    ds["peak_line_load"] = ds["force"]
    for lengths, widths, compared in (
        ([1.0, 3.0, 0.0], [1.0, 1.0, 0.0], True),
        ([1.0, 2.9, 1.0], [1.0, 1.0, 1.0], False),
        ([1.0, 1.0, 1.0], [1.0, 3.0, 1.0], False),  # long along y
        ([1.0, 1.0, 0.0], [1.0, 1.0, 0.0], False),  # without contact in one run
    ):
        for name, each in (("contact_length", lengths), ("contact_width", widths)):
            ds[name] = 0 * ds["force"] + 1e-3 * np.array(each)[:, None]
        assert ("peak_line_load" in chief_scalars(ds)) is compared


def test_allowable_value_is_a_line_and_what_exceeds_it_is_red() -> None:
    ds = hertz_sweep(load__force=FORCES)
    # Peaks of 10, 12.6 and 20 MPa with errors of a tenth: 18 MPa is the least of the last one.
    ds.attrs["allowable"] = '{"peak_pressure": {"limit": 17.9e6}}'
    axes = panel(response(ds), "Peak")
    _, beyond, level = axes.lines
    assert (beyond.get_xdata().tolist(), beyond.get_color()) == ([8.0], RED)
    np.testing.assert_allclose(level.get_ydata(), 17.9)
    assert [text.get_text() for text in axes.texts] == ["allowable 17.9 MPa"]


def test_large_grid_of_numbers_is_a_map() -> None:
    forces, radii = np.linspace(1e3, 9e3, 5), np.geomspace(0.05, 0.01, 6)
    ds = hertz_sweep(load__force=(forces, "N"), indenter__radius=(radii, "m"))
    ds["approach"][0, 0] = np.nan  # without a result
    figure = response(ds)
    [axes] = [each for each in figure.axes if each.get_ylabel().startswith("Load force")][:1]
    assert axes.get_xlabel() == "Indenter radius [mm]"
    x, y = axes.lines[0].get_data()
    assert len(x) == 29
    assert (50.0, 1.0) not in set(zip(np.round(x, 9), np.round(y, 9), strict=True))
    assert axes.get_title(loc="left") == "Approach [mm]"


def test_texts_are_drawn_as_points() -> None:
    ds = hertz_sweep(material=(["pmma", "nylon"], "1"), load__force=FORCES)
    axes = panel(response(ds.transpose("material", ...)), "Approach")
    assert axes.get_xlabel() == "Load force [kN]"
    only = ds.isel({"load.force": [0]})
    only["approach"][1] = 2 * only["approach"][0]
    axes = panel(response(only.squeeze("load.force", drop=True)), "Approach")
    assert [tick.get_text() for tick in axes.get_xticklabels()] == ["pmma", "nylon"]
    assert axes.lines[0].get_linestyle() == "None"


def test_listed_runs_have_a_column_of_points_for_each_key() -> None:
    ds = listed(hertz_sweep(load__force=FORCES, indenter__radius=RADII))
    assert varied_keys(ds) == ["load.force", "indenter.radius"]
    figure = response(ds)
    assert [axes.get_xlabel() for axes in figure.axes[-2:]] == [
        "Load force [kN]",
        "Indenter radius [mm]",
    ]
    over_radius = figure.axes[1].lines[0]
    np.testing.assert_allclose(over_radius.get_xdata(), [20, 10] * 3)
    np.testing.assert_allclose(over_radius.get_ydata(), 1e3 * ds.approach[:, 1])


def test_value_that_depends_on_the_mesh_is_hollow_and_on_no_curve() -> None:
    ds = hertz_sweep(load__force=FORCES)
    ds["peak_pressure_error"][1] = np.inf
    curve, marks, *_ = panel(response(ds), "Peak").lines
    assert marks.get_xdata().tolist() == [2.0]
    assert marks.get_markerfacecolor() == "white"
    assert np.isnan(curve.get_ydata()).tolist() == [False, True, False]


def test_largest_value_ignores_instants_without_one() -> None:
    ds = hertz_sweep(load__force=FORCES)
    ds["approach"][0, 1] = np.nan
    ds["approach"][1] = np.nan
    values, errors = largest_values(ds, "approach")
    np.testing.assert_array_equal(np.isnan(values), [False, True, False])
    assert float(values[0]) == float(ds.approach[0, 0])
    assert float(errors[0]) == float(ds.approach_error[0, 0])


def test_sweep_without_a_difference_is_refused() -> None:
    with pytest.raises(ValueError, match="no key is varied"):
        response(hertz_sweep(load__force=([1.0], "N")))
    ds = hertz_sweep(load__force=FORCES).isel(time=[0])
    for name in ("approach", "contact_area", "peak_pressure"):
        ds[name][:] = np.nan
    with pytest.raises(ValueError, match="no scalar differs"):
        vc.plot.response(ds)


def test_values_at_equal_ratios_have_a_logarithmic_axis_with_plain_numbers() -> None:
    figure = response(hertz_sweep(indenter__radius=([0.004, 0.012, 0.04], "m")))
    axes = panel(figure, "Approach")
    assert axes.get_xscale() == "log"
    figure.draw_without_rendering()
    low, high = axes.get_xlim()
    texts = [t.get_text() for t in axes.get_xticklabels() if low <= t.get_position()[0] <= high]
    assert texts == ["5", "10", "20"]
    assert (
        panel(response(hertz_sweep(load__force=([1, 5, 10], "N"))), "App").get_xscale() == "linear"
    )


def test_key_with_a_single_value_is_no_axis() -> None:
    ds = hertz_sweep(material=(["pmma"], "1"), load__force=FORCES, indenter__radius=([0.01], "m"))
    axes = panel(response(ds), "Approach")
    assert axes.get_xlabel() == "Load force [kN]"
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 1e3 * ds.approach[0, :, 0, 1])


@pytest.mark.parametrize(
    ("texts", "label", "places"),
    [
        (["20degC", "40 degC", "80degC"], "Temperature [°C]", [20.0, 40.0, 80.0]),
        (["5 mm", "50mm", "100 mm"], "Temperature [mm]", [5.0, 50.0, 100.0]),
        (["50 mm", "1 m"], "Temperature [m]", [0.05, 1.0]),  # of two units, the readable one
        (["1", "2"], "Temperature", [1.0, 2.0]),
    ],
)
def test_axis_of_a_key_has_the_unit_that_was_typed(
    texts: list[str], label: str, places: list[float]
) -> None:
    column = coordinate("temperature", "run", texts)
    axis = key_axis(xr.Dataset(coords={"temperature": column}), "temperature")
    assert axis.label == label
    assert axis.unit(column.values) == close_to(places, rel=1e-9)


def pulled_off(key: str, values: object) -> xr.Dataset:
    """Runs over a key, each of which was pulled off."""
    columns = {
        "state": ["done"] * 3,
        "pull_off_force": [2e-6, 3e-6, 5e-6],
        "pull_off_force_error": [1e-8, 2e-8, 3e-8],
    }
    columns = {name: (key, each) for name, each in columns.items()}
    return xr.Dataset(columns | {"name": (key, list("abc"))}, {key: values, "time": [0.0]})


def test_pull_off_is_drawn_with_its_errors_over_the_rate_in_the_sentences() -> None:
    rates = [f"retract at {rate} until contact is lost" for rate in ("1 um/s", "0.1um/s", "10um/s")]
    [axes] = pull_off(pulled_off("load.sentences[3]", rates)).axes
    assert axes.get_xlabel() == "Retract at [µm/s]"
    assert (axes.get_ylabel(), axes.get_xscale()) == ("Pull-off force [µN]", "log")
    assert axes.lines[0].get_xdata() == close_to([0.1, 1, 10])
    assert axes.lines[0].get_ydata() == close_to([3, 2, 5])
    [bars] = axes.collections
    heights = [float(np.ptp(path.vertices[:, 1])) for path in bars.get_paths()]
    assert heights == close_to([0.04, 0.02, 0.06])


def test_sweep_without_pull_off_has_no_figure_of_it() -> None:
    with pytest.raises(ValueError, match="pull-off: no pull-off force differs"):
        pull_off(hertz_sweep(load__force=FORCES))


@pytest.mark.parametrize(
    ("texts", "label", "numbers"),
    [
        (["hold for 1 s", "hold for 2 min", "hold for 1 h"], "Hold for [s]", [1, 120, 3600]),
        (
            ["hold force for 1 s", "hold force for 2 s", "hold force for 3 s"],
            "Hold force for [s]",
            [1, 2, 3],
        ),
        (["[12 s, -3 um]", "[21 s, -3 um]", "[30 s, -3 um]"], "Load points 4 [s]", [12, 21, 30]),
        (
            ["hold force for 1 s", "hold height for 1 s", "hold force for 2 s"],
            "Load points 4",
            None,
        ),
        (["step to 1 N", "step to 1 um", "step to 2 N"], "Load points 4", None),
        (["1 s in 2 s", "2 s in 3 s", "3 s in 4 s"], "Load points 4", None),
    ],
)
def test_texts_that_differ_in_one_quantity_are_drawn_over_it(texts, label, numbers) -> None:
    axes = pull_off(pulled_off("load.points[4]", texts)).axes[0]
    assert axes.get_xlabel() == label
    if numbers is not None:
        assert axes.lines[0].get_xdata() == close_to(numbers)
