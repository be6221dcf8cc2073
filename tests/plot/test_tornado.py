"""Tornado diagram: its bars against the table."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.patches import Rectangle

from viscontact.plot import tornado
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
