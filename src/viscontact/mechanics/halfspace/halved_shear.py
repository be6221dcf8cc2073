"""Maps of traction to displacement of a contact that is mirrored across one axis.

Only the cells with positive coordinates along that axis are kept. Of the two components one is even
along it and one odd, so they are transformed by cosines and sines as in `mirrored_shear`; along the
other axis by Fourier transforms. The odd kernel makes sines of cosines, and of sines cosines with
the opposite sign, and its Fourier transform is imaginary: the matrix of each wave is Hermitian.
"""

from __future__ import annotations

from collections.abc import Sequence
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
    wrapped,
)
from viscontact.mechanics.halfspace.shear_influence import ShearTables


class HalvedShearFilter(PairFilter):
    """Filter on the half with positive coordinates along an axis; symbols at k = 0, 1, ... there.

    `even` is True if the component x is even along the axis.
    """

    # As in `mirrored_shear`, the sines of a sequence are the cosines of the same with alternating
    # signs, in reverse.

    def __init__(
        self,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        symbol: Entries,
        *,
        axis: int,
        even: bool,
        **options: Any,
    ) -> None:
        xx, xy, yy = symbol
        upwards, downwards = (part_along(axis, slice(None, None, step)) for step in (1, -1))
        ends, inside = part_along(axis, slice(-1)), part_along(axis, slice(1, -1))
        order_x, order_y = (upwards, downwards) if even else (downwards, upwards)
        # Of the component y to x; of x to y it has the opposite sign.
        crossed = (-1j if even else 1j) * xy[order_x][inside]
        entries = (
            np.ascontiguousarray(xx[order_x][ends]),
            np.ascontiguousarray(crossed),
            np.ascontiguousarray(yy[order_y][ends]),
        )
        super().__init__(shape, lengths, entries, **options)
        self._axis = axis
        turns = (1 - 2 * (np.arange(shape[axis], dtype=np.float32) % 2))[column(axis)]
        signs = (np.ones_like(turns), turns) if even else (turns, np.ones_like(turns))
        self._signs = np.stack(signs)

    def apply(self, fields: Numbers) -> Numbers:
        """The pair of fields of another pair, in the precision of the filter."""
        (nx, ny), transforms, axis = self.shape, self._transforms, self._axis
        other = 1 - axis
        size = size_of(fields)
        padded = self._kept((2, *self._lengths), self._number)
        lines = padded[(slice(None), *part_along(other, slice((nx, ny)[other])))]
        cells = lines[:, :nx, :ny]
        signs = self._signs if size == 1 else self._signs / np.float64(size)
        np.multiply(fields, signs, out=cells, casting="same_kind")
        lines[(slice(None), *part_along(axis, slice((nx, ny)[axis], None)))] = 0
        keep(lines, transforms.cosine_forward(lines, 1 + axis))
        padded[(slice(None), *part_along(other, slice((nx, ny)[other], None)))] = 0
        waves = list(self._lengths)
        waves[other] = waves[other] // 2 + 1
        kind = np.dtype(np.result_type(self._number, np.complex64))
        spectrum = self._kept((2, *waves), kind)
        keep(spectrum, transforms.real_forward(padded, spectrum, 1 + other))
        self._multiply(spectrum)
        keep(padded, transforms.real_inverse(spectrum, padded, 1 + other))
        keep(lines, transforms.cosine_inverse(lines, 1 + axis))
        return np.asarray(cells * (self._signs * self._number.type(size)))

    def _multiply(self, spectrum: Numbers) -> None:
        """Multiply the spectra of both components by the matrices."""
        xx, xy, yy = self._symbol
        x, y = spectrum
        shared_x = x[part_along(self._axis, slice(1, None))]
        # Waves that have cosines and sines are in reverse order in the other component.
        shared_y = y[part_along(self._axis, slice(None, 0, -1))]
        along_x, along_y = xy * shared_y, xy * shared_x
        x *= xx
        y *= yy
        shared_x += along_x
        shared_y -= along_y


def halved_shear_convolution(
    tables: ShearTables,
    periodic: tuple[bool, bool],
    axis: int,
    *,
    even: bool,
    **options: Any,
) -> Parts:
    """Displacement per unit compliance [Pa m] on the half of a block beyond a mirror plane."""
    counts = tables.direct.shape
    lengths = [
        count if repeats else fast_length(count if at == axis else 2 * count - 1)
        for at, (count, repeats) in enumerate(zip(counts, periodic, strict=True))
    ]
    padded = lengths[0], lengths[1]
    nx, ny = (count // 2 if at == axis else count for at, count in enumerate(counts))
    options |= {"axis": axis, "even": even}

    def spectrum(table: Floats, sign: int) -> Floats:
        return halved_spectrum(table, padded, axis, (sign, sign))

    direct, along_x = (spectrum(each, 1) for each in (tables.direct, tables.along_x))
    cross, nothing = spectrum(tables.cross, -1), np.zeros(direct.shape)
    symbols = [(direct, nothing, direct), (along_x, cross, direct - along_x)]
    for each in tables.corrections:
        cross = spectrum(each.cross, -1)
        symbols += [(spectrum(each.along_x, 1), cross, spectrum(each.along_y, 1))]
    return Parts(*(HalvedShearFilter((nx, ny), padded, each, **options) for each in symbols))


def halved_shear_preconditioner(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    kappa: float,
    axis: int,
    layers: InPlane | None = None,
    *,
    even: bool,
    **options: Any,
) -> HalvedShearFilter:
    """Approximate inverse of the displacement of half a block, taken as a period [1/m]."""
    other = 1 - axis
    count = shape[axis]
    mirrored = (np.pi * np.arange(count + 1) / (count * cell_size[axis]))[column(axis)]
    plain = 2 * np.pi * np.fft.rfftfreq(shape[other], cell_size[other])[column(other)]
    x, y = (mirrored, plain) if axis == 0 else (plain, mirrored)
    length: Floats = np.hypot(x, y)
    half, lost = inverse_waves(length, kappa, layers)
    safe = np.where(length > 0, length, 1.0)
    xx, yy = half * (1 - lost * (y / safe) ** 2), half * (1 - lost * (x / safe) ** 2)
    xy = lost * half * x * y / safe**2
    if shape[other] % 2 == 0:  # the shortest waves have no sign
        xy[part_along(other, slice(-1, None))] = 0.0
    xx[0, 0] = yy[0, 0] = inverse_of_mean(half, lost)
    options |= {"axis": axis, "even": even, "single": True}
    return HalvedShearFilter(shape, shape, (xx, xy, yy), **options)


def halved_spectrum(
    table: Floats, lengths: tuple[int, int], axis: int, signs: tuple[int, int]
) -> Floats:
    """Transform of a kernel that is even (1) or odd (-1) along each axis.

    Along the axis the cosines K_0 + 2 Σ K_j cos(π k j/M) at k = 0, 1, ... M, or the sines; along
    the other the Fourier transform, or its imaginary part.
    """
    other = 1 - axis
    found = np.fft.rfft(wrapped(table, other, lengths[other], signs[other]), axis=other)
    return mirrored_waves(
        found.real if signs[other] > 0 else found.imag, lengths, axis, signs[axis]
    )


def mirrored_waves(table: Floats, lengths: Sequence[int], axis: int, sign: int) -> Floats:
    """Cosines K_0 + 2 Σ K_j cos(π k j/M), or sines 2 Σ K_j sin(π k j/M), at k = 0, 1, ... M."""
    shape = list(table.shape)
    shape[axis] = lengths[axis] + 1
    kernel = np.zeros(shape)
    kernel[part_along(axis, slice(table.shape[axis]))] = table
    if sign > 0:
        return np.asarray(scipy.fft.dct(kernel, 1, axis=axis))
    inside = part_along(axis, slice(1, -1))
    found = np.zeros(shape)
    found[inside] = scipy.fft.dst(kernel[inside], 1, axis=axis)
    return found


def part_along(axis: int, part: slice) -> tuple[slice, slice]:
    """Index of a part of a field along an axis."""
    return (part, slice(None)) if axis == 0 else (slice(None), part)


def column(axis: int) -> tuple[Any, ...]:
    """Index that lays numbers along an axis of a field."""
    return (slice(None), None) if axis == 0 else (None, slice(None))
