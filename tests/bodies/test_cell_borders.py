"""Grids whose cells end at planes across x."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from returned import some
from viscontact.bodies.cell_borders import (
    cell_length,
    is_border,
    refined_to_borders,
    with_borders_at,
)
from viscontact.bodies.grid import Grid

GRID = Grid((48, 20), (3.1, 1.0))


@pytest.mark.parametrize(
    "planes", [(-1.0, 1.0), (0.3,), (-0.7, 1.1), (-5.0, 5.0), (-1.0, -0.5, 0.5, 1.0), (7.0, 7.0)]
)
@pytest.mark.parametrize("joined", [1, 2])
def test_cells_end_at_all_planes(planes: tuple[float, ...], joined: int) -> None:
    found = with_borders_at(GRID, planes, joined=joined)
    assert found.shape == GRID.shape
    pairs = Grid((48 // joined, 20), found.size, centre=found.centre)
    for plane in some(planes):
        assert is_border(pairs, plane)
    if planes[0] == -planes[-1]:
        assert found.centre == (0.0, 0.0)
    assert 3.1 / 1.5 < found.size[0] < 1.2 * 3.1
    assert abs(found.centre[0]) <= joined * found.cell_size[0]


def test_a_grid_that_fits_is_kept_to_the_bit() -> None:
    fits = Grid((48, 20), (2.4, 1.0))
    assert with_borders_at(fits, (-1.0, 1.0)) == fits
    assert with_borders_at(fits, ()) is fits
    assert refined_to_borders(fits, (-1.0, 1.0)) is fits


def test_planes_that_no_multiples_separate_leave_the_outermost_ones_on_borders() -> None:
    planes = (-1.0, 0.5 * np.sqrt(2), 1.0)
    found = with_borders_at(GRID, planes)
    assert [is_border(found, plane) for plane in planes] == [True, False, True]
    with pytest.raises(ValueError, match=r"have borders at all ends, x = -1, 0\.707107, 1 m"):
        cell_length(planes, 0.1)


def test_cells_are_as_short_as_planes_at_many_distances_need() -> None:
    found = refined_to_borders(GRID, (-1.13, -1.0, 1.0, 1.13))
    assert found.cell_size[0] == close_to(0.01, rel=1e-9)
    assert all(is_border(found, plane) for plane in some((-1.13, -1.0, 1.0, 1.13)))
    assert found.size[0] > 3.09
