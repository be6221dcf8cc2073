"""Division of cells in which a formula is not smooth into patches of linear pressure.

Boxes are divided into quarters until the pressure is linear in each, or an edge cuts it in two. How
close that has to be depends on the distance to the middle of the cell, where the displacement is
wanted: a pressure without resultant and moment acts on the surface as the third power of size over
distance. Of a box that is close enough the mean and the slopes are found from smaller ones.
"""

from __future__ import annotations

from dataclasses import field

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.given_pressure.boxes import Boxes
from viscontact.runs.given_pressure.edge_cut import EDGES, cut
from viscontact.runs.given_pressure.patches import Patches, rectangle_edges, together

#: Most halvings of a cell.
HALVINGS = 20

#: Part of a misfit in a box, times its edge, that displaces the surface there, per 1/E*.
OF_MISFIT = 0.2

#: Misfit in a box, in tolerances over the square of its share of a cell, that its sums may leave.
OF_SUMS = 100.0


@dataclass(eq=False)
class Division:
    """Patches of cells as they are found."""

    size: Floats  # edges of a cell [m]
    cut_off: list[Patches] = field(default_factory=list)
    cell: list[Integers] = field(default_factory=list)  # of boxes that are patches
    place: list[Floats] = field(default_factory=list)  # their middles, in half edges of the cell
    parts: list[Floats] = field(default_factory=list)
    owner: list[Integers] = field(default_factory=list)  # the patch of each of the sums
    sums: list[Floats] = field(default_factory=list)  # ∫ p, ∫ p ξ, ∫ p η over those of a cell [Pa]
    lost: float = 0.0  # ∫ p that is not found, over the area of a cell [Pa]

    @property
    def count(self) -> int:
        """Boxes that are patches."""
        return sum(each.size for each in self.cell)

    def take(self, boxes: Boxes) -> Integers:
        """Take boxes as patches, whose pressures follow; return their numbers."""
        numbers = self.count + np.arange(boxes.cell.size)
        self.cell.append(boxes.cell)
        self.place.append(2 * boxes.place / self.size[:, None])
        self.parts.append(np.tile(boxes.parts[:, None], boxes.cell.size))
        return numbers

    def add_boxes(self, boxes: Boxes, owner: Integers) -> None:
        """Add the sums of boxes to their patches."""
        area = 1 / boxes.parts.prod()
        mean, *slopes = boxes.fit
        place = 2 * boxes.place / self.size[:, None]
        moments = mean * place + np.array(slopes) / (3 * boxes.parts[:, None])
        self.owner.append(owner)
        self.sums.append(area * np.concatenate([mean[None], moments]))

    def add_cut(self, patches: Patches, owner: Integers) -> None:
        """Add the sums of halves of cut boxes to their patches, or take them as patches (-1)."""
        edges = patches.edges.reshape(-1, EDGES, 4)
        for inside in (False, True):
            which = (owner >= 0) == inside
            some = Patches(
                edges[which].reshape(-1, 4),
                np.repeat(np.arange(which.sum()), EDGES),
                patches.cell[which],
                patches.pressure[which],
            )
            if inside:
                self.owner.append(owner[which])
                size = float(self.size[0]), float(self.size[1])
                self.sums.append(some.sums(size, [(0, 0), (1, 0), (0, 1)]))
            else:
                self.cut_off.append(some)

    def patches(self) -> Patches:
        """All patches, those of boxes with the means and slopes of their sums."""
        cell, owner = np.concatenate(self.cell), np.concatenate(self.owner)
        place, parts = np.concatenate(self.place, axis=1), np.concatenate(self.parts, axis=1)
        sums = np.concatenate(self.sums, axis=1)
        total, *moments = (np.bincount(owner, each, cell.size) for each in sums)
        mean = total * parts.prod(axis=0)
        slopes = 3 * parts**2 * parts.prod(axis=0) * (np.array(moments) - total * place)
        level = mean - (slopes * place).sum(axis=0)
        half = self.size[:, None] / 2
        pressure = np.concatenate([level[None], slopes / half]).T
        x, y = place * half
        edges = rectangle_edges(x, y, (half / parts).T)
        boxes = Patches(edges, np.repeat(np.arange(cell.size), 4), cell, pressure)
        return together([boxes, *self.cut_off])


def divide(boxes: Boxes, tolerance: float, most_boxes: int) -> tuple[Patches, float]:
    """Divide cells, one box each, to a tolerance on the displacement per 1/E* over an edge [Pa].

    With so many boxes at once at most, as a formula of noise would be divided everywhere. Also
    the sum of the pressures that are not found then, over the cells [Pa].
    """
    found, owner = Division(boxes.size), np.full(boxes.cell.size, -1)
    for halvings in range(HALVINGS + 1):
        last = halvings == HALVINGS or boxes.cell.size > most_boxes
        share, free = boxes.share, owner < 0
        allowed = tolerance / (OF_MISFIT * share * boxes.nearness**2)
        of_sums = OF_SUMS * tolerance / share**2
        close = ~free | last
        close[free] |= _is_linear(boxes.chosen(free), allowed[free])
        exact = (boxes.error_of_mean * share <= tolerance) & (boxes.misfit <= of_sums)
        if last:
            found.lost += float(boxes.error_of_mean[~exact].sum() / boxes.parts.prod())
            exact[:] = True
        left = np.flatnonzero(~(close & exact))
        is_cut, halves = cut(boxes.chosen(left), np.where(free, allowed, of_sums)[left])
        parted = left[is_cut]
        found.add_cut(halves, np.tile(owner[parted], 2))
        whole = np.ones(owner.size, dtype=bool)
        whole[parted] = False
        new = np.flatnonzero(close & free & whole)
        owner[new] = found.take(boxes.chosen(new))
        done = close & exact & whole
        found.add_boxes(boxes.chosen(done), owner[done])
        rest = whole & ~done
        if not rest.any():
            break
        boxes = boxes.chosen(rest).quarters()
        owner = np.tile(owner[rest], boxes.cell.size // int(rest.sum()))
    return found.patches(), found.lost


def _is_linear(boxes: Boxes, allowed: Floats) -> Bools:
    """True for boxes in which the pressure is linear to a misfit, along their sides, too."""
    found = boxes.misfit <= allowed
    within = boxes.chosen(found)
    found[found] = within.misfit_at_sides(within.linear) <= allowed[found]
    return found
