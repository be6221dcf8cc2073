"""Displacement by which free ends exceed the mirrored half-space, of the cells of a block.

A unit load at (x', 0) displaces a place (x, y) near a free end by

    G(x, x', y) = (1/π) ∫_0^∞ cos(k y) g(k x, k x') dk

per compliance, beyond the mirrored half-space (see `free_end`). Over the cells of a block, g is
taken as means over both cells along x, and over the loaded cell along y. Between two planes of
symmetry or free faces the load has images without end, all of which the face feels. G is a matrix
of low rank along x for all y together: the largest entries that a basis leaves out are those of
y = 0, where all waves add up. So the pressure is projected on the basis, each pair of basis
functions is convolved along y by padded transforms, and the result is expanded.
"""

from __future__ import annotations

import math
from dataclasses import field, replace

import numpy as np

from viscontact.backend.arrays import Complexes, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import (
    Transforms,
    fast_length,
    fastest_transforms,
    transforms_by,
)
from viscontact.mechanics.halfspace.filon import oscillation_weights, panel_nodes
from viscontact.mechanics.halfspace.free_end import (
    HIGHEST,
    end_functions,
    pivoted_cholesky,
)
from viscontact.mechanics.halfspace.log_panels import LogPanels
from viscontact.mechanics.halfspace.moving_load import MovingCompliance, moving_influence_table

#: Gauss nodes in each panel of wave numbers, which end at powers of two; the first panel begins at
#: this part of the inverse of the block's extent.
NODES, FIRST_WAVE = 8, 1e-3

#: First place of panels of the distance from the end, in rows, and ratio of the ends of a panel.
NEAREST, RATIO = 1e-3, 6.0

#: Largest entry of G that a basis may leave out, relative to the largest one.
NEGLECTED = 1e-8

#: Displacement that is missed by all entries left out, and by waves and panels, over the largest
#: one by the end or by the half-space: three times the most that is found on finer panels with
#: further functions, over Poisson's ratios, lengths and pressures.
MISSED = 1e-5


@dataclass(frozen=True, eq=False)
class EndBasis:
    """Low-rank form of G over rows of cells: g = basis · product · basis' at each wave number."""

    basis: Floats  # shape (rows, rank), orthonormal
    borders: Floats  # of panels of NODES wave numbers [1/m]
    #: Times the cell's length: mean below the first border, then at all nodes; shape (wave numbers,
    #: rank, rank) [m].
    products: Floats
    #: Coefficients at offsets along y of the most cells so far, by the length of a cell.
    _tables: dict[float, Floats] = field(default_factory=dict, init=False, repr=False)

    def table(self, cells: int, edge: float) -> Floats:
        """The same as `coefficients`, kept for blocks of fewer cells."""
        known = self._tables.get(edge)
        if known is None or len(known) < cells:
            known = self._tables[edge] = self.coefficients(cells, edge)
        return known[:cells]

    def coefficients(self, cells: int, edge: float) -> Floats:
        """Coefficients of pairs of basis functions at offsets of 0, 1, ... cells along y [m]."""
        return self.at(np.arange(cells, dtype=np.float64) * edge, edge)

    def at(self, places: Floats, edge: float) -> Floats:
        """Coefficients at offsets along y from cells of an edge [m]; (places, rank, rank)."""
        # The mean of cos(k y) over a cell is a difference of sin(k y)/k at its edges.
        edges, of_places = np.unique(
            np.concatenate([places - edge / 2, places + edge / 2]), return_inverse=True
        )
        waves = panel_nodes(self.borders, NODES)[0]
        sines = oscillation_weights(self.borders, NODES, edges).imag / waves
        begin, end = np.split(of_places, 2)
        before = np.full(len(places), self.borders[0] * edge)
        weights = np.column_stack([before, sines[end] - sines[begin]])
        return np.tensordot(weights / np.pi, self.products, axes=1)

    def moving_coefficients(self, cells: int, edge: float, compliance: MovingCompliance) -> Floats:
        """Coefficients under a load that moves along y, at offsets of 1 - cells to cells - 1."""
        passing, returning = compliance.split()
        found = self._passing(cells, edge, passing)
        if returning.lengths.size:
            found = found + self._returning(cells, edge, returning)
        return found

    def _passing(self, cells: int, edge: float, compliance: MovingCompliance) -> Floats:
        """The same of material that passes once."""
        weights = self._moving_weights(cells, edge, compliance, 0.0)
        return np.asarray(np.tensordot(weights, self.products, axes=1))

    def _returning(self, cells: int, edge: float, compliance: MovingCompliance) -> Floats:
        """The same of material that returns after periods, of compliance that is delayed only."""
        rank = self.products.shape[1]

        def pairs(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
            return self.at(along[:, 0], cell[0]).reshape(len(along), across.size)

        table = moving_influence_table((cells, rank**2), (edge, 1.0), compliance, 0, pairs)
        return table.reshape(-1, rank, rank)

    def _moving_weights(
        self, cells: int, edge: float, compliance: MovingCompliance, less: float
    ) -> Floats:
        """Weights of means at signed offsets, with the compliance of each wave but for a part."""
        edges = (np.arange(2 * cells, dtype=np.float64) - cells + 0.5) * edge
        waves = panel_nodes(self.borders, NODES)[0]
        factors = compliance.at_wave_number(waves) - less
        means = np.diff(oscillation_weights(self.borders, NODES, edges), axis=0)
        before = complex(compliance.at_wave_number(self.borders[:1] / math.e)[0]) - less
        whole = np.full(2 * cells - 1, self.borders[0] * edge * before.real)
        return np.column_stack([whole, (means * (factors / (1j * waves))).real]) / np.pi

    def turned(self) -> EndBasis:
        """The same with its rows in the opposite order."""
        return replace(self, basis=self.basis[::-1])


def ends_error(poisson_ratio: float) -> float:
    """Part of the displacement that the operator of a free end may miss [-].

    Over the largest displacement by the end or by the half-space.
    """
    functions = end_functions(poisson_ratio)
    return functions.asymmetry + functions.neglected + MISSED


def end_basis(
    poisson_ratio: float, rows: range, cell_size: tuple[float, float], longest: float = 0.0
) -> EndBasis:
    """Low-rank form of G of a free end, for rows of cells counted from it.

    `longest` is a length on which the compliance of waves varies, under a moving load [m].
    """
    functions = end_functions(poisson_ratio)
    edge = cell_size[0]
    lowest, highest = FIRST_WAVE / max(edge * rows.stop, longest), 2 * HIGHEST / edge
    borders = lowest * 2.0 ** np.arange(np.ceil(np.log2(highest / lowest)) + 1)
    waves, weights = panel_nodes(borders, NODES)
    # Waves before the first panel go as a - b ln k, whose mean is that at lowest/e.
    waves, weights = np.append(lowest / math.e, waves), np.append(lowest, weights)
    panels, means = panels_of_rows(rows)
    at_nodes = functions.at(np.multiply.outer(waves * edge, panels.places))
    # All waves add up at y = 0, where the largest entries are left out.
    total = summed_squares(weights, at_nodes) @ means.T
    diagonal = np.einsum("rn,nr->r", means, total)
    factors, _ = pivoted_cholesky(diagonal, lambda row: means @ total[:, row], NEGLECTED)
    basis = np.linalg.qr(factors)[0]
    projected = (basis.T @ means) @ at_nodes
    return EndBasis(basis, borders, edge * (projected @ projected.swapaxes(1, 2)))


def panels_of_rows(rows: range) -> tuple[LogPanels, Floats]:
    """Panels of the distance from the end, in rows, and weights of means over rows at their nodes.

    The weights have the shape (rows, nodes).
    """
    panels = LogPanels.over(NEAREST, float(rows.stop), RATIO)
    borders = np.arange(rows.start, rows.stop + 1, dtype=np.float64)
    return panels, np.diff(panels.weights_until(borders), axis=0)


def summed_squares(weights: Floats, functions: Floats) -> Floats:
    """Sum over wave numbers of φ φ' between nodes, of shape (wave numbers, nodes, functions)."""
    scaled = np.sqrt(weights)[:, None, None] * functions
    flat = np.moveaxis(scaled, 1, 0).reshape(functions.shape[1], -1)
    return np.asarray(flat @ flat.T)


class EndCorrection:
    """Displacement beyond the mirrored half-space near free ends, on a block of cells."""

    def __init__(
        self,
        near: EndBasis,
        rows: slice,
        columns: int,
        cell_size: tuple[float, float],
        *,
        mirrored: bool = False,
        single: bool = False,
        transforms: Transforms | None = None,
    ) -> None:
        """Take some rows of the basis and a number of columns, half of them if `mirrored`."""
        number = np.float32 if single else np.float64
        self._transforms = transforms or transforms_by(fastest_transforms())
        self._basis = np.ascontiguousarray(near.basis[rows], number)
        self._mirrored = mirrored
        self._length = fast_length(2 * columns - 1)
        table = near.table(columns, cell_size[1])
        waves, offsets = np.arange(self._length // 2 + 1), np.arange(columns)
        cosines = np.cos(2 * np.pi * np.outer(waves, offsets) / self._length)
        cosines[:, 1:] *= 2
        self._symbol = np.tensordot(cosines, table, axes=1).astype(number)

    def apply(self, pressure: Numbers) -> Numbers:
        """Displacement over compliance [Pa m] under a pressure [Pa]."""
        parts = self._basis.T @ pressure.astype(self._basis.dtype, copy=False)
        columns = parts.shape[1]
        if self._mirrored:
            parts = np.concatenate([parts[:, ::-1], parts], axis=1)
        waves = np.ascontiguousarray(padded_waves(parts, self._length, self._transforms).T)
        reals = waves.view(self._basis.dtype).reshape(*waves.shape, 2)
        moved = np.ascontiguousarray(self._symbol @ reals).view(waves.dtype)[..., 0]
        found = of_waves(moved.T, self._length, self._transforms)
        start = columns if self._mirrored else 0
        return np.asarray(self._basis @ found[:, start : start + columns])


class MovingEndCorrection:
    """Displacement beyond the mirrored half-space under a load that moves along y, on a block."""

    def __init__(
        self,
        near: EndBasis,
        rows: slice,
        columns: int,
        edge: float,
        compliance: MovingCompliance,
        *,
        single: bool = False,
        transforms: Transforms | None = None,
    ) -> None:
        """Take some rows of the basis and a number of columns of an edge along y [m]."""
        number = np.float32 if single else np.float64
        self._transforms = transforms or transforms_by(fastest_transforms())
        self._basis = np.ascontiguousarray(near.basis[rows], number)
        self._length = fast_length(2 * columns - 1)
        table = near.moving_coefficients(columns, edge, compliance)
        kernel = np.zeros((self._length, *table.shape[1:]))
        kernel[:columns] = table[columns - 1 :]
        kernel[self._length - columns + 1 :] = table[: columns - 1]
        flat = kernel.reshape(self._length, -1).T
        symbol = padded_waves(np.ascontiguousarray(flat), self._length, self._transforms)
        self._symbol = symbol.T.reshape(-1, *table.shape[1:]).astype(
            np.result_type(number, np.complex64)
        )

    def apply(self, pressure: Numbers) -> Numbers:
        """Displacement [m] times the scale of the compliance, under a pressure [Pa]."""
        parts = self._basis.T @ pressure.astype(self._basis.dtype, copy=False)
        waves = padded_waves(parts, self._length, self._transforms).T
        moved = (self._symbol @ waves[..., None])[..., 0]
        found = of_waves(moved.T, self._length, self._transforms)
        return np.asarray(self._basis @ found[:, : parts.shape[1]])


def padded_waves(parts: Numbers, length: int, transforms: Transforms) -> Complexes:
    """Fourier transforms of lines that are padded to a length; shape (lines, waves)."""
    padded = np.zeros((len(parts), length), parts.dtype)
    padded[:, : parts.shape[1]] = parts
    kind = np.result_type(parts.dtype, np.complex64)
    spectrum = np.empty((len(parts), length // 2 + 1), kind)
    return np.asarray(transforms.real_forward(padded, spectrum, 1))


def of_waves(waves: Complexes, length: int, transforms: Transforms) -> Numbers:
    """Lines of a length of their Fourier transforms; shape (lines, length)."""
    lines = np.empty((len(waves), length), waves.real.dtype)
    return transforms.real_inverse(np.ascontiguousarray(waves), lines, 1)
