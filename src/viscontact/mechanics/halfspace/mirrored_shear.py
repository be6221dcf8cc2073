"""Maps of traction to displacement of a contact that is even or odd across x = 0 and y = 0.

Where the component x is even along an axis, y is odd along it, and reversed. Only the cells with
positive coordinates are kept. Even sequences are transformed by cosines (DCT-II), odd ones by sines
(DST-II): an even kernel multiplies both by its own cosine transform, an odd one makes sines of
cosines by its sine transform, and of sines cosines with the opposite sign (S. A. Martucci, IEEE
Trans. Signal Process. 42 (1994) 1038).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy  # its transforms are imported at their first use

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.transforms import fast_length
from viscontact.mechanics.halfspace.shear_filter import Entries, PairFilter, Parts
from viscontact.mechanics.halfspace.shear_influence import ShearTables

#: True along x and along y if the component x is even there.
Evenness = tuple[bool, bool]


class MirroredShearFilter(PairFilter):
    """Filter on the quarter with positive coordinates; symbols at k = 0, 1, ... lengths."""

    def __init__(
        self,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        symbol: Entries,
        *,
        even: Evenness,
        **options: Any,
    ) -> None:
        super().__init__(shape, lengths, symbol, **options)
        self._even = even

    def apply(self, fields: Numbers) -> Numbers:
        """The pair of fields of another pair, in the precision of the filter."""
        size = float(np.abs(fields).max(initial=0.0)) or 1.0
        odd = (not self._even[0], not self._even[1])
        x, y = (
            self._spectrum(field, even, size)
            for field, even in zip(fields, (self._even, odd), strict=True)
        )
        xx, xy, yy = self._symbol
        # Cosines begin at k = 0, sines at k = 1; the symbols have both ends.
        of_x, of_y = (self._span(even) for even in (self._even, odd))
        shared_x, shared_y = (self._shared(even) for even in (self._even, odd))
        inner = (slice(1, -1), slice(1, -1))
        found_x, found_y = xx[of_x] * x, yy[of_y] * y
        # Cosines of sines change the sign along each axis, sines of cosines along none: both
        # components have the same sign.
        sign = self._number.type(1 if self._even[0] == self._even[1] else -1)
        crossed = sign * xy[inner]
        found_x[shared_x] += crossed * y[shared_y]
        found_y[shared_y] += crossed * x[shared_x]
        return np.stack([self._field(found_x, self._even, size), self._field(found_y, odd, size)])

    def _spectrum(self, field: Numbers, even: Evenness, size: float) -> Numbers:
        """Transform of a field over a size, padded."""
        nx, ny = self.shape
        along, across = self._lengths
        lines = np.zeros((nx, across), self._number)
        np.divide(field, size, out=lines[:, :ny], casting="same_kind")
        lines = self._forward(lines, 1, even[1])
        if along == nx:
            return self._forward(lines, 0, even[0])
        padded = np.zeros((along, across), self._number)
        padded[:nx] = lines
        return self._forward(padded, 0, even[0])

    def _field(self, spectrum: Numbers, even: Evenness, size: float) -> Numbers:
        """Field of a transform, times a size."""
        nx, ny = self.shape
        lines = np.ascontiguousarray(self._inverse(spectrum, 0, even[0])[:nx])
        return np.asarray(self._inverse(lines, 1, even[1])[:, :ny] * self._number.type(size))

    def _forward(self, field: Numbers, axis: int, even: bool) -> Numbers:
        transforms = self._transforms
        return (transforms.cosine_forward if even else transforms.sine_forward)(field, axis)

    def _inverse(self, spectrum: Numbers, axis: int, even: bool) -> Numbers:
        transforms = self._transforms
        return (transforms.cosine_inverse if even else transforms.sine_inverse)(spectrum, axis)

    @staticmethod
    def _span(even: Evenness) -> tuple[slice, slice]:
        """Part of a symbol that belongs to a spectrum."""
        along, across = (slice(0, -1) if each else slice(1, None) for each in even)
        return along, across

    @staticmethod
    def _shared(even: Evenness) -> tuple[slice, slice]:
        """Part of a spectrum that has both cosines and sines."""
        along, across = (slice(1, None) if each else slice(0, -1) for each in even)
        return along, across


def mirrored_shear_convolution(tables: ShearTables, even: Evenness, **options: Any) -> Parts:
    """Displacement per unit compliance [Pa m] on a quarter of the block of the tables."""
    nx, ny = tables.direct.shape
    lengths = fast_length(nx), fast_length(ny)
    direct, along_x = (_cosines(table, lengths) for table in (tables.direct, tables.along_x))
    cross, nothing = _sines(tables.cross, lengths), np.zeros(direct.shape)
    options |= {"even": even}
    return Parts(
        MirroredShearFilter((nx // 2, ny // 2), lengths, (direct, nothing, direct), **options),
        MirroredShearFilter(
            (nx // 2, ny // 2), lengths, (along_x, cross, direct - along_x), **options
        ),
    )


def mirrored_shear_preconditioner(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    kappa: float,
    even: Evenness,
    **options: Any,
) -> MirroredShearFilter:
    """Approximate inverse of the displacement of a quarter of a block, taken as a period [1/m]."""
    x, y = (
        np.pi * np.arange(count + 1) / (count * cell)
        for count, cell in zip(shape, cell_size, strict=True)
    )
    x, y = x[:, None], y[None, :]
    length: Floats = np.hypot(x, y)
    half = length / 2
    safe = np.where(length > 0, length, 1.0)
    lost = kappa / (1 + kappa)
    xx, yy = half * (1 - lost * (y / safe) ** 2), half * (1 - lost * (x / safe) ** 2)
    # Of waves exp(i (x + y)) it is + x y; that of products of sines or cosines changes the sign.
    xy = -lost * half * x * y / safe**2
    xx[0, 0] = yy[0, 0] = min(half[0, 1], half[1, 0]) / (1 + kappa)
    symbol = xx, xy, yy
    return MirroredShearFilter(shape, shape, symbol, even=even, single=True, **options)


def _cosines(table: Floats, lengths: tuple[int, int]) -> Floats:
    """Transform K_0 + 2 Σ K_j cos(π k j/M) along both axes, at k = 0, 1, ... M."""
    nx, ny = table.shape
    kernel = np.zeros((lengths[0] + 1, lengths[1] + 1))
    kernel[:nx, :ny] = table
    return np.asarray(scipy.fft.dctn(kernel, 1))


def _sines(table: Floats, lengths: tuple[int, int]) -> Floats:
    """Transform 2 Σ K_j sin(π k j/M) along both axes, at k = 0, 1, ... M."""
    nx, ny = table.shape
    kernel = np.zeros((lengths[0] - 1, lengths[1] - 1))
    kernel[: nx - 1, : ny - 1] = table[1:, 1:]
    found = np.zeros((lengths[0] + 1, lengths[1] + 1))
    found[1:-1, 1:-1] = scipy.fft.dstn(kernel, 1)
    return found
