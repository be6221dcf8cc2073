"""Linear maps of traction to displacement along the surface, and approximate inverses.

Both fields are pairs of components, of shape (2, nx, ny). In the spectrum a map is a symmetric
matrix (xx, xy, yy) of real numbers for each wave, as a kernel is even along both axes, or odd along
both.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from copy import copy
from typing import Any, Self

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.transforms import (
    Transforms,
    fast_length,
    fastest_transforms,
    transforms_by,
)
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.halfspace.shear_influence import ShearTables

#: Entries xx, xy and yy of a symmetric matrix.
Entries = tuple[Numbers, Numbers, Numbers]


#: Ratios of waves along and across their wave vector to those of a half-space under pressure.
InPlane = Callable[[Floats], tuple[Floats, Floats]]

#: Operators of different weights that are kept, besides one for each part.
MOST_SUMS = 2


class PairFilter(ABC):
    """Pairs of fields whose spectra are those of given pairs times a symmetric matrix."""

    def __init__(
        self,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        symbol: Entries,
        *,
        single: bool = False,
        transforms: Transforms | None = None,
    ) -> None:
        self.shape, self._lengths = shape, lengths
        self._transforms = transforms or transforms_by(fastest_transforms())
        self._number = np.dtype(np.float32 if single else np.float64)
        self._symbol = tuple(self._cast(part) for part in symbol)
        #: Arrays of transforms by shape and kind, made once: new memory costs more than they do.
        self._arrays: dict[tuple[tuple[int, ...], np.dtype[Any]], Numbers] = {}

    def _kept(self, shape: tuple[int, ...], kind: np.dtype[Any]) -> Numbers:
        """Array of this filter, of any content."""
        if (shape, kind) not in self._arrays:
            self._arrays[shape, kind] = np.empty(shape, kind)
        return self._arrays[shape, kind]

    @abstractmethod
    def apply(self, fields: Numbers) -> Numbers:
        """The pair of fields of another pair, in the precision of the filter."""

    def sum_of(self, parts: Sequence[Self], weights: Sequence[float]) -> Self:
        """Weighted sum of filters on the same block, in the precision of this one."""
        total = copy(self)
        pairs = list(zip(weights, parts, strict=True))
        total._symbol = tuple(
            self._cast(np.asarray(sum(weight * part._symbol[entry] for weight, part in pairs)))
            for entry in range(3)
        )
        return total

    def in_single(self) -> Self:
        """The same filter in single precision."""
        same = copy(self)
        same._number = np.dtype(np.float32)
        same._symbol = tuple(same._cast(part) for part in self._symbol)
        return same

    def _cast(self, part: Numbers) -> Numbers:
        """Real or complex numbers in the precision of this filter."""
        is_complex = np.iscomplexobj(part)
        kind = np.result_type(self._number, np.complex64) if is_complex else self._number
        return part.astype(kind)


class ShearFilter(PairFilter):
    """Filter on a whole block of cells, by Fourier transforms."""

    def apply(self, fields: Numbers) -> Numbers:
        """The pair of fields of another pair, in the precision of the filter."""
        (nx, ny), transforms = self.shape, self._transforms
        along, across = self._lengths
        # In single precision, with its few exponents, fields are transformed at order one.
        size = size_of(fields)
        padded = self._kept((2, nx, across), self._number)
        np.divide(fields, size, out=padded[..., :ny], casting="same_kind")
        padded[..., ny:] = 0
        kind = np.dtype(np.result_type(self._number, np.complex64))
        spectrum = self._kept((2, along, across // 2 + 1), kind)
        lines = spectrum[:, :nx]
        keep(lines, transforms.real_forward(padded, lines, 2))
        spectrum[:, nx:] = 0
        keep(spectrum, transforms.complex_forward(spectrum, 1))
        xx, xy, yy = self._symbol
        x, y = spectrum
        along_x, along_y = xy * y, xy * x
        x *= xx
        x += along_x
        y *= yy
        y += along_y
        keep(spectrum, transforms.complex_inverse(spectrum, 1))
        found = transforms.real_inverse(lines, padded, 2)[..., :ny]
        return np.asarray(found * self._number.type(size))


def size_of(fields: Numbers) -> float:
    """Size that fields are transformed at order one by; those in single precision are so."""
    if fields.dtype == np.float32:
        return 1.0
    return float(np.abs(fields).max(initial=0.0)) or 1.0


def in_single(numbers: Numbers) -> Numbers:
    """Real or complex numbers in single precision."""
    return numbers.astype(np.complex64 if np.iscomplexobj(numbers) else np.float32)


def keep(array: Numbers, found: Numbers) -> None:
    """Write a transform to the array that it was made of, if it is not there."""
    if not np.may_share_memory(array, found):
        array[...] = found


def shear_convolution(tables: ShearTables, periodic: tuple[bool, bool], **options: Any) -> Parts:
    """Displacement per unit compliance [Pa m] on a block of cells, linear but along a period."""
    shape = tables.direct.shape
    nx, ny = (
        count if repeats else fast_length(2 * count - 1)
        for count, repeats in zip(shape, periodic, strict=True)
    )
    nothing = np.zeros((nx, ny // 2 + 1))
    direct = _spectrum(tables.direct, (nx, ny), 1)
    along_x = _spectrum(tables.along_x, (nx, ny), 1)
    cross = _spectrum(tables.cross, (nx, ny), -1)
    poisson = along_x, cross, direct - along_x
    corrections = [
        (
            _spectrum(each.along_x, (nx, ny), 1),
            _spectrum(each.cross, (nx, ny), -1),
            _spectrum(each.along_y, (nx, ny), 1),
        )
        for each in tables.corrections
    ]
    symbols = (direct, nothing, direct), poisson, *corrections
    return _parts((shape[0], shape[1]), (nx, ny), symbols, options)


def periodic_shear_convolution(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    layers: Sequence[LayeredShear] = (),
    **options: Any,
) -> Parts:
    """Displacement per unit compliance from the mean plane, of a load periodic along both axes.

    That of layers on a rigid base is from the surface without load.
    """
    # A wave of traction along its wave vector moves the surface by 2/|k|, across it by 1 + κ times
    # as much: Johnson (1985), section 13.2, for a half-plane and for antiplane strain.
    x, y, length = wave_numbers(shape, cell_size)
    length[0, 0] = np.inf  # the mean plane is at rest
    direct = 2 / length
    across = direct * (y / length) ** 2
    cross = -direct * _odd(x * y / length**2, shape)
    nothing = np.zeros(direct.shape)
    poisson = across, cross, direct - across
    corrections = [_correction_of_waves(x, y, shape, each) for each in layers]
    symbols = (direct, nothing, direct), poisson, *corrections
    return _parts(shape, shape, symbols, options)


def _correction_of_waves(
    x: Floats, y: Floats, shape: tuple[int, int], response: LayeredShear
) -> Entries:
    """Entries of layers beyond those of a half-space of short waves, at wave numbers [m]."""
    squared = x**2 + y**2
    squared[0, 0] = 1.0  # k = 0 comes below
    lengths, places = np.unique(np.sqrt(squared), return_inverse=True)
    ratios, short = response.ratios(lengths), response.short_waves
    along, across = (
        (2 / lengths * (found - limit))[places].reshape(squared.shape)
        for found, limit in ((ratios.along, short.along), (ratios.across, short.across))
    )
    split = across - along
    cross = -split * _odd(x * y / squared, shape)
    xx, yy = across - split * x**2 / squared, across - split * y**2 / squared
    mean = response.mean_displacement
    xx[0, 0] = yy[0, 0] = mean if np.isfinite(mean) else 0.0
    return xx, cross, yy


def shear_preconditioner(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    kappa: float,
    layers: InPlane | None = None,
    **options: Any,
) -> ShearFilter:
    """Approximate inverse of the displacement of a block, taken as a period [1/m]."""
    x, y, length = wave_numbers(shape, cell_size)
    half, lost = inverse_waves(length, kappa, layers)
    safe = np.where(length > 0, length, 1.0)
    xx = half * (1 - lost * (y / safe) ** 2)
    yy = half * (1 - lost * (x / safe) ** 2)
    xy = lost * half * _odd(x * y / safe**2, shape)
    xx[0, 0] = yy[0, 0] = inverse_of_mean(half, lost)
    return ShearFilter(shape, shape, (xx, xy, yy), single=True, **options)


def inverse_waves(
    length: Floats, kappa: float, layers: InPlane | None
) -> tuple[Floats, Floats | float]:
    """Inverse of the displacement of waves along k [1/m], and the part that those across lack."""
    # The inverse symbol |k|/2 (l l^T + t t^T/(1 + κ)) of waves along l and across t, of layers
    # |k|/2 (l l^T/A + t t^T/B).
    half = length / 2
    if layers is None:
        return half, kappa / (1 + kappa)
    along, across = layers(np.where(length > 0, length, length.max()))
    return half / along, 1 - along / across


def inverse_of_mean(half: Floats, lost: Floats | float) -> float:
    """Inverse of the displacement of a block's mean [1/m]."""
    # The mean of a block is a wave of about the longest length in it, not of none.
    across = half * (1 - lost)
    return float(min([*across[0, 1:2], *across[1:2, 0]]))


class Parts:
    """Parts of a surface's response to shear: of 1/r, by Poisson's ratio, and of layers."""

    def __init__(self, *parts: PairFilter) -> None:
        self._parts = parts
        self._sums: dict[tuple[Any, ...], PairFilter] = {}

    def sum_of(
        self, direct: float, poisson: float, layers: Sequence[float] = (), *, single: bool = False
    ) -> PairFilter:
        """Operator of given weights of the parts."""
        key = direct, poisson, *layers, single
        if key not in self._sums:
            # Of a Poisson's ratio that varies, and of each term of layers.
            if len(self._sums) >= MOST_SUMS + len(self._parts):
                self._sums.clear()
            used = [
                (part, weight)
                for part, weight in zip(self._parts, (direct, poisson, *layers), strict=False)
                if weight or part in self._parts[:2]
            ]
            found = self._parts[0].sum_of(*zip(*used, strict=True))
            self._sums[key] = found.in_single() if single else found
        return self._sums[key]


def _parts(
    shape: tuple[int, int],
    lengths: tuple[int, int],
    symbols: Sequence[Entries],
    options: dict[str, Any],
) -> Parts:
    return Parts(*(ShearFilter(shape, lengths, symbol, **options) for symbol in symbols))


def _spectrum(table: Floats, lengths: tuple[int, int], sign: int) -> Floats:
    """Spectrum of a kernel that is even (1) or odd (-1) along both axes."""
    return np.ascontiguousarray(np.fft.rfft2(_around(table, lengths, (sign, sign))).real)


def odd_spectrum(table: Floats, lengths: tuple[int, int], signs: tuple[int, int]) -> Floats:
    """Imaginary part of the spectrum of a kernel that is odd (-1) along one axis only."""
    return np.ascontiguousarray(np.fft.rfft2(_around(table, lengths, signs)).imag)


def _around(table: Floats, lengths: tuple[int, int], signs: tuple[int, int]) -> Floats:
    """Kernel on both sides of a cell, of its coefficients on one."""
    for axis, length in enumerate(lengths):
        table = wrapped(table, axis, length, signs[axis])
    return table


def wrapped(table: Floats, axis: int, length: int, sign: int) -> Floats:
    """Kernel at the offsets 0, 1, ... (-2, -1) of a transform; in a period it is as it is."""
    cells = table.shape[axis]
    if length == cells:
        return table
    shape = list(table.shape)
    shape[axis] = length
    kernel = np.zeros(shape)
    lines, given = np.moveaxis(kernel, axis, 0), np.moveaxis(table, axis, 0)
    lines[:cells] = given
    if cells > 1:
        lines[1 - cells :] = sign * given[:0:-1]
    return kernel


def wave_numbers(
    shape: tuple[int, int], cell_size: tuple[float, float]
) -> tuple[Floats, Floats, Floats]:
    """Wave numbers along x and y, and their lengths, in the order of the transform [1/m]."""
    x = np.asarray(2 * np.pi * np.fft.fftfreq(shape[0], cell_size[0]), np.float64)[:, None]
    y = np.asarray(2 * np.pi * np.fft.rfftfreq(shape[1], cell_size[1]), np.float64)[None, :]
    length: Floats = np.hypot(x, y)
    return x, y, length


def _odd(values: Floats, shape: tuple[int, int]) -> Floats:
    """Factors that are odd along both axes: none at the shortest waves, which have no sign."""
    nx, ny = shape
    if nx % 2 == 0:
        values[nx // 2] = 0.0
    if ny % 2 == 0:
        values[:, ny // 2] = 0.0
    return values
