"""Displacement that free ends add under contacts that repeat along them, with a period l in y.

The pressure is a sum of the waves k = 2πm/l, of which each has the operator of a body that goes on
along y (`free_end`, `strip`), and of the mean along y, k = 0, which has that of plane strain
(`plane_corner`, `plane_strip`). A wave of cells of a length dy contains the waves k + 2πq/dy, too,
as a pressure that is uniform over each cell, with the factors sin(k dy/2)/(k dy/2).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import Field, Transforms
from viscontact.mechanics.halfspace.end_correction import NODES, EndBasis, EndCorrection, end_basis
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.free_end import pivoted_cholesky
from viscontact.mechanics.halfspace.log_panels import LogPanels
from viscontact.mechanics.halfspace.plane_corner import added_by_end
from viscontact.mechanics.halfspace.plane_strip import plane_strip
from viscontact.mechanics.halfspace.spectral import PeriodicConvolution
from viscontact.mechanics.halfspace.strip import surface_panels
from viscontact.mechanics.halfspace.strip_basis import (
    StripBasis,
    StripRows,
    cell_means,
    strip_basis,
)

#: Largest entry that the operator of k = 0 may leave out, relative to the largest one.
NEGLECTED = 1e-10

#: First place of panels beside one end, in cells, ratio of the ends of a panel, and datum of a line
#: load in lengths of the rows.
NEAREST, RATIO, DATUM = 1e-7, 5.0, 4.0


@dataclass(frozen=True, eq=False)
class PeriodicBasis:
    """Low-rank form of G on rows of cells, wave by wave of a period along y."""

    basis: Floats  # shape (rows, rank), orthonormal
    symbols: Floats  # of waves 0, 1, ... of the period, shape (waves, rank, rank) [m]

    def turned(self) -> PeriodicBasis:
        """The same with its rows in the opposite order."""
        return PeriodicBasis(self.basis[::-1], self.symbols)


def bases_of_period(
    response: EndedResponse,
    rows: range,
    borders: tuple[int | None, int | None],
    cell_size: tuple[float, float],
    columns: int,
) -> tuple[PeriodicBasis, ...]:
    """What free ends at borders of rows of a domain add on some of its rows."""
    before, after = borders
    poisson_ratio, free = response.poisson_ratio, response.free
    if not rows or not any(free):
        return ()
    if before is not None and after is not None:
        strip = StripRows(after - before, free, response.even)
        inside = range(rows.start - before, rows.stop - before)
        shared = (poisson_ratio, strip, inside, cell_size, columns)
        return tuple(periodic_strip_basis(*shared, odd=odd) for odd in strip.kinds)
    if before is not None:
        inside = range(rows.start - before, rows.stop - before)
        return (periodic_end_basis(poisson_ratio, inside, cell_size, columns),)
    assert after is not None  # at least one plane is given
    inside = range(after - rows.stop, after - rows.start)
    return (periodic_end_basis(poisson_ratio, inside, cell_size, columns).turned(),)


def periodic_end_basis(
    poisson_ratio: float, rows: range, cell_size: tuple[float, float], columns: int
) -> PeriodicBasis:
    """What a free end adds to rows of cells counted from it, with a period of some columns."""
    period = columns * cell_size[1]
    mean = _mean_beside_end(rows)
    waves = end_basis(poisson_ratio, rows, cell_size, period) if columns > 1 else None
    return _joined(waves, mean, np.eye(mean.shape[1]), cell_size, columns)


def periodic_strip_basis(
    poisson_ratio: float,
    strip: StripRows,
    rows: range,
    cell_size: tuple[float, float],
    columns: int,
    *,
    odd: bool,
) -> PeriodicBasis:
    """What free faces add to even or odd pressures on rows of a strip, with a period."""
    factors, weights = _mean_in_strip(strip, rows, odd=odd)
    waves = None
    if columns > 1:
        width = columns * cell_size[1]
        waves = strip_basis(poisson_ratio, strip, rows, cell_size, width, odd=odd)
    return _joined(waves, factors, weights, cell_size, columns)


def _mean_beside_end(rows: range) -> Floats:
    """Factors of G at k = 0 over rows of unit length counted from a free end; (rows, rank)."""
    panels = LogPanels.over(NEAREST, float(rows.stop), RATIO)
    places, datum = panels.places, DATUM * rows.stop
    found, _ = pivoted_cholesky(
        added_by_end(places, places, datum),
        lambda node: added_by_end(places, places[node : node + 1], datum),
        NEGLECTED,
    )
    ends = panels.weights_until(np.arange(rows.start, rows.stop + 1, dtype=np.float64))
    return np.asarray(np.diff(ends, axis=0) @ found)


def _mean_in_strip(strip: StripRows, rows: range, *, odd: bool) -> tuple[Floats, Floats]:
    """Factors F and weights W of F W F', G at k = 0 over rows of a strip."""
    panels, table = surface_panels(), plane_strip(odd=odd)
    largest = float(np.abs(table.added).max())
    values, vectors = np.linalg.eigh(table.added)
    kept = np.abs(values) > NEGLECTED * largest
    distance, signs = strip.from_face(rows)
    means = cell_means(panels, distance, strip.half_length) @ vectors[:, kept]
    # An even pressure is half of the sum of the pressures in both halves of the body.
    weights = np.diag(values[kept]) / sum(strip.free)
    if not odd:
        return means, weights
    # A pressure that is linear along x bends the strip, and leaves its end plane: what the mirrored
    # half-plane adds by it is taken off.
    arm = np.arange(strip.count) - (strip.count - 1) / 2
    arm /= np.linalg.norm(arm)
    mirrored = PeriodicConvolution((2 * strip.count, 1), (1.0, 1.0))
    sunk = mirrored.apply(np.append(arm, arm[::-1])[:, None])[: strip.count, 0]
    inside = slice(rows.start, rows.stop)
    factors = np.column_stack([signs[:, None] * means, arm[inside], sunk[inside]])
    count = len(weights)
    whole = np.zeros((count + 2, count + 2))
    whole[:count, :count] = weights
    whole[count, count] = arm @ sunk
    whole[count, count + 1] = whole[count + 1, count] = -1.0
    return factors, whole


def _joined(
    waves: EndBasis | None,
    factors: Floats,
    weights: Floats,
    cell_size: tuple[float, float],
    columns: int,
) -> PeriodicBasis:
    """One basis of the waves of a period, and of the mean over it."""
    scale = np.linalg.norm(factors, axis=0)
    spanned = [factors / scale] if waves is None else [waves.basis, factors / scale]
    basis = np.linalg.qr(np.hstack(spanned))[0]
    symbols = np.zeros((columns // 2 + 1, basis.shape[1], basis.shape[1]))
    if waves is not None:
        turn = basis.T @ waves.basis
        symbols = turn @ _symbols(waves, cell_size[1], columns) @ turn.T
    own = basis.T @ factors
    symbols[0] += cell_size[0] * own @ weights @ own.T
    return PeriodicBasis(basis, symbols)


def _symbols(waves: EndBasis, edge: float, columns: int) -> Floats:
    """Sums over all waves but k = 0 that have the same values at the centres of the cells [m]."""
    borders = waves.borders
    longest = 2 * np.pi / (columns * edge)
    numbers = np.arange(1, math.floor(borders[-1] / longest) + 1)
    wave = longest * numbers
    factors = np.sinc(numbers / columns)
    panel = np.clip(np.searchsorted(borders, wave) - 1, 0, len(borders) - 2)
    inside = (2 * wave - borders[panel] - borders[panel + 1]) / np.diff(borders)[panel]
    values = legvander(inside, NODES - 1) @ np.linalg.inv(legvander(leggauss(NODES)[0], NODES - 1))
    count, nodes = columns // 2 + 1, len(waves.products)
    weights, limits = np.zeros((count, nodes)), np.zeros(count)
    # The first entry of the products stands for waves before the first border.
    places = 1 + panel[:, None] * NODES + np.arange(NODES)
    for own in (numbers % columns, -numbers % columns):
        known = own < count
        into = np.broadcast_to(own[known, None], (int(known.sum()), NODES))
        np.add.at(weights, (into, places[known]), factors[known, None] * values[known])
        if isinstance(waves, StripBasis):
            long = factors[known] * np.exp(-wave[known] * waves.half_length) / wave[known]
            np.add.at(limits, own[known], long)
    found = np.tensordot(weights, waves.products, axes=1)
    if isinstance(waves, StripBasis):
        found += np.multiply.outer(limits, waves.limit)
    return np.asarray(found)


class PeriodicEndCorrection(EndCorrection):
    """Displacement beyond the mirrored half-space near free ends, of all columns of a period."""

    def __init__(
        self,
        near: PeriodicBasis,
        rows: slice,
        columns: int,
        *,
        single: bool,
        transforms: Transforms,
    ) -> None:
        """Take some rows of the basis."""
        number = np.float32 if single else np.float64
        self._transforms = transforms
        self._basis = np.ascontiguousarray(near.basis[rows], number)
        self._mirrored, self._length = False, columns
        self._symbol = near.symbols.astype(number)


class MirroredPeriod:
    """Displacement between two planes of symmetry across x, with a period along y."""

    # The pressure with its image, on a grid that is periodic along both axes: half of the lines of
    # its transforms could be saved.

    def __init__(
        self, shape: tuple[int, int], cell_size: tuple[float, float], **options: Any
    ) -> None:
        """Take the rows between the planes."""
        rows, columns = shape
        self._rows = rows
        self._both = np.zeros((2 * rows, columns), np.float32 if options.get("single") else float)
        self._periodic = PeriodicConvolution((2 * rows, columns), cell_size, **options)

    def apply(self, pressure: Field) -> Field:
        """Displacement over compliance [Pa m] under a pressure [Pa]."""
        self._both[: self._rows], self._both[self._rows :] = pressure, pressure[::-1]
        return self._periodic.apply(self._both)[: self._rows]
