"""The stress below the largest pressure, in a report."""

from __future__ import annotations

import pytest

import viscontact as vc
from viscontact.notebook.html import written
from viscontact.report.stress_chapter import stress_chapter
from viscontact.results.peak_stress import peak_stress

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


def test_nothing_is_shown_without_fields_or_of_layers() -> None:
    without = vc.simulate(BALL, RUBBER, LOAD, GRID, [0.0], fields="none", errors=False)
    cover = vc.Layered([vc.Layer(5e-3, RUBBER)], base="rigid")
    layered = vc.simulate(BALL, cover, LOAD, GRID, [0.0], errors=False)
    assert [list(stress_chapter(each)) for each in (without, layered)] == [[], []]
