"""Discrete Fourier and cosine transforms of influence coefficients, padded for a convolution."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

#: Size of the lines that are transformed at once [bytes].
BLOCK_BYTES = 2**22


def padded_length(cells: int, *, unpadded: bool, exact: bool) -> int:
    """Transform length for a number of cells of the whole block; exactly these in a period.

    >>> padded_length(100, unpadded=False, exact=False)
    200
    """
    if exact:
        return cells
    return int(scipy.fft.next_fast_len(cells if unpadded else 2 * cells - 1, real=True))


def kernel_spectrum(
    coefficients: NDArray[np.float64],
    lengths: Sequence[int],
    mirrored: tuple[bool, bool],
    first: int,
    signed: int | None = None,
) -> NDArray[Any]:
    """Transform of a kernel, real if the kernel is even along both axes.

    `coefficients` at the offsets 0, 1, 2, ... along an even axis; along a `signed` one at the
    offsets from -(n - 1) to n - 1. `lengths` are those of the transforms. Along a `mirrored` axis
    the spectrum has as many entries; along another one that is even it has the first half of them,
    with the middle, of which the others are the mirror image; so along a signed one if it is
    transformed `first`, otherwise all.

    >>> kernel_spectrum(np.array([[4.0], [1.0]]), (3, 1), (False, False), first=1).ravel().tolist()
    [6.0, 3.0]
    """
    spectrum: NDArray[Any] = coefficients
    for axis in sorted((0, 1), key=lambda each: each == signed):  # real as long as possible
        length, entries = lengths[axis], spectrum.shape[axis]
        lines = spectrum if axis == 1 else spectrum.T
        if axis == signed:
            offsets = _signed_offsets(length, entries)
            transform = scipy.fft.rfft if axis == first else scipy.fft.fft
            found = transform(lines[:, offsets], axis=1)
        else:
            found = _of_even_lines(lines, length, mirrored=mirrored[axis])
        spectrum = found if axis == 1 else found.T
    return np.ascontiguousarray(spectrum)


def _of_even_lines(
    lines: NDArray[np.float64], length: int, *, mirrored: bool
) -> NDArray[np.float64]:
    """Transform of lines of even kernels, a block of lines at a time."""
    offsets = _distances(length, lines.shape[1], even=mirrored)
    found = np.empty((lines.shape[0], length if mirrored else length // 2 + 1))
    most = max(1, BLOCK_BYTES // (8 * length))
    for start in range(0, lines.shape[0], most):
        block = lines[start : start + most][:, offsets]
        found[start : start + most] = (
            scipy.fft.dct(block, type=1, axis=1)[:, :length]
            if mirrored
            else scipy.fft.rfft(block, axis=1).real
        )
    return found


def _distances(padded: int, cells: int, *, even: bool) -> NDArray[np.intp]:
    """Offsets of a centred even kernel in the order of the transform: 0, 1, 2, ... (2, 1).

    Offsets beyond the block fall on padding, which is never read; they are clipped.
    """
    index = np.arange(padded + even)
    return np.minimum(index if even else np.minimum(index, padded - index), cells - 1)


def _signed_offsets(padded: int, entries: int) -> NDArray[np.intp]:
    """Entries of a kernel at signed offsets in the order of the transform: 0, 1, ... (-2, -1)."""
    index, middle = np.arange(padded), entries // 2
    return np.clip(np.where(index <= middle, index, index - padded), -middle, middle) + middle
