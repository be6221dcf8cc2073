"""Boxes that an edge crosses, across which the pressure jumps, cut along it into two patches.

The edge enters and leaves through two sides, where it is found by bisection, and is taken as the
chord between these places, moved by two thirds of its rise over it, as the area of a parabola asks.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.given_pressure.boxes import INSIDE, NODES, Boxes
from viscontact.runs.given_pressure.patches import CORNERS, Patches

#: Directions of the sides, from each corner to the next.
SIDES = np.array([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)])

#: Edges of each half of a box, some of no length.
EDGES = 5

#: Halvings of a side, and of the way across a chord.
HALVINGS, OF_RISE = 48, 30

#: Part of the jump between the corners that is left at the edge itself.
SUDDEN = 0.5

#: Largest rise of the edge over its chord, over the chord; and how far from a parabola it may be at
#: a quarter of it: in part of the rise, and of the chord.
FLAT, BENT, STRAIGHT = 0.05, 0.15, 1e-5

#: Weight of slopes against the samples, in a fit.
LEAST = 1e-9

#: Smallest slope of the chord to a side along which its end is moved.
STEEP = 0.1


@dataclass(frozen=True, eq=False)
class Edge:
    """Edges through boxes, each from where it leaves the upper side of the jump, around that."""

    level: Floats  # pressure between both sides of the jump [Pa]
    jump: Floats  # [Pa]
    upper: Bools  # corners on the upper side, shape (4, boxes)
    side: Integers  # numbers of the sides of its start and its end, shape (2, boxes)
    start: Floats  # places in the box, shape (2, boxes)
    end: Floats

    @property
    def length(self) -> Floats:
        """Length of the chord."""
        return np.asarray(np.hypot(*(self.end - self.start)))

    @property
    def outward(self) -> Floats:
        """Normal of the chord out of the upper side, shape (2, boxes)."""
        along, across = (self.end - self.start) / self.length
        return np.array([across, -along])

    def at(self, share: float, offset: Floats) -> Floats:
        """Places along the chord, moved outward by an offset, shape (2, boxes)."""
        return self.start + share * (self.end - self.start) + offset * self.outward

    def chosen(self, which: Bools) -> Edge:
        """Some of the edges."""
        return Edge(
            self.level[which],
            self.jump[which],
            self.upper[:, which],
            self.side[:, which],
            self.start[:, which],
            self.end[:, which],
        )


def cut(boxes: Boxes, tolerance: Floats) -> tuple[Bools, Patches]:
    """Cut boxes along edges to a tolerance on the misfit of each [Pa]; which, and their patches.

    The patches are twice as many, those of the upper sides first.
    """
    done = np.zeros(boxes.cell.size, dtype=bool)
    crossed, edge = _edges(boxes)
    index = np.flatnonzero(crossed)
    within, edge = _moved(boxes.chosen(index), edge, tolerance[index])
    index = index[within]
    inner, polygons = boxes.chosen(index), _polygons(edge)
    close, pressure = _pressures(inner, edge, tolerance[index])
    done[index[close]] = True
    return done, _patches(inner.chosen(close), polygons[:, close], pressure[:, :, close])


def _edges(boxes: Boxes) -> tuple[Bools, Edge]:
    """Boxes with a jump between corners that two sides show, and its edges."""
    corners = np.array([boxes.at(*np.full((2, 1), 0.0) + INSIDE * c[:, None]) for c in CORNERS])
    rising = np.sort(corners, axis=0)
    gaps = np.diff(rising, axis=0)
    largest, each = gaps.argmax(axis=0), np.arange(boxes.cell.size)
    level = (rising[largest, each] + rising[largest + 1, each]) / 2
    jump, upper = gaps[largest, each], corners > level
    following = np.roll(upper, -1, axis=0)
    starts, ends = upper & ~following, ~upper & following
    crossed = (starts.sum(axis=0) == 1) & (ends.sum(axis=0) == 1) & (jump > 0)
    side = np.array([starts.argmax(axis=0), ends.argmax(axis=0)])[:, crossed]
    inner, level, jump, upper = (
        boxes.chosen(crossed),
        level[crossed],
        jump[crossed],
        upper[:, crossed],
    )
    places, sudden = [], np.ones(jump.size, dtype=bool)
    for sides, from_upper in zip(side, (True, False), strict=True):
        ends_of_side = [INSIDE * CORNERS[(sides + k) % 4].T for k in (0, 1)]
        above, below = ends_of_side if from_upper else ends_of_side[::-1]
        place, leap = _jump_between(inner, level, above, below, HALVINGS)
        places.append(place)
        sudden &= leap > SUDDEN * jump
    crossed[crossed] = sudden
    return crossed, Edge(level, jump, upper, side, *places).chosen(sudden)


def _jump_between(
    boxes: Boxes, level: Floats, above: Floats, below: Floats, halvings: int
) -> tuple[Floats, Floats]:
    """Where the pressure falls below a level between two places in boxes, and by how much there."""
    for _ in range(halvings):
        middle = (above + below) / 2
        higher = boxes.at(*middle) > level
        above, below = np.where(higher, middle, above), np.where(higher, below, middle)
    return (above + below) / 2, np.abs(boxes.at(*above) - boxes.at(*below))


def _moved(boxes: Boxes, edge: Edge, tolerance: Floats) -> tuple[Bools, Edge]:
    """Edges that are close to parabolas over their chords, with chords of the same area."""
    most = FLAT * edge.length
    kept = (boxes.at(*edge.at(0.5, -most)) > edge.level) & (
        boxes.at(*edge.at(0.5, most)) <= edge.level
    )
    place, _ = _jump_between(boxes, edge.level, edge.at(0.5, -most), edge.at(0.5, most), OF_RISE)
    rise = ((place - edge.at(0.5, 0 * most)) * edge.outward).sum(axis=0)
    off = BENT * np.abs(rise) + STRAIGHT * edge.length
    for share in (0.25, 0.75):
        kept &= boxes.at(*edge.at(share, 0.75 * rise - off)) > edge.level
        kept &= boxes.at(*edge.at(share, 0.75 * rise + off)) <= edge.level
    kept &= np.abs(rise) * edge.jump <= tolerance
    ends = []
    for place, sides in zip((edge.start, edge.end), edge.side, strict=True):
        way = SIDES[sides].T
        slope = (way * edge.outward).sum(axis=0)
        steep = np.abs(slope) > STEEP
        moved = place + 2 / 3 * rise / np.where(steep, slope, 1.0) * way
        kept &= steep & (np.abs(moved) <= 1.0).all(axis=0)
        ends.append(moved)
    found = Edge(edge.level, edge.jump, edge.upper, edge.side, ends[0], ends[1])
    return kept, found.chosen(kept)


def _polygons(edge: Edge) -> Floats:
    """Five edges of the upper and the lower polygon, (2, boxes, 5, 4), some of no length."""
    found = np.zeros((2, edge.jump.size, EDGES, 4))
    for polygon, upper in zip(found, (True, False), strict=True):
        leaves, enters = (edge.start, edge.end) if upper else (edge.end, edge.start)
        for side in range(4):
            begins, goes_on = (edge.upper[(side + k) % 4] == upper for k in (0, 1))
            first, last = (CORNERS[(side + k) % 4][:, None] for k in (0, 1))
            ends = np.where(begins, first, enters), np.where(goes_on, last, leaves)
            polygon[:, side] = np.where(begins | goes_on, np.concatenate(ends), 0.0).T
        polygon[:, 4] = np.concatenate([leaves, enters]).T
    return found


def _pressures(boxes: Boxes, edge: Edge, tolerance: Floats) -> tuple[Bools, Floats]:
    """Linear pressures on both sides: which are close to the samples, and levels and slopes.

    Shape (2, 3, boxes), from the middle of the boxes and over half of their edges.
    """
    nodes = np.sort(np.concatenate([NODES, NODES / 2, [-INSIDE, INSIDE]]))
    along, across = (each.ravel()[:, None] for each in np.meshgrid(nodes, nodes))
    shape = (along.size, edge.jump.size)
    along, across = np.broadcast_to(along, shape), np.broadcast_to(across, shape)
    values = boxes.at(along, across)
    way = edge.end - edge.start
    left = way[0] * (across - edge.start[1]) - way[1] * (along - edge.start[0]) > 0
    terms = np.array([np.ones(shape), along, across])
    close, found = np.ones(edge.jump.size, dtype=bool), []
    for upper in (True, False):
        counts = ((left == upper) & ((values > edge.level) == upper)).astype(float)
        close &= counts.any(axis=0)
        square = np.einsum("akn,bkn,kn->nab", terms, terms, counts)
        # Few points in a line, or none, do not tell the slopes: then these are small.
        square += np.diag([0.0, LEAST, LEAST]) + ~counts.any(axis=0)[:, None, None] * np.eye(3)
        right = np.einsum("akn,kn,kn->na", terms, values, counts)
        fit = np.linalg.solve(square, right[..., None])[..., 0].T
        apart = np.abs(values - np.einsum("akn,an->kn", terms, fit)) * counts
        close &= apart.max(axis=0) <= tolerance
        found.append(fit)
    return close, np.array(found)


def _patches(boxes: Boxes, polygons: Floats, pressure: Floats) -> Patches:
    """Patches of the upper sides and those of the lower ones, of places and pressures in boxes."""
    place, half = boxes.place.T[:, None], boxes.half
    edges = np.tile(place, 2) + polygons * np.tile(half, 2)
    level, slopes = pressure[:, 0], pressure[:, 1:] / half[:, None]
    level = level - (slopes * boxes.place).sum(axis=1)
    whole = np.concatenate([level[:, None], slopes], axis=1)  # (2, 3, boxes)
    count = 2 * boxes.cell.size
    return Patches(
        edges.reshape(-1, 4),
        np.repeat(np.arange(count), EDGES),
        np.tile(boxes.cell, 2),
        np.moveaxis(whole, 1, 2).reshape(-1, 3),
    )
