"""Panels of small drawings, against laws and the panels of printed figures."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from viscontact.bodies.series_fits import fit_creep
from viscontact.drawing.content import series_fit, small_panels
from viscontact.drawing.content.panel import FIRST, Ink
from viscontact.drawing.content.small_panels import law_panels


@pytest.mark.parametrize(("ratio", "scale"), [(8.0, "linear"), (12.0, "log")])
def test_small_panels_of_a_fit_are_the_printed_ones_in_other_ranges(
    ratio: float, scale: str
) -> None:
    times, rise = np.geomspace(1e-3, 100.0, 60), (ratio - 1) * 1e-6
    fit = fit_creep(times, vc.CreepSeries(1e-6, [rise], [3.0])(times), data="deviatoric")
    (small,), (printed, _) = small_panels.fit_panels(fit), series_fit.fit_panels(fit)
    assert (small.y.scale, printed.y.scale) == (scale, scale)
    inks = [[curve.ink for curve in panel.curves] for panel in (small, printed)]
    assert (small.x.quantity, small.x.scale, printed.x.scale) == ("Time", "log", "log")
    assert inks[0] == [FIRST, Ink("fit")]
    np.testing.assert_array_equal(small.curves[0].y, printed.curves[0].y)
    line = small.curves[1]
    np.testing.assert_allclose(line.y, 1e-6 + rise * -np.expm1(-line.x / 3.0), rtol=1e-3)


def test_small_panels_of_a_flowing_law_go_over_decades_and_of_a_table_have_its_rows() -> None:
    (flows, relaxes) = law_panels(vc.Maxwell(1e6, 1e7))
    assert (flows.y.scale, flows.y.quantity, relaxes.y.quantity) == ("log", "Φ", "G")
    rows = vc.TabulatedCreep([0.0, 1.0, 10.0], [1e-6, 2e-6, 3e-6])
    (table,) = law_panels(rows, "layer 1")
    assert table.note == "layer 1"
    assert table.curves[1].y.tolist() == [1e-6, 2e-6, 3e-6]
    assert law_panels(vc.Elastic(1e9)) == []
