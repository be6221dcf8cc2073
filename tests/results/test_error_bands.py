"""The errors that a result states are bands in figures, where they are known and can be seen.

The errors here are written down, not computed: what is drawn is compared with them.
"""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from closeness import close_to
from results.written_errors import PARTS, bare, directory, ds, singular, with_errors
from returned import some
from viscontact.plot import COMPARISONS, FIGURES

__all__ = ["bare", "directory", "ds", "singular"]  # fixtures


def panel(figure: Figure, label: str) -> Axes:
    [axes] = [axes for axes in figure.axes if axes.get_ylabel().startswith(label)]
    return axes


def bands(axes: Axes) -> list[np.ndarray]:
    """Corners of the bands, as drawn."""
    shaded = [each for each in axes.collections if isinstance(each, PolyCollection)]
    return [path.vertices for each in shaded for path in each.get_paths()]


@pytest.mark.parametrize(
    ("label", "name", "unit"),
    [
        ("Contact area", "contact_area", 1e-6),
        ("Approach", "approach", 1e-6),
        ("Peak", "peak_pressure", 1e3),
    ],
)
def test_band_ends_at_value_plus_and_minus_error(
    ds: xr.Dataset, label: str, name: str, unit: float
) -> None:
    axes = panel(FIGURES["history"](ds), label)
    [corners] = bands(axes)
    value, error, time = ds[name].values / unit, ds[f"{name}_error"].values / unit, ds.time.values
    for instant, middle, half_width in some(zip(time, value, error, strict=True)):
        at = corners[corners[:, 0] == instant, 1]
        assert at.min() == close_to(middle - half_width, rel=1e-12, abs=1e-15)
        assert at.max() == close_to(middle + half_width, rel=1e-12, abs=1e-15)


def test_band_is_interrupted_where_the_error_is_not_known(bare: xr.Dataset) -> None:
    error = 0.1 * bare.peak_pressure.values
    error[8:11] = np.nan
    axes = panel(FIGURES["history"](with_errors(bare, peak_pressure=error)), "Peak")
    spans = [(each[:, 0].min(), each[:, 0].max()) for each in bands(axes)]
    time = bare.time.values
    assert spans == [(time[0], time[7]), (time[11], time[-1])]


def test_panel_of_a_peak_that_depends_on_the_mesh_says_so_and_has_no_band(
    singular: xr.Dataset, ds: xr.Dataset
) -> None:
    figure = FIGURES["history"](singular)
    axes = panel(figure, "Peak")
    assert axes.get_title(loc="right") == "peak depends on the mesh"
    # Without contact its error is zero, which makes no band either.
    assert bands(axes) == []
    assert bands(panel(figure, "Approach"))
    assert panel(FIGURES["history"](ds), "Peak").get_title(loc="right") == ""
    both = COMPARISONS["history"]({"round": ds, "sharp": singular})
    said = "1 of 2 runs not drawn:\npeak depends on the mesh"
    assert panel(both, "Peak").get_title(loc="right") == said
    assert len(bands(panel(both, "Peak"))) == 1


@pytest.mark.slow
def test_peak_that_depends_on_the_mesh_has_no_curve(
    singular: xr.Dataset, ds: xr.Dataset, bare: xr.Dataset
) -> None:
    axes = panel(FIGURES["history"](singular), "Peak")
    assert [text.get_text() for text in axes.texts] == ["not drawn:\nsmaller cells give more"]
    assert axes.get_yticks().size == 0
    [line] = axes.get_lines()
    assert np.isnan(np.asarray(line.get_ydata(), dtype=float)).all()
    # The other run of a comparison is drawn, on an axis that fits it.
    axes = panel(COMPARISONS["history"]({"round": ds, "sharp": singular}), "Peak")
    first, second = (np.asarray(line.get_ydata(), dtype=float) for line in axes.get_lines())
    assert np.isfinite(first).all()
    assert np.isnan(second).all()
    assert first.max() <= axes.get_ylim()[1] < 2 * first.max()
    assert not axes.texts
    # Of a peak that depends on the mesh at some instants, the others are drawn.
    error = 0.1 * bare.peak_pressure.values
    error[4:7] = np.inf
    axes = panel(FIGURES["history"](with_errors(bare, peak_pressure=error)), "Peak")
    drawn = np.isfinite(np.asarray(axes.get_lines()[0].get_ydata(), dtype=float))
    assert drawn.tolist() == np.isfinite(error).tolist()
    assert axes.get_title(loc="right") == "peak depends on the mesh"
    assert not axes.texts


@pytest.mark.parametrize(
    "name",
    [
        "pressure-profile",
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("pressure-map", "pressure-radial")
        ),
    ],
)
def test_figures_of_pressure_say_that_the_peak_depends_on_the_mesh(
    name: str, singular: xr.Dataset, ds: xr.Dataset
) -> None:
    def said(results: xr.Dataset) -> bool:
        titles = [axes.get_title(loc="right") for axes in FIGURES[name](results).axes]
        return any("depends on the mesh" in title for title in titles)

    assert said(singular)
    assert not said(ds)


def test_map_without_a_largest_pressure_has_an_open_end(
    singular: xr.Dataset, ds: xr.Dataset
) -> None:
    tops = []
    for results in (singular, ds):
        figure = FIGURES["pressure-map"](results)
        figure.draw_without_rendering()
        [bar] = [axes for axes in figure.axes if axes.get_label() == "<colorbar>"]
        tops.append(bar.get_ylim()[1] * 1e3)
    peak = float(ds.pressure.max())
    assert tops[0] < peak <= tops[1]


def test_loop_has_its_error_along_the_approach(ds: xr.Dataset) -> None:
    [axes] = FIGURES["hysteresis"](ds).axes
    corners = np.concatenate(bands(axes))
    at = ds.sel(time=1.0)  # on the way up, where the loop passes once
    passed = corners[np.isclose(corners[:, 1], float(at.force), rtol=1e-9, atol=0), 0]
    low, high = (float(at.approach + sign * at.approach_error) * 1e6 for sign in (-1, 1))
    assert np.abs(passed - low).min() < 1e-9 * high
    assert np.abs(passed - high).min() < 1e-9 * high


@pytest.mark.parametrize("name", ["history", "hysteresis"])
def test_legend_names_the_band_once_where_there_is_one(
    name: str, ds: xr.Dataset, bare: xr.Dataset
) -> None:
    def legend(figure: Figure) -> list[str]:
        inside = [axes.get_legend() for axes in figure.axes]
        found = [each for each in (*figure.legends, *inside) if each is not None]
        return [text.get_text() for each in found for text in each.get_texts()]

    assert legend(FIGURES[name](ds)) == ["band: error estimate"]
    assert legend(FIGURES[name](bare)) == []
    both = COMPARISONS[name]({"one": ds, "other": bare})
    assert legend(both) == ["one", "other", "band: error estimate"]


@pytest.mark.parametrize(
    ("part", "area_part", "label"),
    [
        (1e-6, 1e-6, "error estimate within the line's width"),
        (1e-6, 0.1, "band: error estimate, where wider than the line"),
        (0.1, 0.1, "band: error estimate"),
    ],
)
def test_legend_names_bands_only_where_they_can_be_seen(
    part: float, area_part: float, label: str, bare: xr.Dataset
) -> None:
    parts = dict.fromkeys(PARTS, part) | {"force": 0.0, "contact_area": area_part}
    errors = {name: each * np.abs(bare[name].values) for name, each in parts.items()}
    [legend] = FIGURES["history"](with_errors(bare, **errors)).legends
    assert [text.get_text() for text in legend.get_texts()] == [label]


def test_figures_of_older_results_have_no_bands(bare: xr.Dataset) -> None:
    for name in ("history", "hysteresis"):
        assert not any(bands(axes) for axes in some(FIGURES[name](bare).axes))


def test_one_wild_error_does_not_flatten_the_curve(bare: xr.Dataset) -> None:
    error = np.zeros(bare.sizes["time"])
    error[5] = 1e3 * bare.approach.values.max()
    axes = panel(FIGURES["history"](with_errors(bare, approach=error)), "Approach")
    low, high = axes.get_ylim()
    assert np.ptp(bare.approach.values) * 1e6 > (high - low) / 4


def test_steady_value_is_not_drawn_as_rounding(bare: xr.Dataset) -> None:
    steady = bare.copy(deep=True)
    steady["peak_pressure"][:] = 36e6 * (1 + 1e-13 * np.arange(bare.sizes["time"]))
    low, high = panel(FIGURES["history"](steady), "Peak").get_ylim()
    assert low == 0.0
    assert high > 36
