"""The stress below the largest pressure, in a report."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscontact as vc
from viscontact.drawing.svg.html import written
from viscontact.report.stress_chapter import stress_below, stress_chapter, stress_text
from viscontact.results.peak_stress import PeakStress, peak_stress

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

RUBBER = vc.Material(vc.Elastic(1e6), 0.45)
GRID = vc.Grid((24, 24), (2e-3, 2e-3))
BALL, LOAD = vc.Sphere(0.01), vc.step(0.1)


def test_report_states_the_von_mises_stress_with_its_depth() -> None:
    ds = vc.simulate(BALL, RUBBER, LOAD, GRID, [0.0])
    text = "".join(map(written, stress_chapter(ds)))
    assert f"{peak_stress(ds, 'von_mises').value / 1e3:.0f}" in text
    assert "at t = 0 s" in text
    assert "<img" in text


def test_report_names_the_plane_of_the_stress_if_it_is_not_that_of_the_drawing() -> None:
    found = PeakStress(1e6, 1e4, 0.0, 1e-4, "x")
    ds = vc.simulate(BALL, RUBBER, LOAD, GRID, [0.0], errors=False)
    assert "100 µm deep on the plane along x; the drawing is across" in stress_text(ds, found)
    assert stress_text(ds, replace(found, plane="")).endswith("100 µm deep.")


def test_nothing_is_shown_without_fields_or_of_layers_that_creep_differently() -> None:
    without = vc.simulate(BALL, RUBBER, LOAD, GRID, [0.0], fields="none", errors=False)
    creeping = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.45)
    cover = vc.Layered([vc.Layer(5e-4, RUBBER), vc.Layer(5e-4, creeping)], base="rigid")
    layered = vc.simulate(BALL, cover, LOAD, GRID, [0.0, 1.0], errors=False)
    assert [list(stress_chapter(each)) for each in (without, layered)] == [[], []]


def test_report_names_the_layer_of_the_stress() -> None:
    cover = vc.Layered([vc.Layer(1e-4, RUBBER), vc.Layer(5e-3, RUBBER)], base=RUBBER)
    text = {}
    for part, body in (("layer 2", cover), ("half-space", RUBBER)):
        ds = vc.simulate(BALL, body, LOAD, GRID, [0.0], errors=False)
        found = stress_below(ds)
        assert found is not None
        text[part] = stress_text(ds, found)
        assert part in text[part]
        assert "<img" in "".join(map(written, stress_chapter(ds)))
    assert "body of layers" in text["layer 2"]
    assert "layer" not in text["half-space"]
    assert stress_text(ds, replace(found, depth=0.0)).endswith("at the surface.")


def test_report_of_steady_traction_states_the_stress_at_the_largest_one() -> None:
    rubber = vc.Material(vc.Elastic(1e6), 0.5)
    cells = {"grid": vc.Grid((1, 60), (1.0, 6e-3), periodic=(True, False)), "friction": 0.5}
    rolled = vc.Paraboloid(np.inf, 0.01), rubber, vc.step(100.0, tilt_y=0.0), 0.1
    ds = vc.steady(*rolled, creepage=[0.05, 0.0, 0.001], **cells)
    found = stress_below(ds)
    assert found is not None
    assert "at 100 mm/s and a creepage of 5 %" in stress_text(ds, found)
    assert "drawing" not in stress_text(ds, replace(found, plane="y"))
    [gripped, free] = (peak_stress(ds.isel(creepage=[n]), "von_mises").value for n in (0, 1))
    assert found.value == gripped > 1.05 * free
