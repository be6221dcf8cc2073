"""Operators that know the half-space by its waves: exact for a period, a fair guess else.

A wavy pressure of wave number q displaces the surface by 2 p/q of the contact compliance's half:
p/(q/2) per unit compliance.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), eq. 13.7; H. M. Stanley, T. Kato, J.
Tribol. 119 (1997) 481.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from viscontact.fourier import (
    Transforms,
    fastest_transforms,
    fill_of_order_one,
    transforms_by,
)


class PeriodicConvolution:
    """One period of a half-space whose load repeats itself without end, both ways.

    A circular convolution, by the exact symbol 2/|q| at the wave numbers that the cells carry.
    A mean pressure sinks an endless half-space without end, so displacement is measured from the
    surface's mean plane: its mean is zero, and so is the symbol's first entry.

    Parameters
    ----------
    shape : tuple of int
        Cells (nx, ny) of a period.
    cell_size : tuple of float
        Edge lengths (dx, dy) of a cell [m].
    single : bool
        Whether to transform in single precision, in half the time.
    transforms : Transforms, optional
        Who transforms; the fastest that are installed when left out.

    Examples
    --------
    A pressure of cos(2π x/λ) over λ = 1 m moves the surface by 2 cos/q = cos/π:

    >>> import numpy as np
    >>> operator = PeriodicConvolution((4, 4), (0.25, 0.25))
    >>> wave = np.tile([[1.0], [0.0], [-1.0], [0.0]], 4)
    >>> (np.pi * operator.apply(wave)[:, 0]).round(12).tolist()
    [1.0, 0.0, -1.0, 0.0]
    """

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        *,
        single: bool = False,
        transforms: Transforms | None = None,
    ) -> None:
        self.shape = shape
        number = np.float32 if single else np.float64
        self._spectra = Spectra(shape, cell_size, (False, False), number, transforms)
        half = self._spectra.half_wave_numbers
        half[0, 0] = np.inf
        self._symbol = (1 / half).astype(number)

    def apply(
        self, pressure: NDArray[np.float64], into: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Displacement of every cell under a pressure, per unit contact compliance.

        Parameters
        ----------
        pressure : ndarray, shape (nx, ny)
            Pressure on the cells [Pa], positive in compression.
        into : ndarray, shape (nx, ny), optional
            Where the displacement is put; a new array when left out.

        Returns
        -------
        ndarray, shape (nx, ny)
            Displacement over contact compliance [Pa m], positive into the half-space; its mean
            is zero.
        """
        return self._spectra.filtered(pressure, self._symbol, into)


class Spectra:
    """Spectra of a block that repeats itself, or across whose first line it is even."""

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        mirrored: tuple[bool, bool],
        number: type,
        transforms: Transforms | None,
    ) -> None:
        self._transforms = transforms or transforms_by(fastest_transforms())
        self._even = [axis for axis in (0, 1) if mirrored[axis]]
        # A real transform comes first, and keeps half of its spectrum; then a complex one.
        self._fourier = [axis for axis in (1, 0) if not mirrored[axis]]
        waves = [self._waves(axis, shape[axis], cell_size[axis]) for axis in (0, 1)]
        #: |q|/2 of what a spectrum holds [1/m].
        self.half_wave_numbers = np.pi * np.hypot(waves[0][:, None], waves[1][None, :])
        self._block: NDArray[Any] = np.empty(shape, number)
        self._spectrum = np.empty(
            self.half_wave_numbers.shape, np.result_type(number, np.complex64)
        )

    def filtered(
        self,
        field: NDArray[np.float64],
        symbol: NDArray[Any],
        into: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """The field whose spectrum is that of another one times a symbol."""
        size = fill_of_order_one(self._block, field)
        spectrum = self._forth(self._block)
        spectrum *= symbol
        return np.asarray(np.multiply(self._back(spectrum), size, out=into, dtype=np.float64))

    def _forth(self, block: NDArray[Any]) -> NDArray[Any]:
        for axis in self._even:
            block = self._transforms.cosine_forth(block, axis)
        if self._fourier:
            block = self._transforms.real_forth(block, self._spectrum, self._fourier[0])
        for axis in self._fourier[1:]:
            block = self._transforms.complex_forth(block, axis)
        return block

    def _back(self, spectrum: NDArray[Any]) -> NDArray[Any]:
        for axis in self._fourier[1:]:
            spectrum = self._transforms.complex_back(spectrum, axis)
        if self._fourier:
            spectrum = self._transforms.real_back(spectrum, self._block, self._fourier[0])
        for axis in self._even:
            spectrum = self._transforms.cosine_back(spectrum, axis)
        return spectrum

    def _waves(self, axis: int, cells: int, edge: float) -> NDArray[np.float64]:
        """Waves per length along an axis, |q|/(2π), in the order of its transform [1/m]."""
        if axis in self._even:
            return np.arange(cells) / (2 * cells * edge)
        frequencies = fft.rfftfreq if axis == self._fourier[0] else fft.fftfreq
        return np.asarray(frequencies(cells, edge))
