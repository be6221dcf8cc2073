"""Channels of the open gap: the components that lead from end to end, or close on themselves."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import numpy as np
import scipy

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass

#: "period": a channel closes on itself through the period; "pressure": from face to face.
Ends = Literal["period", "pressure"]


@dataclass(frozen=True)
class FlowAxis:
    """Direction of a flow on a grid, and what its ends are."""

    axis: int  # 0 along x, 1 along y
    ends: Ends
    periodic: tuple[bool, bool]  # of the grid, along x and y

    @property
    def joined(self) -> tuple[bool, bool]:
        """Axes along which a channel goes on into the next period."""
        along = self.ends == "period"
        joined = list(self.periodic)
        joined[self.axis] = along
        return joined[0], joined[1]


def channel(opened: Bools, flow: FlowAxis, *, corners: bool = False) -> Bools:
    """Cells of the components through which a fluid can flow along an axis.

    Cells are joined by edges, and by corners if these are to join them, too.

    >>> slot = np.array([[True, False], [True, True], [True, False]])
    >>> channel(slot, FlowAxis(0, "pressure", (False, False))).sum(), slot.sum()
    (np.int64(4), np.int64(4))
    """
    labels, count = scipy.ndimage.label(opened, np.ones((3, 3)) if corners else None)
    roots = _Windings(count + 1)
    for axis in (0, 1):
        if flow.joined[axis]:
            for low, high in _seams(labels, axis, (-1, 0, 1) if corners else (0,)):
                roots.join(high, low, axis)
    if flow.ends == "period":
        through = {root for root, way in roots.windings if way[flow.axis]}
        through = {roots.find(each)[0] for each in through}
    else:
        first, last = (np.take(labels, end, flow.axis) for end in (0, -1))
        begins, arrives = (
            {roots.find(each)[0] for each in np.unique(end[end > 0]).tolist()}
            for end in (first, last)
        )
        through = begins & arrives
    chosen = np.zeros(count + 1, dtype=bool)
    for label in range(1, count + 1) if through else ():
        chosen[label] = roots.find(label)[0] in through
    return np.asarray(chosen[labels])


def components(cells: Bools, joined: tuple[bool, bool]) -> tuple[Integers, int]:
    """Numbers of connected components, from 1, joined through the period; 0 elsewhere."""
    labels, count = scipy.ndimage.label(cells)
    roots = _Windings(count + 1)
    for axis in (0, 1):
        if joined[axis]:
            for low, high in _seams(labels, axis):
                roots.join(high, low, axis)
    found = np.array([roots.find(label)[0] for label in range(count + 1)])
    _, numbers = np.unique(found, return_inverse=True)
    return numbers[labels], int(numbers.max(initial=0))


def critical_constriction(gap: Floats, opened: Bools, flow: FlowAxis) -> tuple[float, int, int]:
    """Largest gap such that cells of this gap or more are a channel, and the cell that closes it.

    0 and the cell -1, -1 without a channel.
    """
    level = critical_gap(gap, opened, flow)
    if not level:
        return 0.0, -1, -1
    wider, narrowest = opened & (gap > level), np.argwhere(opened & (gap == level))
    closed, opens = 0, len(narrowest)  # with so many of the narrowest cells in addition
    while opens - closed > 1:
        middle = (closed + opens) // 2
        kept = wider.copy()
        kept[tuple(narrowest[:middle].T)] = True
        closed, opens = (closed, middle) if channel(kept, flow).any() else (middle, opens)
    i, j = narrowest[opens - 1].tolist()
    return level, i, j


def critical_gap(gap: Floats, opened: Bools, flow: FlowAxis, *, corners: bool = False) -> float:
    """Largest gap such that cells of this gap or more are a channel; 0 without one."""
    through = channel(opened, flow, corners=corners)
    if not through.any():
        return 0.0
    levels = np.unique(gap[through])
    low, high = 0, levels.size  # open at the level of `low`, closed at that of `high`
    while high - low > 1:
        middle = (low + high) // 2
        is_open = channel(through & (gap >= levels[middle]), flow, corners=corners).any()
        low, high = (middle, high) if is_open else (low, middle)
    return float(levels[low])


def critical_gap_error(gap: Floats, opened: Bools, flow: FlowAxis) -> float:
    """Error of the critical gap by the size of the cells.

    What channels through corners of cells add to it, and half of the largest change on every
    second cell along each axis.
    """
    found = critical_gap(gap, opened, flow)
    through_corners = critical_gap(gap, opened, flow, corners=True)
    steps = [2 if count > 1 else 1 for count in gap.shape]
    parts = [np.s_[i :: steps[0], j :: steps[1]] for i in range(steps[0]) for j in range(steps[1])]
    coarse = [critical_gap(gap[part], opened[part], flow) for part in parts]
    return through_corners - found + max(abs(each - found) for each in coarse) / 2


def _seams(labels: Integers, axis: int, shifts: Iterable[int] = (0,)) -> Iterable[tuple[int, int]]:
    """Pairs of components that touch through the period, on its first and its last line.

    A shift of one cell joins those that touch by corners.
    """
    first, last = np.take(labels, 0, axis), np.take(labels, -1, axis)
    found = []
    for shift in shifts:
        low, high = first[max(shift, 0) :], last[max(-shift, 0) :]
        low, high = low[: high.size], high[: low.size]
        both = (low > 0) & (high > 0)
        found.append(np.stack([low[both], high[both]], axis=1))
    pairs = np.unique(np.concatenate(found), axis=0)
    return [(int(low), int(high)) for low, high in pairs.tolist()]


class _Windings:
    """Union-find of components that carries how many periods apart they are (a winding vector)."""

    def __init__(self, count: int) -> None:
        self._parents = list(range(count))
        self._ways = [(0, 0)] * count  # from the root, in periods along x and y
        self.windings: list[tuple[int, tuple[int, int]]] = []  # closed ways, by a member

    def find(self, label: int) -> tuple[int, tuple[int, int]]:
        """Root of a component, and its way from there."""
        along = across = 0
        path = []
        while self._parents[label] != label:
            path.append(label)
            label = self._parents[label]
        for each in reversed(path):
            along, across = along + self._ways[each][0], across + self._ways[each][1]
            self._parents[each], self._ways[each] = label, (along, across)
        return label, (along, across)

    def join(self, one: int, other: int, axis: int) -> None:
        """Join a component with another that goes on from it in the next period of an axis."""
        step = (1, 0) if axis == 0 else (0, 1)
        (root, to_one), (new, to_other) = self.find(one), self.find(other)
        way = tuple(to_one[k] + step[k] - to_other[k] for k in (0, 1))
        if root == new:
            if any(way):
                self.windings.append((root, (way[0], way[1])))
            return
        self._parents[new], self._ways[new] = root, (way[0], way[1])
