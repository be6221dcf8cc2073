"""Tornado diagram: its bars against the table."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.patches import Rectangle

from closeness import close_to
from viscontact.plot import scatter_bands, tornado
from viscontact.report import write_sensitivity_report

KEYS = ["load.force", "indenter.radius", "material.poisson_ratio", "load.duration"]


@pytest.fixture
def table() -> xr.Dataset:
    """Two outputs of four inputs, one of which is not known."""
    values = np.array([[0.3, -0.7, 0.1, np.nan], [0.6, 0.2, -0.9, 0.0]])
    over = ("output", "input")
    return xr.Dataset(
        {
            "elasticity": (over, values),
            "elasticity_error": (over, np.full((2, 4), 0.05)),
            "derivative": (over, 1e6 * values),
            "derivative_error": (over, np.full((2, 4), 5e4)),
            "value": ("output", [60e6, 20e-6]),
            "value_error": ("output", [1e6, 1e-7]),
        },
        {
            **{"output": ["peak_pressure", "approach"], "input": KEYS},
            "input_text": ("input", ["1 kN", "5 mm", "0.38", "2 s"]),
        },
        {"notes": "1 of 9 runs failed"},
    )


def test_the_bars_are_the_elasticities_the_largest_on_top(table: xr.Dataset) -> None:
    first, second = tornado(table).axes
    labels = [text.get_text() for text in first.get_yticklabels()]
    assert labels == ["Indenter radius", "Load force", "Material poisson ratio"]
    bars = [each for each in first.patches if isinstance(each, Rectangle)]
    assert [each.get_width() for each in bars] == [-0.7, 0.3, 0.1]
    colours = [each.get_facecolor() for each in bars]
    assert colours[0] != colours[1] == colours[2]
    assert first.yaxis_inverted()
    assert len(second.patches) == 4
    none = tornado(table.assign(elasticity=table["elasticity"] * np.nan)).axes[0]
    assert [text.get_text() for text in none.get_yticklabels()] == [""]


@pytest.mark.slow
def test_the_report_states_each_elasticity_with_its_error(
    table: xr.Dataset, tmp_path: Path
) -> None:
    path = tmp_path / "page.html"
    write_sensitivity_report(table, path, title="Crown: sensitivity")
    page = path.read_text(encoding="utf-8")
    assert "<dd>60.0 ± 1.0 MPa</dd>" in page
    assert "<td>Indenter radius</td><td>5 mm</td><td>-0.700 ± 0.050</td>" in page
    assert "<td>Load duration</td><td>2 s</td><td>not known</td>" in page
    assert "1 of 9 runs failed" in page


def test_the_bands_are_the_percentiles_over_time(table: xr.Dataset, tmp_path: Path) -> None:
    times = np.array([0.0, 1.0, 10.0, 100.0, 1000.0])
    band = np.array([[1.0, 2.0, 3.0]]).T * np.array([[1e6], [2e6]])[:, :, None] * (1 + times)
    of_two, keys = ("output", "scattered"), ["load.force", "indenter.radius"]
    data = {"band": (("output", "percent", "time"), band)}
    data |= {"nominal": (("output", "time"), 1.1 * band[:, 1])}
    data |= {"percentile": (("output", "percent"), band[:, :, -1])}
    for name in ("first_order", "total_order"):
        for end, shift in (("", 0.0), ("_low", -0.1), ("_high", 0.1)):
            data |= {f"{name}{end}": (of_two, np.array([[0.7, 0.3], [0.2, 0.8]]) + shift)}
    data |= {"sample": (("output", "point"), np.ones((2, 128)))}
    coords = {"percent": [5.0, 50.0, 95.0], "time": times, "scattered": keys}
    coords |= {"distribution": ("scattered", ["0.9 kN to 1.1 kN", "4 mm to 6 mm, normal (95 %)"])}
    whole = table.merge(xr.Dataset(data, coords))
    first, _ = scatter_bands(whole).axes
    median, case = (line.get_ydata() for line in first.lines)
    assert median == close_to(band[0, 1] / 1e9)  # GPa
    assert case == close_to(1.1 * band[0, 1] / 1e9)
    edges = first.collections[0].get_paths()[0].vertices[:, 1]
    assert edges.min() == close_to(band[0, 0].min() / 1e9)
    assert edges.max() == close_to(band[0, 2].max() / 1e9)
    assert first.get_xscale() == "symlog"
    page = tmp_path / "page.html"
    write_sensitivity_report(whole, page, title="Crown: sensitivity")
    text = page.read_text(encoding="utf-8")
    assert "<td>Load force</td><td>0.9 kN to 1.1 kN</td><td>0.70 (0.60 to 0.80)</td>" in text
    assert "percentiles of 128 samples" in text
    with pytest.raises(ValueError, match="has no scatter over time"):
        scatter_bands(table)
