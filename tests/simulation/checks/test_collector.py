"""Warnings of extents are stated again at the largest contact where it has grown much."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from viscontact.simulation.checks.collector import LargestExtents


def test_the_largest_contact_is_stated_if_it_is_much_larger_than_the_first_one() -> None:
    extents = LargestExtents()
    for area, time in ((1.0, 0.0), (1.1, 1.0), (4.0, 2.0), (2.0, 3.0)):
        extents = extents.after({"width": f"wide by {area}", "seam": "a seam"}, area, time)
    # A sentence that has not changed is not said twice.
    assert extents.at_end() == {
        "width at largest": "at the largest contact, at t = 2 s, wide by 4.0"
    }
    small = LargestExtents().after({"width": "wide by 1"}, 1.0, 0.0)
    assert small.after({"width": "wide by 1.1"}, 1.1, 1.0).at_end() == {}


def test_a_run_states_an_extent_when_it_is_exceeded_and_at_its_largest() -> None:
    rubber = vc.Material(vc.Elastic(1e6), 0.5)
    cover = vc.Layered([vc.Layer(1e-3, rubber)], base="rigid")
    run = (vc.Paraboloid(0.01, 0.01), cover, vc.ramp(10.0, 1.0))
    times = np.linspace(0.1, 1.0, 10)
    with pytest.warns(vc.AccuracyWarning):
        ds = vc.simulate(*run, vc.Grid((48, 48), (0.012, 0.012)), times, errors=False)
    said = [text for text in ds.attrs["warnings"].splitlines() if "approach is" in text]
    first, last = said
    largest = float(ds.approach.max()) / 1e-3
    assert last.startswith("at the largest contact, at t = 1 s, the approach is ")
    assert f"the approach is {largest:.2g} of the thickness" in last
    assert f"the approach is {largest:.2g} of the thickness" not in first
