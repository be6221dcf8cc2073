"""Interactive pressure maps: outlines around a few spots, and none over many."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from synthetic_results import maxwell_sphere, roller
from viscontact.drawing.content.map import Maps, maps_over
from viscontact.drawing.plotly.pressure_map import map_remarks, outlines, pressure_map

TIMES = (0.0, 1.0, 10.0, 100.0)


def with_spots(count: int) -> Maps:
    """A contact of count² spots of one cell each, at all instants."""
    ds = maxwell_sphere(TIMES, cells=64)
    pressure = np.zeros(ds["pressure"].shape)
    place = 4 + 12 * np.arange(count)
    pressure[:, place[:, None], place[None, :]] = 1e6
    ds["pressure"][:] = pressure
    ds["gap"][:] = np.where(pressure > 0, 0.0, 1e-6)
    return maps_over(ds)


@pytest.mark.parametrize(("count", "has_lines"), [(2, True), (5, False)])
def test_outlines_are_drawn_around_few_spots_and_not_over_many(count: int, has_lines: bool) -> None:
    fields = with_spots(count)
    figure = pressure_map(fields)
    assert len(figure.frames) == len(TIMES)
    for frame in figure.frames:
        assert (len(frame.data[1].x) > 0) is has_lines
        assert np.count_nonzero(np.nan_to_num(frame.data[0].z)) == count**2
    assert ("outline" in map_remarks(fields)) is has_lines
    # Of many spots only the first and the last outlines can be told from each other.
    names = [line.name for line in outlines(fields).data]
    assert names == (["0 s", "1 s", "10 s", "100 s"] if has_lines else ["0 s", "100 s"])


def test_a_high_map_is_not_widened_to_the_page() -> None:
    high = roller(times=TIMES).rename(x="y", y="x")
    high = high.assign(pressure=high["pressure"].transpose(..., "x", "y"))
    high["gap"] = high["gap"].transpose(..., "x", "y")
    for ds, constrained in ((roller(times=TIMES), "range"), (high, "domain")):
        assert pressure_map(maps_over(ds)).layout.xaxis.constrain == constrained


def test_each_frame_states_the_colours_of_its_own_and_those_of_all() -> None:
    ds = maxwell_sphere(TIMES, cells=64)
    figure = pressure_map(maps_over(ds))
    limits = [frame.layout.meta["limits"] for frame in figure.frames]
    peaks = ds["pressure"].max(("x", "y")).values
    heat = figure.data[0]
    for each, peak in zip(limits, peaks, strict=True):
        assert each["all"] == [heat.zmin, heat.zmax]
        assert each["each"] == close_to([0.0, peak / peaks.max() * heat.zmax], rel=1e-9)
    assert len({each["each"][1] for each in limits}) == len(TIMES)
