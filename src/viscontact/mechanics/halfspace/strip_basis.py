"""Low-rank form of what the free faces of a body between two planes add, over rows of cells.

Waves along y that are short against the body's length feel each face alone (`free_end`), longer
ones both (`strip`). Those that are long against length and grid have a limit C/k, which displaces
the whole surface, or tilts it, by

    (C/π) ∫ cos(k y) exp(-k W)/k dk = -(C/2π) ln((y² + W²)/D²),

where the distance D is free, as the body has no datum.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.end_correction import (
    FIRST_WAVE,
    NODES,
    EndBasis,
    panels_of_rows,
    summed_squares,
)
from viscontact.mechanics.halfspace.filon import panel_nodes
from viscontact.mechanics.halfspace.free_end import HIGHEST, end_functions, pivoted_cholesky
from viscontact.mechanics.halfspace.log_panels import LogPanels
from viscontact.mechanics.halfspace.moving_load import MovingCompliance
from viscontact.mechanics.halfspace.strip import StripTable, strip_table

if TYPE_CHECKING:
    from viscontact.mechanics.halfspace.layer_end import LayerTable

#: Largest entry that a basis may leave out, relative to the largest one.
NEGLECTED = 1e-9

#: Displacement that is missed by all entries left out, and by waves and panels, as in
#: `end_correction`: twice the most that is found.
MISSED = 5e-5


@dataclass(frozen=True)
class StripRows:
    """Rows of cells between two planes across x, of which one or both are free of stress."""

    count: int
    free: tuple[bool, bool]  # at -x and at +x; otherwise a plane about which pressure is even
    even: bool = False  # pressures are even about the middle, also between two free faces
    stack: ElasticStack | None = None  # layers on a rigid base in place of a half-space

    @property
    def half_length(self) -> float:
        """Distance from a free face to the plane about which pressures are even or odd, in rows."""
        return self.count / sum(self.free)

    @property
    def kinds(self) -> tuple[bool, ...]:
        """Kinds of pressure about that plane: even, and between two free faces odd."""
        return (False, True) if all(self.free) and not self.even else (False,)

    def from_face(self, rows: range) -> tuple[Floats, Floats]:
        """Distances of rows from the nearer free face in whole rows, and their signs if odd."""
        first = np.arange(rows.start, rows.stop, dtype=np.float64)
        last = self.count - 1 - first
        if not all(self.free):
            return (first if self.free[0] else last), np.ones(len(rows))
        return np.minimum(first, last), np.sign(first - last)


@dataclass(frozen=True, eq=False)
class StripBasis(EndBasis):
    """Low-rank form of G in a strip, of which `products` are the part without exp(-k W) C/k."""

    limit: Floats  # C times the cell's length, shape (rank, rank) [1]
    half_length: float  # W [m]
    datum: float  # D [m]

    def at(self, places: Floats, edge: float) -> Floats:
        """Coefficients at offsets along y from cells of an edge [m]; (places, rank, rank)."""
        limit = np.multiply.outer(self._limit_means(places, edge), self.limit)
        return np.asarray(super().at(places, edge) - limit)

    def _limit_means(self, places: Floats, edge: float) -> Floats:
        """Integrals of ln((y² + W²)/D²)/2π over cells at offsets [m]."""
        edges, half = np.stack([places - edge / 2, places + edge / 2]), self.half_length
        along = edges / half
        # ∫ ln((y² + W²)/D²) dy / W over y/W.
        integral = along * (np.log((edges**2 + half**2) / self.datum**2) - 2)
        return np.asarray(half / (2 * np.pi) * np.diff(integral + 2 * np.arctan(along), axis=0)[0])

    def _passing(self, cells: int, edge: float, compliance: MovingCompliance) -> Floats:
        """Coefficients under a load that moves along y over material that passes once."""
        waves = panel_nodes(self.borders, NODES)[0]
        # The delay of a wave falls with its number, so that its part has a limit of its own.
        part = np.append(0.0, np.exp(-waves * self.half_length) / waves)
        delayed = self._moving_weights(cells, edge, compliance, compliance.relaxed) @ part
        means = self._limit_means(np.arange(cells, dtype=np.float64) * edge, edge)
        limit = delayed - compliance.relaxed * np.append(means[:0:-1], means)
        regular = super()._passing(cells, edge, compliance)
        return np.asarray(regular + np.multiply.outer(limit, self.limit))


def strip_error(poisson_ratio: float, *, odd: bool) -> float:
    """Part of the displacement that the operator of two ends may miss [-].

    Over the largest displacement by the ends or by the half-space.
    """
    return strip_table(poisson_ratio, odd=odd).error + MISSED


def strip_basis(
    poisson_ratio: float,
    strip: StripRows,
    rows: range,
    cell_size: tuple[float, float],
    width: float,
    *,
    odd: bool,
    longest: float = 0.0,
) -> StripBasis:
    """Low-rank form of what free faces add to even or odd pressures, for rows of a strip.

    `width` is the grid's size along y, at which the limit of long waves displaces nothing [m],
    `longest` a length on which the compliance of waves varies, under a moving load [m].
    """
    half_length = strip.half_length * cell_size[0]
    table = _table_of(poisson_ratio, strip.stack, half_length, odd=odd)
    distance, signs = strip.from_face(rows)
    signs = signs[:, None] if odd else np.ones((len(rows), 1))
    means = signs * cell_means(table.panels, distance, strip.half_length)
    highest = table.highest_wave / half_length
    borders = _borders(highest, max(half_length, width, longest), cell_size[0])
    waves, measures = panel_nodes(borders, NODES)
    # Waves before the first panel go as a - b ln k, whose mean is that at a wave number.
    waves, measures = np.append(borders[0] / np.e, waves), np.append(borders[0], measures)
    long = waves < highest
    of_table = table.weights(waves[long] * half_length)
    near = range(int(distance.min()), int(distance.max()) + 1)
    at_ends, short = _of_short_waves(poisson_ratio, near, (waves[~long] * cell_size[0]).tobytes())
    at_ends = signs * at_ends[distance.astype(int) - near.start]
    # All waves add up at y = 0, where the largest entries are left out.
    total = means @ np.tensordot(measures[long] @ of_table, table.entries, axes=1) @ means.T
    total += at_ends @ summed_squares(measures[~long], short) @ at_ends.T
    factors, _ = pivoted_cholesky(total.diagonal().copy(), lambda k: total[:, k], NEGLECTED)
    basis = np.linalg.qr(factors)[0]
    on_nodes, projected = basis.T @ means, (basis.T @ at_ends) @ short
    entries = on_nodes @ table.entries @ on_nodes.T
    products = [np.tensordot(of_table, entries, axes=1), projected @ projected.swapaxes(1, 2)]
    over_length = waves * half_length
    left_out = np.multiply.outer(np.exp(-over_length) / over_length, entries[-1])
    # An even pressure is half of the sum of the pressures in both halves of the body.
    scale = cell_size[0] / sum(strip.free)
    return StripBasis(
        basis,
        borders,
        scale * (np.concatenate(products) - left_out),
        scale / half_length * entries[-1],
        half_length,
        float(np.hypot(half_length, width)),
    )


@lru_cache(maxsize=1)  # even and odd pressures share them
def _of_short_waves(poisson_ratio: float, rows: range, waves: bytes) -> tuple[Floats, Floats]:
    """Weights of means over rows beside one end, and its functions at their nodes.

    Wave numbers count over the inverse of a row, as they are in memory.
    """
    panels, means = panels_of_rows(rows)
    places = np.multiply.outer(np.frombuffer(waves), panels.places)
    return means, end_functions(poisson_ratio).at(places)


def _table_of(
    poisson_ratio: float, stack: ElasticStack | None, half_length: float, *, odd: bool
) -> StripTable | LayerTable:
    """What two free faces add, of a half-space or of layers on a rigid base."""
    if stack is None:
        return strip_table(poisson_ratio, odd=odd)
    return layer_table_of(stack, half_length, odd=odd)


def layer_table_of(stack: ElasticStack, half_length: float, *, odd: bool) -> LayerTable:
    """What two free faces add to layers on a rigid base."""
    # The same for all grids: their cells add up to the length, to rounding.
    return halfspace.layer_end.layer_table(stack, float(f"{half_length:.10g}"), odd=odd)


def _borders(middle: float, width: float, edge: float) -> Floats:
    """Borders of panels of wave numbers, in powers of two about that of the longest lone one."""
    lowest, highest = FIRST_WAVE / width, 2 * HIGHEST / edge
    powers = np.arange(np.floor(np.log2(lowest / middle)), np.ceil(np.log2(highest / middle)) + 1)
    return np.asarray(middle * 2.0**powers)


def cell_means(panels: LogPanels, distance: Floats, half_length: float) -> Floats:
    """Weights of means over rows at distances from a face; the middle row may be half a row."""
    near, far = distance / half_length, np.minimum((distance + 1) / half_length, 1.0)
    between = panels.weights_until(far) - panels.weights_until(near)
    return np.asarray(between / (far - near)[:, None])
