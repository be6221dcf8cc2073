"""Discrete Fourier and cosine transforms of influence coefficients, padded for a convolution."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats, Integers, Numbers
from viscontact.backend.team import blocks_of
from viscontact.backend.transforms import Transforms, fast_length


def padded_length(cells: int, *, unpadded: bool, exact: bool) -> int:
    """Transform length for a number of cells of the whole block; exactly these in a period."""
    if exact:
        return cells // 2 if unpadded else cells
    return fast_length(cells if unpadded else 2 * cells - 1)


def kernel_spectrum(
    coefficients: Floats,
    lengths: Sequence[int],
    mirrored: tuple[bool, bool],
    first: int,
    transforms: Transforms,
    signed: int | None = None,
) -> Numbers:
    """Transform of a kernel, real if the kernel is even along both axes.

    `coefficients` at the offsets 0, 1, 2, ... along an even axis; along a `signed` one at the
    offsets from -(n - 1) to n - 1. `lengths` are those of the transforms. Along a `mirrored` axis
    the spectrum has as many entries; along another one that is even it has the first half of them,
    with the middle, of which the others are the mirror image; so along a signed one if it is
    transformed `first`, otherwise all.
    """
    spectrum: Numbers = coefficients
    for axis in sorted((0, 1), key=lambda each: each == signed):  # real as long as possible
        length, entries = lengths[axis], spectrum.shape[axis]
        if axis == signed:
            kernel = spectrum.take(_signed_offsets(length, entries), axis)
            spectrum = (
                _of_reals(kernel, axis, transforms)
                if axis == first
                else transforms.complex_forward(kernel.astype(complex), axis)
            )
        else:
            spectrum = _of_even(spectrum, axis, length, transforms, mirrored=mirrored[axis])
    return np.ascontiguousarray(spectrum)


def _of_reals(field: Floats, axis: int, transforms: Transforms) -> Numbers:
    """First half of the spectra of real lines along an axis, with the middle."""
    shape = list(field.shape)
    shape[axis] = shape[axis] // 2 + 1
    return transforms.real_forward(field, np.empty(shape, complex), axis)


def _of_even(
    field: Floats, axis: int, length: int, transforms: Transforms, *, mirrored: bool
) -> Floats:
    """Transform of the lines of an even kernel along an axis, a block of lines at a time."""
    offsets = _distances(length, field.shape[axis], even=mirrored)
    shape = list(field.shape)
    shape[axis] = length if mirrored else length // 2 + 1
    found = np.empty(shape)
    for lines in blocks_of(field.shape[1 - axis], 8 * length):
        block = (slice(None), lines) if axis == 0 else (lines, slice(None))
        even = field[block].take(offsets, axis)
        if mirrored:
            # Without the last entry, which the spectrum of a mirrored axis lacks.
            whole = transforms.even_forward(even, axis)
            found[block] = whole[:-1] if axis == 0 else whole[:, :-1]
        else:
            found[block] = _of_reals(even, axis, transforms).real
    return found


def _distances(padded: int, cells: int, *, even: bool) -> Integers:
    """Offsets of a centred even kernel in the order of the transform: 0, 1, 2, ... (2, 1)."""
    # Offsets beyond the block fall on padding, which is never read; they are clipped.
    index = np.arange(padded + even)
    return np.minimum(index if even else np.minimum(index, padded - index), cells - 1)


def _signed_offsets(padded: int, entries: int) -> Integers:
    """Entries of a kernel at signed offsets in the order of the transform: 0, 1, ... (-2, -1)."""
    index, middle = np.arange(padded), entries // 2
    return np.clip(np.where(index <= middle, index, index - padded), -middle, middle) + middle
