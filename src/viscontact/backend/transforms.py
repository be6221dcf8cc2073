"""Fourier and cosine transforms along one axis, by SciPy or ducc0.

SciPy is always there; `ducc0` takes less than half the time where it is installed
(``pip install viscontact[fast]``; it is under the GPL, and so never required). The two agree to
rounding, not to the bit, so a run keeps the library that it began with. What the compiled core
filters (`compiled_filter`) needs neither.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
import scipy  # its transforms are imported at their first use

from viscontact.backend import compiled
from viscontact.backend.arrays import Numbers

try:
    import ducc0
except ImportError:
    ducc0 = None

#: Real or complex fields, in single or double precision.
Field = Numbers

#: Kinds of spectra and symbols that the compiled core multiplies.
_COMPILED = frozenset(
    (np.dtype(of), np.dtype(number))
    for number, *kinds in (("f4", "f4", "c8"), ("f8", "f8", "c16"))
    for of in kinds
)


class Transforms(ABC):
    """Transforms of fields along an axis by one library, forward and inverse.

    Each returns its result, which may lie in the array that was given for it.

    Parameters
    ----------
    threads : int
        Threads of one transform.
    """

    #: The library's name.
    name: str

    def __init__(self, threads: int = 1) -> None:
        self.threads = threads

    @abstractmethod
    def real_forward(self, field: Field, into: Field, axis: int) -> Field:
        """Fourier transform of a real field, whose half of the spectrum is put into an array."""

    @abstractmethod
    def real_inverse(self, spectrum: Field, spare: Field, axis: int) -> Field:
        """Real field, of a spare array's shape, of half a spectrum; both arrays may be used up."""

    @abstractmethod
    def complex_forward(self, field: Field, axis: int) -> Field:
        """Fourier transform of a complex field, in place."""

    @abstractmethod
    def complex_inverse(self, spectrum: Field, axis: int) -> Field:
        """Complex field of a spectrum, in place."""

    @abstractmethod
    def cosine_forward(self, field: Field, axis: int) -> Field:
        """Cosine transform (DCT-II) of a real field, in place."""

    @abstractmethod
    def sine_forward(self, field: Field, axis: int) -> Field:
        """Sine transform (DST-II) of a real field, in place."""

    @abstractmethod
    def sine_inverse(self, spectrum: Field, axis: int) -> Field:
        """Real field of a sine transform, in place."""

    @abstractmethod
    def even_forward(self, field: Field, axis: int) -> Field:
        """Cosine transform (DCT-I) of half an even real field with both of its ends, in place."""

    @abstractmethod
    def cosine_inverse(self, spectrum: Field, axis: int) -> Field:
        """Real field of a cosine transform, in place."""


class SciPyTransforms(Transforms):
    """Transforms by SciPy, in double and single precision.

    Examples
    --------
    >>> SciPyTransforms().cosine_forward(np.ones((1, 3)), axis=1).tolist()
    [[6.0, 0.0, 0.0]]
    """

    name = "scipy"

    def real_forward(self, field: Field, into: Field, axis: int) -> Field:
        """See `Transforms.real_forward`."""
        into[...] = scipy.fft.rfft(field, axis=axis, workers=self.threads)
        return into

    def real_inverse(self, spectrum: Field, spare: Field, axis: int) -> Field:
        """See `Transforms.real_inverse`."""
        length = spare.shape[axis]
        return np.asarray(scipy.fft.irfft(spectrum, length, axis=axis, workers=self.threads))

    def complex_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.complex_forward`."""
        return np.asarray(scipy.fft.fft(field, axis=axis, overwrite_x=True, workers=self.threads))

    def complex_inverse(self, spectrum: Field, axis: int) -> Field:
        """See `Transforms.complex_inverse`."""
        return np.asarray(
            scipy.fft.ifft(spectrum, axis=axis, overwrite_x=True, workers=self.threads)
        )

    def cosine_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.cosine_forward`."""
        return np.asarray(
            scipy.fft.dct(field, 2, axis=axis, overwrite_x=True, workers=self.threads)
        )

    def even_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.even_forward`."""
        return np.asarray(
            scipy.fft.dct(field, 1, axis=axis, overwrite_x=True, workers=self.threads)
        )

    def cosine_inverse(self, spectrum: Field, axis: int) -> Field:
        """See `Transforms.cosine_inverse`."""
        return np.asarray(
            scipy.fft.idct(spectrum, 2, axis=axis, overwrite_x=True, workers=self.threads)
        )

    def sine_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.sine_forward`."""
        return np.asarray(
            scipy.fft.dst(field, 2, axis=axis, overwrite_x=True, workers=self.threads)
        )

    def sine_inverse(self, spectrum: Field, axis: int) -> Field:
        """See `Transforms.sine_inverse`."""
        return np.asarray(
            scipy.fft.idst(spectrum, 2, axis=axis, overwrite_x=True, workers=self.threads)
        )


class DuccTransforms(Transforms):
    """Transforms by `ducc0`, which allocates no memory for fields."""

    name = "ducc0"

    def real_forward(self, field: Field, into: Field, axis: int) -> Field:
        """See `Transforms.real_forward`."""
        ducc0.fft.r2c(field, axes=(axis,), out=into, nthreads=self.threads)
        return into

    def real_inverse(self, spectrum: Field, spare: Field, axis: int) -> Field:
        """See `Transforms.real_inverse`."""
        ducc0.fft.c2r(
            spectrum,
            axes=(axis,),
            lastsize=spare.shape[axis],
            forward=False,
            inorm=2,
            out=spare,
            nthreads=self.threads,
            allow_overwriting_input=True,
        )
        return spare

    def complex_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.complex_forward`."""
        ducc0.fft.c2c(field, axes=(axis,), out=field, nthreads=self.threads)
        return field

    def complex_inverse(self, spectrum: Field, axis: int) -> Field:
        """See `Transforms.complex_inverse`."""
        options = {"forward": False, "inorm": 2, "nthreads": self.threads}
        ducc0.fft.c2c(spectrum, axes=(axis,), out=spectrum, **options)
        return spectrum

    def cosine_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.cosine_forward`."""
        ducc0.fft.dct(field, type=2, axes=(axis,), out=field, nthreads=self.threads)
        return field

    def even_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.even_forward`."""
        ducc0.fft.dct(field, type=1, axes=(axis,), out=field, nthreads=self.threads)
        return field

    def cosine_inverse(self, spectrum: Field, axis: int) -> Field:
        """See `Transforms.cosine_inverse`."""
        ducc0.fft.dct(spectrum, type=3, axes=(axis,), inorm=2, out=spectrum, nthreads=self.threads)
        return spectrum

    def sine_forward(self, field: Field, axis: int) -> Field:
        """See `Transforms.sine_forward`."""
        ducc0.fft.dst(field, type=2, axes=(axis,), out=field, nthreads=self.threads)
        return field

    def sine_inverse(self, spectrum: Field, axis: int) -> Field:
        """See `Transforms.sine_inverse`."""
        ducc0.fft.dst(spectrum, type=3, axes=(axis,), inorm=2, out=spectrum, nthreads=self.threads)
        return spectrum


def fastest_transforms() -> str:
    """Return the name of the fastest transforms that are installed.

    Examples
    --------
    >>> fastest_transforms() in {"ducc0", "scipy"}
    True
    """
    return SciPyTransforms.name if ducc0 is None else DuccTransforms.name


def transforms_by(name: str, threads: int = 1) -> Transforms:
    """Return the transforms of a library, "scipy" or "ducc0", on some threads.

    Raises
    ------
    ValueError
        If it is not installed, or unknown.

    Examples
    --------
    >>> transforms_by("scipy").name
    'scipy'
    """
    if name == SciPyTransforms.name:
        return SciPyTransforms(threads)
    if name != DuccTransforms.name:
        raise ValueError(f"no Fourier transforms are called {name!r}; known are scipy and ducc0")
    if ducc0 is None:
        raise ValueError("ducc0 is not installed; install it: pip install viscontact[fast]")
    return DuccTransforms(threads)


def fast_length(least: int) -> int:
    """Return the smallest length, from some number on, that real transforms are fast for.

    Its prime factors are 2, 3 and 5, as those of ``scipy.fft.next_fast_len``.

    Examples
    --------
    >>> fast_length(199)
    200
    """
    length = least
    while not _has_small_factors(length):
        length += 1
    return length


def _has_small_factors(number: int) -> bool:
    for factor in (2, 3, 5):
        while number % factor == 0:
            number //= factor
    return number == 1


def as_reals(spectrum: Field) -> Field:
    """Complex numbers as pairs of reals along one more axis, in the same memory.

    Examples
    --------
    >>> as_reals(np.array([1 + 2j])).tolist()
    [[1.0, 2.0]]
    """
    return spectrum.view(spectrum.real.dtype).reshape(*spectrum.shape, 2)


def largest_of(field: Field) -> float:
    """Return the largest absolute value of a field.

    Examples
    --------
    >>> largest_of(np.array([1e-99, -4e-99]))
    4e-99
    """
    if compiled.core is not None and field.dtype.kind == "f":
        return float(compiled.core.largest(field))
    return max(float(field.max()), -float(field.min()))


def multiply_by_even(spectrum: Field, symbol: Numbers, axis: int) -> None:
    """Multiply a spectrum in place by a symbol, of which half may be given along an axis.

    The others of its entries are mirror images, as those of an even function.

    Examples
    --------
    >>> spectrum = np.ones((1, 4))
    >>> multiply_by_even(spectrum, np.array([[1.0, 2.0, 3.0]]), axis=1); spectrum.tolist()
    [[1.0, 2.0, 3.0, 2.0]]
    """
    rows_alike = spectrum.strides[1] == spectrum.itemsize and symbol.strides[1] == symbol.itemsize
    if compiled.core and rows_alike and (spectrum.dtype, symbol.dtype) in _COMPILED:
        compiled.core.filter(spectrum, symbol, axis)
        return
    known, length = symbol.shape[axis], spectrum.shape[axis]
    lines, mirrored = [slice(None)] * 2, [slice(None)] * 2
    lines[axis] = slice(known)
    spectrum[tuple(lines)] *= symbol
    if known < length:
        lines[axis], mirrored[axis] = slice(known, None), slice(length - known, 0, -1)
        spectrum[tuple(lines)] *= symbol[tuple(mirrored)]


def fill_of_order(size: float, block: Field, field: Field) -> None:
    """Copy a field, divided by a factor, into a block.

    Examples
    --------
    >>> block = np.zeros(2, np.float32)
    >>> fill_of_order(4e-99, block, np.array([1e-99, -4e-99])); block.tolist()
    [0.25, -1.0]
    """
    if block.dtype == field.dtype and size == 1.0:
        block[...] = field
    else:
        np.divide(field, size, out=block, dtype=np.float64, casting="same_kind")


def restore_of_order(size: float, block: Field, field: Field) -> None:
    """Copy a block, multiplied by a factor, into a field.

    Examples
    --------
    >>> field = np.zeros(2)
    >>> restore_of_order(4e-99, np.array([0.25, -1.0], np.float32), field); field.tolist()
    [1e-99, -4e-99]
    """
    if block.dtype == field.dtype and size == 1.0:
        field[...] = block
    else:
        np.multiply(block, size, out=field, dtype=np.float64)
