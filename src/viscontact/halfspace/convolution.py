"""Discrete convolution of pressure and influence coefficients by zero-padded transforms."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from viscontact.fourier import (
    Transforms,
    as_reals,
    fastest_transforms,
    fill_of_order_one,
    transforms_by,
)


class Convolution:
    """Surface displacement of a half-space under cell pressures, by the DC-FFT algorithm.

    The convolution is linear: zero padding removes the periodic images, so the result is the
    direct sum over all pairs of cells, to rounding [1]_. For a problem that is even across x = 0
    or y = 0 (`mirrored`; an even number of cells there) only the cells with positive coordinates
    are kept, and cosine transforms replace Fourier transforms of twice the length: a half-sample
    even sequence convolved with an even kernel is its DCT-II times the kernel's discrete Fourier
    transform [2]_. Along a `periodic` axis, which is not mirrored, the convolution is circular.
    `coefficients` are those of the whole block, from `influence_table` or
    `periodic_influence_table` [m], even along both axes but for a `signed` one, with the 2 n - 1
    offsets of `moving_influence_table`; `single` precision takes half the time.

    References
    ----------
    .. [1] S. Liu, Q. Wang, G. Liu, Wear 243 (2000) 101.
    .. [2] S. A. Martucci, IEEE Trans. Signal Process. 42 (1994) 1038.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.halfspace.influence import influence_table
    >>> table = influence_table((4, 4), (1.0, 1.0))
    >>> pressure = np.zeros((4, 4))
    >>> pressure[1, 1] = pressure[1, 2] = 1.0
    >>> round(float(Convolution(table).apply(pressure)[1, 2]), 6)  # 1.122200 + 0.330421
    1.452621
    >>> half = Convolution(table, mirrored=(False, True)).apply(pressure[:, 2:])
    >>> round(float(half[1, 0]), 6)
    1.452621
    """

    def __init__(
        self,
        coefficients: NDArray[np.float64],
        *,
        mirrored: tuple[bool, bool] = (False, False),
        periodic: tuple[bool, bool] = (False, False),
        single: bool = False,
        signed: int | None = None,
        transforms: Transforms | None = None,
    ) -> None:
        self._transforms = transforms or transforms_by(fastest_transforms())
        counts = [
            (entries + 1) // 2 if axis == signed else entries
            for axis, entries in enumerate(coefficients.shape)
        ]
        self.shape = _halved(counts, mirrored)
        padded = [
            _padded(cells, unpadded=mirrored[axis], exact=periodic[axis])
            for axis, cells in enumerate(counts)
        ]
        # A real Fourier transform comes first, on the columns with data; the next one is complex.
        self._first = 0 if mirrored == (False, True) else 1
        self._second = 1 - self._first
        self._even = mirrored
        number = np.float32 if single else np.float64
        complex_number = np.result_type(number, np.complex64)
        symbol = _symbol(coefficients, padded, mirrored, self._first, signed)
        self._symbol = symbol.astype(number if signed is None else complex_number)
        self._block = np.zeros(_put(self.shape, self._first, padded[self._first]), number)
        kind = number if mirrored[self._first] else complex_number
        self._spectrum = np.zeros(self._symbol.shape, kind)

    def sum_of(self, parts: Sequence[Self], weights: Sequence[float]) -> Self:
        """Weighted sum of operators on the same block, in the precision of this one."""
        total = copy(self)
        pairs = zip(weights, parts, strict=True)
        symbol = np.asarray(sum(weight * part._symbol for weight, part in pairs))
        total._symbol = symbol.astype(self._symbol.dtype)
        return total

    def apply(
        self, pressure: NDArray[np.float64], into: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Displacement over contact compliance [Pa m], positive into the half-space.

        The pressure [Pa] is positive in compression; the result is written to `into` if given.
        """
        nx, ny = self.shape
        # 1. Scale the pressure to order one and pad it with zeros.
        size = fill_of_order_one(self._block[:nx, :ny], pressure)
        _beyond(self._block, self.shape, self._first)[...] = 0
        # 2. Transform, multiply by the symbol, transform back; 3. undo the scaling.
        moved = self._back(self._forth(self._block))
        return np.asarray(np.multiply(moved[:nx, :ny], size, out=into, dtype=np.float64))

    def _forth(self, block: NDArray[Any]) -> NDArray[Any]:
        # First along the lines with data only, then along all lines of the padded block.
        transforms, spectrum, second = self._transforms, self._spectrum, self._second
        lines = _within(spectrum, self.shape, second)
        if self._even[self._first]:
            lines[...] = transforms.cosine_forward(block, self._first)
        else:
            transforms.real_forward(block, lines, self._first)
        _beyond(spectrum, self.shape, second)[...] = 0
        ways = transforms.cosine_forward, transforms.complex_forward
        spectrum = self._along_second(*ways, spectrum)
        spectrum *= self._symbol
        return spectrum

    def _back(self, spectrum: NDArray[Any]) -> NDArray[Any]:
        transforms = self._transforms
        ways = transforms.cosine_inverse, transforms.complex_inverse
        spectrum = self._along_second(*ways, spectrum)
        lines = _within(spectrum, self.shape, self._second)
        if self._even[self._first]:
            return transforms.cosine_inverse(lines, self._first)
        return transforms.real_inverse(lines, self._block, self._first)

    def _along_second(
        self,
        cosine: Callable[[NDArray[Any], int], NDArray[Any]],
        fourier: Callable[[NDArray[Any], int], NDArray[Any]],
        spectrum: NDArray[Any],
    ) -> NDArray[Any]:
        """Transform in place along the second axis; cosines act on real and imaginary parts."""
        if not self._even[self._second]:
            return fourier(spectrum, self._second)
        if self._even[self._first]:
            return cosine(spectrum, self._second)
        return cosine(as_reals(spectrum), self._second).view(spectrum.dtype)[..., 0]


def _halved(shape: list[int], mirrored: tuple[bool, bool]) -> tuple[int, int]:
    nx, ny = (cells // (1 + even) for cells, even in zip(shape, mirrored, strict=True))
    return nx, ny


def _padded(cells: int, *, unpadded: bool, exact: bool) -> int:
    """Transform length for a number of cells of the whole block; exactly these in a period."""
    if exact:
        return cells
    return int(fft.next_fast_len(cells if unpadded else 2 * cells - 1, real=True))


def _symbol(
    coefficients: NDArray[np.float64],
    padded: list[int],
    mirrored: tuple[bool, bool],
    first: int,
    signed: int | None,
) -> NDArray[Any]:
    """Transform of the kernel: real if the kernel is even along both axes."""
    index_x, index_y = (
        _signed_offsets(padded[axis], entries)
        if axis == signed
        else _distances(padded[axis], entries, mirrored[axis])
        for axis, entries in enumerate(coefficients.shape)
    )
    symbol = coefficients[index_x[:, None], index_y[None, :]]
    for axis in (first, 1 - first):
        if mirrored[axis]:
            every = fft.dct(symbol, type=1, axis=axis)
            symbol = np.take(every, np.arange(padded[axis]), axis)
        else:
            symbol = (fft.rfft if axis == first else fft.fft)(symbol, axis=axis)
        if signed is None:
            symbol = symbol.real
    return np.ascontiguousarray(symbol)


def _distances(padded: int, cells: int, even: bool) -> NDArray[np.intp]:
    """Offsets of a centred even kernel in the order of the transform: 0, 1, 2, ... (2, 1).

    Offsets beyond the block fall on padding, which is never read; they are clipped.
    """
    index = np.arange(padded + even)
    return np.minimum(index if even else np.minimum(index, padded - index), cells - 1)


def _signed_offsets(padded: int, entries: int) -> NDArray[np.intp]:
    """Entries of a kernel at signed offsets in the order of the transform: 0, 1, ... (-2, -1)."""
    index, middle = np.arange(padded), entries // 2
    return np.clip(np.where(index <= middle, index, index - padded), -middle, middle) + middle


def _put(shape: tuple[int, int], axis: int, count: int) -> tuple[int, int]:
    return (count, shape[1]) if axis == 0 else (shape[0], count)


def _within(field: NDArray[Any], shape: tuple[int, int], axis: int) -> NDArray[Any]:
    """Lines of a field that hold data, counted along an axis."""
    return field[: shape[0]] if axis == 0 else field[:, : shape[1]]


def _beyond(field: NDArray[Any], shape: tuple[int, int], axis: int) -> NDArray[Any]:
    """Lines of a field that are padding, counted along an axis."""
    return field[shape[0] :] if axis == 0 else field[:, shape[1] :]
