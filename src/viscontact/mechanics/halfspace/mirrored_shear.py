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
from viscontact.mechanics.halfspace.shear_filter import (
    Entries,
    InPlane,
    PairFilter,
    Parts,
    inverse_of_mean,
    inverse_waves,
    keep,
    size_of,
)
from viscontact.mechanics.halfspace.shear_influence import ShearTables

#: True along x and along y if the component x is even there.
Evenness = tuple[bool, bool]


class MirroredShearFilter(PairFilter):
    """Filter on the quarter with positive coordinates; symbols at k = 0, 1, ... lengths."""

    # The sines of a sequence are the cosines of the same with alternating signs, in reverse: both
    # components are transformed at once. Along each axis one of them is even and one odd.

    def __init__(
        self,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        symbol: Entries,
        *,
        even: Evenness,
        **options: Any,
    ) -> None:
        odd = not even[0], not even[1]
        xx, xy, yy = symbol
        # Cosines of sines change the sign along each axis, sines of cosines along none: both
        # components have the same sign.
        sign = 1 if even[0] == even[1] else -1
        crossed = sign * _ordered(xy[1:-1, 1:-1], even)
        entries = _ordered(xx, even)[:-1, :-1], crossed, _ordered(yy, odd)[:-1, :-1]
        super().__init__(shape, lengths, entries, **options)
        self._signs = np.stack([_signs(shape, each) for each in (even, odd)])

    def apply(self, fields: Numbers) -> Numbers:
        """The pair of fields of another pair, in the precision of the filter."""
        (nx, ny), transforms = self.shape, self._transforms
        size = size_of(fields)
        padded = self._kept((2, *self._lengths), self._number)
        lines = padded[:, :nx]
        cells = lines[..., :ny]
        signs = self._signs if size == 1 else self._signs / np.float64(size)
        np.multiply(fields, signs, out=cells, casting="same_kind")
        lines[..., ny:] = 0
        keep(lines, transforms.cosine_forward(lines, 2))
        padded[:, nx:] = 0
        keep(padded, transforms.cosine_forward(padded, 1))
        self._multiply(padded)
        keep(padded, transforms.cosine_inverse(padded, 1))
        keep(lines, transforms.cosine_inverse(lines, 2))
        signs = self._signs if size == 1 else self._signs * self._number.type(size)
        return np.asarray(cells * signs)

    def _multiply(self, spectrum: Numbers) -> None:
        """Multiply the spectra of both components by the matrices."""
        xx, xy, yy = self._symbol
        x, y = spectrum
        # Waves that have cosines and sines are in reverse order in the other component.
        shared_x, shared_y = x[1:, 1:], y[:0:-1, :0:-1]
        along = self._kept((2, *xy.shape), self._number)
        along_x, along_y = (
            np.multiply(xy, each, out=into)
            for each, into in zip((shared_y, shared_x), along, strict=True)
        )
        x *= xx
        y *= yy
        shared_x += along_x
        shared_y += along_y


def _ordered(symbol: Numbers, even: Evenness) -> Numbers:
    """Entries in the order of the transforms: cosines upwards, sines downwards."""
    return np.ascontiguousarray(symbol[tuple(slice(None, None, 1 if e else -1) for e in even)])


def _signs(shape: tuple[int, int], even: Evenness) -> Numbers:
    """Signs that alternate along axes of odd sequences."""
    x, y = (
        np.ones(count, np.float32) if each else 1 - 2 * (np.arange(count, dtype=np.float32) % 2)
        for count, each in zip(shape, even, strict=True)
    )
    return np.outer(x, y)


def mirrored_shear_convolution(tables: ShearTables, even: Evenness, **options: Any) -> Parts:
    """Displacement per unit compliance [Pa m] on a quarter of the block of the tables."""
    nx, ny = tables.direct.shape
    lengths = fast_length(nx), fast_length(ny)
    direct, along_x = (_cosines(table, lengths) for table in (tables.direct, tables.along_x))
    cross, nothing = _sines(tables.cross, lengths), np.zeros(direct.shape)
    symbols = [(direct, nothing, direct), (along_x, cross, direct - along_x)]
    for each in tables.corrections:
        cross = _sines(each.cross, lengths)
        symbols += [(_cosines(each.along_x, lengths), cross, _cosines(each.along_y, lengths))]
    shape = nx // 2, ny // 2
    return Parts(
        *(MirroredShearFilter(shape, lengths, each, even=even, **options) for each in symbols)
    )


def mirrored_shear_preconditioner(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    kappa: float,
    even: Evenness,
    layers: InPlane | None = None,
    **options: Any,
) -> MirroredShearFilter:
    """Approximate inverse of the displacement of a quarter of a block, taken as a period [1/m]."""
    x, y = (
        np.pi * np.arange(count + 1) / (count * cell)
        for count, cell in zip(shape, cell_size, strict=True)
    )
    x, y = x[:, None], y[None, :]
    length: Floats = np.hypot(x, y)
    half, lost = inverse_waves(length, kappa, layers)
    safe = np.where(length > 0, length, 1.0)
    xx, yy = half * (1 - lost * (y / safe) ** 2), half * (1 - lost * (x / safe) ** 2)
    # Of waves exp(i (x + y)) it is + x y; that of products of sines or cosines changes the sign.
    xy = -lost * half * x * y / safe**2
    xx[0, 0] = yy[0, 0] = inverse_of_mean(half, lost)
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
