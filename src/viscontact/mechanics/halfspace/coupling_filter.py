"""Linear maps between traction along the surface and displacement into it, and reversed.

Traction to displacement into the half-space is B, pressure to displacement along the surface its
transpose B^T, as work is reciprocal. Kernels are odd along one axis: their spectra are imaginary.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.transforms import (
    Transforms,
    fast_length,
    fastest_transforms,
    transforms_by,
)
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.coupling_influence import CouplingTables, coupling_tables
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.halfspace.layered_shear_influence import layered_coupling
from viscontact.mechanics.halfspace.mirrored_coupling import MirroredCouplingFilter
from viscontact.mechanics.halfspace.shear_filter import (
    in_single,
    keep,
    odd_spectrum,
    wave_numbers,
)


class CouplingFilter:
    """Maps of a unit coupling c J = 1 on a block of cells [m], by Fourier transforms."""

    def __init__(
        self,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        symbol: tuple[Numbers, Numbers],
        transforms: Transforms | None = None,
        within: Callable[[tuple[int, int]], CouplingFilter] | None = None,
    ) -> None:
        #: Makes the same maps on a smaller block.
        self.within = within or (lambda shape: self)
        #: Spectra of X and Y over the imaginary unit: real at rest, as these kernels are odd.
        self.shape, self._lengths, self._symbol = shape, lengths, symbol
        self._transforms = transforms or transforms_by(fastest_transforms())
        self._number: np.dtype[Any] = np.dtype(np.float64)

    def in_single(self) -> CouplingFilter:
        """The same maps in single precision."""
        same = copy(self)
        same._number = np.dtype(np.float32)
        same._symbol = in_single(self._symbol[0]), in_single(self._symbol[1])
        return same

    def normal(self, traction: Floats) -> Floats:
        """Displacement into the surface under tractions along it [Pa m]."""
        x, y = spectra = self._spectra(traction)
        x *= self._symbol[0]
        y *= self._symbol[1]
        x += y
        x *= 1j
        return np.asarray(self._fields(spectra[:1])[0])

    def along(self, pressure: Floats) -> Floats:
        """Displacement along the surface under pressure [Pa m], (2, nx, ny)."""
        (spectrum,) = self._spectra(pressure[None])
        return self._fields(np.stack([-1j * own * spectrum for own in self._symbol]))

    def _spectra(self, fields: Floats) -> Numbers:
        """Spectra of padded fields."""
        (nx, ny), (along, across) = self.shape, self._lengths
        padded = np.zeros((len(fields), nx, across), self._number)
        padded[..., :ny] = fields
        kind = np.result_type(self._number, np.complex64)
        spectra = np.zeros((len(fields), along, across // 2 + 1), kind)
        lines = spectra[:, :nx]
        keep(lines, self._transforms.real_forward(padded, lines, 2))
        return self._transforms.complex_forward(spectra, 1)

    def _fields(self, spectra: Numbers) -> Floats:
        """Fields of spectra, without what was padded."""
        (nx, ny), across = self.shape, self._lengths[1]
        lines = self._transforms.complex_inverse(spectra, 1)[:, :nx]
        spare = np.empty((len(spectra), nx, across), self._number)
        lines = np.ascontiguousarray(lines)
        return np.asarray(self._transforms.real_inverse(lines, spare, 2)[..., :ny])


class CouplingSum:
    """Sum of maps, each of fields of its own."""

    def __init__(self, parts: Sequence[CouplingFilter | MirroredCouplingFilter]) -> None:
        self._parts = tuple(parts)

    def within(self, shape: tuple[int, int]) -> CouplingSum:
        """The same maps on a smaller block."""
        return CouplingSum([part.within(shape) for part in self._parts])

    def in_single(self) -> CouplingSum:
        """The same maps in single precision."""
        return CouplingSum([part.in_single() for part in self._parts])

    def change(self, tractions: Sequence[Floats]) -> Floats:
        """Displacement into the surface under small tractions, in units of the largest [Pa m]."""
        # In single precision, with its few exponents, fields are transformed at order one.
        size = max(float(np.abs(each).max()) for each in tractions)
        if size == 0:
            return np.zeros(tractions[0].shape[1:])
        return size * self.normal([each / size for each in tractions]).astype(np.float64)

    def normal(self, tractions: Sequence[Floats]) -> Floats:
        """Displacement into the surface under tractions along it [Pa m]."""
        pairs = list(zip(self._parts, tractions, strict=True))
        found = [part.normal(field) for part, field in pairs if field.any()]
        return np.asarray(sum(found[1:], start=found[0])) if found else 0 * tractions[0][0]

    def along(self, pressures: Sequence[Floats]) -> Floats:
        """Displacement along the surface under pressures [Pa m], (2, nx, ny)."""
        pairs = zip(self._parts, pressures, strict=True)
        found = [part.along(field) for part, field in pairs if field.any()]
        if not found:
            return np.zeros((2, *pressures[0].shape))
        return np.asarray(sum(found[1:], start=found[0]))


def coupling_filter(
    grid: Grid,
    transforms: Transforms | None = None,
    mirrored: tuple[bool, bool] = (False, False),
    layers: LayeredShear | None = None,
) -> CouplingFilter | MirroredCouplingFilter:
    """Maps on all cells of a grid, or on those with positive coordinates along mirrored axes.

    Those of layers are per unit compliance J of their surface, c included.
    """
    if all(grid.periodic):
        return _periodic_filter(grid, transforms, layers)
    tables = coupling_tables(grid) if layers is None else layered_coupling(grid, layers)
    periodic = grid.periodic[0], grid.periodic[1]
    if any(mirrored):
        return MirroredCouplingFilter(tables, mirrored, periodic, transforms)
    return block_filter(tables, periodic, transforms)


def block_filter(
    tables: CouplingTables, periodic: tuple[bool, bool], transforms: Transforms | None = None
) -> CouplingFilter:
    """Maps on the block of cells of the tables."""
    nx, ny = tables.along_x.shape
    lengths = (
        nx if periodic[0] else fast_length(2 * nx - 1),
        ny if periodic[1] else fast_length(2 * ny - 1),
    )
    symbol = (
        odd_spectrum(tables.along_x, lengths, (-1, 1)),
        odd_spectrum(tables.along_y, lengths, (1, -1)),
    )

    def within(block: tuple[int, int]) -> CouplingFilter:
        return block_filter(tables.within(block), periodic, transforms)

    return CouplingFilter((nx, ny), lengths, symbol, transforms, within)


def _periodic_filter(
    grid: Grid, transforms: Transforms | None, layers: LayeredShear | None
) -> CouplingFilter:
    """Maps of waves, periodic along both axes: -2 k/|k|² i."""
    shape = grid.shape
    x, y, length = wave_numbers(shape, grid.cell_size)
    length[0, 0] = np.inf
    symbol_x, symbol_y = -2 * x / length**2, -2 * y / length**2
    if layers is not None:
        length[0, 0] = 1.0
        waves, places = np.unique(length, return_inverse=True)
        ratio = layers.ratios(waves).coupling[places].reshape(length.shape)
        symbol_x, symbol_y = ratio * symbol_x, ratio * symbol_y
    # The shortest waves have no sign.
    if shape[0] % 2 == 0:
        symbol_x[shape[0] // 2] = 0.0
    if shape[1] % 2 == 0:
        symbol_y[:, shape[1] // 2] = 0.0
    return CouplingFilter(shape, shape, (symbol_x, symbol_y), transforms)
