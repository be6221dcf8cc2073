"""Grids with borders of cells at given planes across x."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.transforms import fast_length
from viscontact.bodies.grid import Grid

#: Largest distance of a plane from a border of cells, in cells.
ON_BORDER = 1e-6

#: Cells with borders at all planes are shorter than wanted by these factors at most: where other
#: ones do, too, and where nothing else is possible.
SHORTER, SHORTEST = 1.5, 16.0


def is_border(grid: Grid, plane: float) -> bool:
    """True if a plane across x lies on a border of cells, in the grid or continued beyond it."""
    place = (plane - grid.centre[0] + grid.size[0] / 2) / grid.cell_size[0]
    return abs(place - round(place)) < ON_BORDER


def with_borders_at(grid: Grid, planes: Sequence[float], *, joined: int = 1) -> Grid:
    """Grid of as many cells, of which so many `joined` end at planes across x [m].

    Where none do, they end at the outermost planes. The centre moves by a part of a cell at most,
    and not at all between planes that are symmetric about it.
    """
    pairs = replace(grid, shape=(max(grid.shape[0] // joined, 1), grid.shape[1]))
    if all(is_border(pairs, plane) for plane in planes):
        return grid
    wanted = joined * grid.cell_size[0]
    outermost = [min(planes), max(planes)]
    lengths = _lengths_between(planes, wanted, SHORTER) or _lengths_between(
        outermost, wanted, SHORTER
    )
    # Half of the cells, before the centre, in joined ones.
    before, x = grid.shape[0] / (2 * joined), grid.centre[0]
    shifts = {length: _shift(outermost[0], x, length, before) for length in lengths}
    length = lengths[0]
    if abs(sum(outermost) / 2 - x) < ON_BORDER * wanted:
        kept = [each for each in lengths if abs(shifts[each]) < ON_BORDER * each]
        length = kept[0] if kept else length
        shifts |= dict.fromkeys(kept, 0.0)
    cell, shift = length / joined, shifts[length]
    size = grid.size[0] if cell == grid.cell_size[0] else cell * grid.shape[0]
    return replace(grid, size=(size, grid.size[1]), centre=(x + shift, grid.centre[1]))


def _shift(plane: float, centre: float, length: float, before: float) -> float:
    """Shortest way of the centre, after so many lengths, that brings a border to a plane [m]."""
    place = (plane - centre) / length + before
    return float((place - round(place)) * length)


def refined_to_borders(grid: Grid, planes: Sequence[float]) -> Grid:
    """Grid over about the same region in cells of up to the same length, with borders at planes."""
    if all(is_border(grid, plane) for plane in planes):
        return grid
    length = cell_length(planes, grid.cell_size[0])
    count = fast_length(int(np.ceil(grid.size[0] / length)))
    count += count % 2
    finer = replace(grid, shape=(count, grid.shape[1]), size=(count * length, grid.size[1]))
    return with_borders_at(finer, planes)


def cell_length(planes: Sequence[float], longest: float) -> float:
    """Length up to a longest one of which multiples lie between all planes [m]; or ValueError.

    >>> cell_length([-2.0, 2.0, 3.0], 0.3)
    0.25
    """
    found = _lengths_between(planes, longest, SHORTEST)
    short = [each for each in found if each <= longest * (1 + ON_BORDER)]
    if not short:
        texts = ", ".join(f"{place:.6g}" for place in sorted(set(planes)))
        raise ValueError(
            f"grid: no cells of a reasonable length have borders at all ends, x = {texts} m; move "
            "one of the ends a little, or give 'shape' and 'size' of a grid with borders there"
        )
    return max(short)


def _lengths_between(planes: Iterable[float], wanted: float, shorter: float) -> list[float]:
    """Lengths of which multiples lie between all planes, down to a part of a wanted one [m].

    The nearest ones come first; one that is shorter counts twice as far, as a grid of it is, too.
    """
    places = np.unique(np.array(list(planes)))
    ways = np.diff(places)
    ways = ways[ways > ON_BORDER * wanted]  # beyond rounding
    if not ways.size:
        return [wanted]
    least = float(ways.min())
    first = max(1, int(np.floor(least / wanted * (1 + ON_BORDER))))
    last = max(first + 1, int(np.ceil(shorter * least / wanted)))
    lengths = (least / number for number in range(max(first - 1, 1), last + 1))
    found = [length for length in lengths if _are_multiples(ways, length)]
    return sorted(found, key=lambda length: _distance(length / wanted))


def _distance(ratio: float) -> float:
    """Distance of a ratio of lengths from 1, twice as large below it."""
    return math.log(ratio) if ratio >= 1 else -2 * math.log(ratio)


def _are_multiples(ways: Floats, length: float) -> bool:
    numbers = ways / length
    return bool(np.abs(numbers - np.rint(numbers)).max() < ON_BORDER)
