"""Discrete Fourier and cosine transforms of influence coefficients, padded for a convolution."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.fourier import Transforms, fast_length

#: Size of the lines that are transformed at once [bytes].
BLOCK_BYTES = 2**22


def padded_length(cells: int, *, unpadded: bool, exact: bool) -> int:
    """Transform length for a number of cells of the whole block; exactly these in a period.

    >>> padded_length(100, unpadded=False, exact=False)
    200
    """
    if exact:
        return cells
    return fast_length(cells if unpadded else 2 * cells - 1)


def kernel_spectrum(
    coefficients: NDArray[np.float64],
    lengths: Sequence[int],
    mirrored: tuple[bool, bool],
    first: int,
    transforms: Transforms,
    signed: int | None = None,
) -> NDArray[Any]:
    """Transform of a kernel, real if the kernel is even along both axes.

    `coefficients` at the offsets 0, 1, 2, ... along an even axis; along a `signed` one at the
    offsets from -(n - 1) to n - 1. `lengths` are those of the transforms. Along a `mirrored` axis
    the spectrum has as many entries; along another one that is even it has the first half of them,
    with the middle, of which the others are the mirror image; so along a signed one if it is
    transformed `first`, otherwise all.

    >>> from viscontact.fourier import SciPyTransforms
    >>> kernel, transforms = np.array([[4.0], [1.0]]), SciPyTransforms()
    >>> kernel_spectrum(kernel, (3, 1), (False, False), 1, transforms).ravel().tolist()
    [6.0, 3.0]
    """
    spectrum: NDArray[Any] = coefficients
    for axis in sorted((0, 1), key=lambda each: each == signed):  # real as long as possible
        length, entries = lengths[axis], spectrum.shape[axis]
        lines = spectrum if axis == 1 else spectrum.T
        if axis == signed:
            signed_lines = lines[:, _signed_offsets(length, entries)]
            found = (
                _of_real_lines(signed_lines, transforms)
                if axis == first
                else transforms.complex_forward(signed_lines.astype(complex), 1)
            )
        else:
            found = _of_even_lines(lines, length, transforms, mirrored=mirrored[axis])
        spectrum = found if axis == 1 else found.T
    return np.ascontiguousarray(spectrum)


def _of_real_lines(lines: NDArray[np.float64], transforms: Transforms) -> NDArray[Any]:
    """First half of the spectra of real lines, with the middle."""
    count, length = lines.shape
    return transforms.real_forward(lines, np.empty((count, length // 2 + 1), complex), 1)


def _of_even_lines(
    lines: NDArray[np.float64], length: int, transforms: Transforms, *, mirrored: bool
) -> NDArray[np.float64]:
    """Transform of lines of even kernels, a block of lines at a time."""
    offsets = _distances(length, lines.shape[1], even=mirrored)
    found = np.empty((lines.shape[0], length if mirrored else length // 2 + 1))
    most = max(1, BLOCK_BYTES // (8 * length))
    for start in range(0, lines.shape[0], most):
        block = lines[start : start + most][:, offsets]
        found[start : start + most] = (
            transforms.even_forward(block, 1)[:, :length]
            if mirrored
            else _of_real_lines(block, transforms).real
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
