"""Matplotlib and Plotly draw the same panels of a run: labels, ranges, curves, bands, notes."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from synthetic_results import maxwell_sphere
from viscontact import plot
from viscontact.drawing.content.history import drawn_scalars, history_panel
from viscontact.figures.histories import histories
from viscontact.results.variables import SCALARS


def _run(*, singular: bool = False, swings: bool = False) -> xr.Dataset:
    times = [0.0, *np.geomspace(0.1, 300.0, 12)]
    run = maxwell_sphere(times, cells=8, fields=False)
    if swings:
        run["force"][:] = 10.0 + np.sin(np.arange(13.0))
    parts = {"approach": 0.05, "contact_area": 0.02, "peak_pressure": 0.1}
    errors = {f"{name}_error": part * np.abs(run[name]) for name, part in parts.items()}
    run = run.assign(errors)
    run["approach_error"][2] = np.nan
    if singular:
        run["peak_pressure_error"][:] = np.inf
    return run


RUNS = {
    "held": _run(),
    "singular": _run(singular=True),
    "swinging": _run(swings=True),
    "without errors": maxwell_sphere([0.0, 1.0, 2.0], cells=8, fields=False),
}


@pytest.mark.parametrize("name", RUNS)
def test_histories_are_the_same_in_matplotlib_and_plotly(name: str) -> None:
    run = RUNS[name]
    printed = plot.history(run).axes
    load, response = histories(run)
    shown = {each.layout.meta["title"]: each for each in (*load, *response)}
    # A page has the extent of the contact and a constant force too.
    beyond = {SCALARS[each].label for each in ("force", "contact_length", "contact_width")}
    labels = {axes.get_ylabel() for axes in printed}
    assert labels <= set(shown)
    assert {label.split(" [")[0] for label in set(shown) - labels} <= beyond
    for axes in printed:
        page = shown[axes.get_ylabel()]
        (line,) = [each for each in axes.get_lines() if each.get_linestyle() != ":"]
        curve, band = page.data[-1], page.data[-2]
        np.testing.assert_allclose(line.get_ydata(), curve.y, rtol=1e-6)
        is_drawn = not page.layout.annotations
        assert [text.get_text().replace("\n", " ") for text in axes.texts] == [
            each.text for each in page.layout.annotations
        ]
        if is_drawn:
            assert axes.get_ylim() == pytest.approx(page.layout.yaxis.range)
        assert axes.get_title(loc="right").removeprefix("peak ") == page.layout.meta["note"]
        shaded = np.concatenate([np.zeros((0, 2))] + [
            path.vertices for each in axes.collections for path in each.get_paths()
        ])  # fmt: skip
        known = np.asarray(band.y)[np.isfinite(band.y)]
        assert bool(known.size) == bool(shaded.size)
        if known.size:
            assert (shaded[:, 1].min(), shaded[:, 1].max()) == pytest.approx(
                (known.min(), known.max()), rel=1e-6
            )
        frames = [frame.name for frame in page.frames]
        assert (axes.get_xscale() == "symlog") == (page.layout.uirevision == "log")
        assert frames == (["linear", "log"] if axes.get_xscale() == "symlog" else frames)


def test_a_panel_is_the_same_alone_and_beside_others() -> None:
    run = RUNS["held"]
    for name in drawn_scalars({"": run}):
        alone = history_panel({"": run}, name)
        beside = history_panel({"one": run, "two": run}, name)
        assert alone.y == beside.y
        assert [curve.ink.place for curve in beside.curves] == [0, 1]
