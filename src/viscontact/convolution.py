"""From pressure to displacement, on the whole grid at once.

This module knows space, not time; the FFT back end, its threads and its number types live
here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft


class Convolution:
    """The free half-space as an operator on cell pressures, by zero-padded real FFTs.

    Linear, not circular: the padding keeps the grid from seeing its own periodic images, so
    the result is the direct sum over all pairs of cells, to rounding.

    Parameters
    ----------
    coefficients : ndarray, shape (nx, ny)
        Influence coefficients of a block of cells, from `influence_table` [m].
    single : bool
        Whether to transform in single precision, in half the time.
    threads : int
        Threads of one transform.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.influence import influence_table
    >>> operator = Convolution(influence_table((4, 4), (1.0, 1.0)))
    >>> pressure = np.zeros((4, 4))
    >>> pressure[1, 1] = 1.0
    >>> round(float(operator.apply(pressure)[1, 1]), 6)
    1.1222
    """

    def __init__(
        self, coefficients: NDArray[np.float64], *, single: bool = False, threads: int = 1
    ) -> None:
        self.shape = coefficients.shape
        self.threads = threads
        self._padded = tuple(fft.next_fast_len(2 * n - 1, real=True) for n in self.shape)
        near, across = (
            _distances(padded, cells)
            for padded, cells in zip(self._padded, self.shape, strict=True)
        )
        kernel = coefficients[near[:, None], across[None, :]]
        # The wrapped kernel is even along both axes, so its transform is real.
        self._number = np.float32 if single else np.float64
        self._symbol = fft.rfft2(kernel, workers=threads).real.astype(self._number)

    def apply(self, pressure: NDArray[np.float64]) -> NDArray[np.float64]:
        """Displacement of every cell under a pressure, per unit contact compliance.

        Parameters
        ----------
        pressure : ndarray, shape (nx, ny)
            Pressure on the cells [Pa], positive in compression.

        Returns
        -------
        ndarray, shape (nx, ny)
            Displacement over contact compliance [Pa m], positive into the half-space.
        """
        nx, ny = self.shape
        mx, my = self._padded
        size, scaled = _of_order_one(pressure, self._number)
        # Only the rows that hold data are transformed along y, forth and back.
        rows = fft.rfft(scaled, my, axis=1, workers=self.threads)
        spectrum = fft.fft(rows, mx, axis=0, workers=self.threads)
        spectrum *= self._symbol
        columns = fft.ifft(spectrum, axis=0, overwrite_x=True, workers=self.threads)
        lines = fft.irfft(columns[:nx], my, axis=1, overwrite_x=True, workers=self.threads)
        return np.asarray(lines[:, :ny] * size)


class MirroredConvolution:
    """The same operator on one half of a problem that is even across y = 0.

    Cosine transforms along y take the place of Fourier transforms of twice the length, so
    transforms and fields are half as large.

    Parameters
    ----------
    coefficients : ndarray, shape (nx, 2 my)
        Influence coefficients of the whole block, both halves [m].
    single : bool
        Whether to transform in single precision, in half the time.
    threads : int
        Threads of one transform.

    Notes
    -----
    A half-sample even sequence convolved with an even kernel is a product of its DCT-II with the
    kernel's discrete Fourier transform (Martucci 1994, IEEE Trans. Signal Process. 42, 1038).

    Examples
    --------
    Two loaded unit cells side by side, of which only the one at y > 0 is given:

    >>> import numpy as np
    >>> from viscontact.influence import influence_table
    >>> operator = MirroredConvolution(influence_table((4, 4), (1.0, 1.0)))
    >>> pressure = np.zeros((4, 2))
    >>> pressure[1, 0] = 1.0
    >>> round(float(operator.apply(pressure)[1, 0]), 6)  # 1.1222 of itself, 0.3304 of its image
    1.452621
    """

    def __init__(
        self, coefficients: NDArray[np.float64], *, single: bool = False, threads: int = 1
    ) -> None:
        nx, ny = coefficients.shape
        self.shape = (nx, ny // 2)
        self.threads = threads
        self._padded = (
            fft.next_fast_len(2 * nx - 1, real=True),
            fft.next_fast_len(ny, real=True),
        )
        along = _distances(self._padded[0], nx)
        across = np.minimum(np.arange(self._padded[1] + 1), ny - 1)
        kernel = coefficients[along[:, None], across[None, :]]
        symbol = fft.dct(fft.rfft(kernel, axis=0).real, type=1, axis=1)
        self._number = np.float32 if single else np.float64
        self._symbol = symbol[:, :-1].astype(self._number)

    def apply(self, pressure: NDArray[np.float64]) -> NDArray[np.float64]:
        """Displacement of the cells at y > 0 under a pressure and its mirror image.

        Parameters
        ----------
        pressure : ndarray, shape (nx, my)
            Pressure on the cells at y > 0 [Pa], positive in compression.

        Returns
        -------
        ndarray, shape (nx, my)
            Displacement over contact compliance [Pa m], positive into the half-space.
        """
        nx, my = self.shape
        mx, padded_my = self._padded
        size, scaled = _of_order_one(pressure, self._number)
        # Only the columns that hold data are transformed along x, forth and back.
        columns = fft.rfft(scaled, mx, axis=0, workers=self.threads)
        spectrum = fft.dct(columns, type=2, n=padded_my, axis=1, workers=self.threads)
        spectrum *= self._symbol
        columns = fft.idct(spectrum, type=2, axis=1, overwrite_x=True, workers=self.threads)
        lines = fft.irfft(columns[:, :my], mx, axis=0, workers=self.threads)
        return np.asarray(lines[:nx] * size)


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
    threads : int
        Threads of one transform.

    References
    ----------
    K. L. Johnson, Contact Mechanics, Cambridge (1985), eq. 13.7; H. M. Stanley, T. Kato, J.
    Tribol. 119 (1997) 481.

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
        threads: int = 1,
    ) -> None:
        self.shape = shape
        self.threads = threads
        self._number = np.float32 if single else np.float64
        half = np.pi * _frequencies(shape, cell_size)  # |q|/2
        half[0, 0] = np.inf
        self._symbol = (1 / half).astype(self._number)

    def apply(self, pressure: NDArray[np.float64]) -> NDArray[np.float64]:
        """Displacement of every cell under a pressure, per unit contact compliance.

        Parameters
        ----------
        pressure : ndarray, shape (nx, ny)
            Pressure on the cells [Pa], positive in compression.

        Returns
        -------
        ndarray, shape (nx, ny)
            Displacement over contact compliance [Pa m], positive into the half-space; its mean
            is zero.
        """
        size, scaled = _of_order_one(pressure, self._number)
        spectrum = fft.rfft2(scaled, workers=self.threads)
        spectrum *= self._symbol
        moved = fft.irfft2(spectrum, s=self.shape, overwrite_x=True, workers=self.threads)
        return np.asarray(moved * size)


class Preconditioner:
    """A cheap rough inverse of the convolution: |q|/2, the half-space's exact inverse symbol.

    It works on the unpadded block and in single precision. Neither spoils the solution, for a
    preconditioner only shapes the search directions.

    Parameters
    ----------
    shape : tuple of int
        Cells (nx, ny).
    cell_size : tuple of float
        Edge lengths (dx, dy) of a cell [m].
    mirrored : bool
        Whether the block is one half of a problem that is even across y = 0.
    threads : int
        Threads of one transform.

    References
    ----------
    K. L. Johnson, Contact Mechanics, Cambridge (1985), eq. 13.7: a wavy pressure of wave
    number q displaces the surface by 2 p/(q E*).
    """

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        *,
        mirrored: bool = False,
        threads: int = 1,
    ) -> None:
        self._forth, self._back = _even_across(shape) if mirrored else _periodic(shape)
        self._threads = threads
        # Along the axis transformed first (x if mirrored, else y) a real transform keeps half.
        if mirrored:
            wave_x = fft.rfftfreq(shape[0], cell_size[0])
            wave_y = np.arange(shape[1]) / (2 * shape[1] * cell_size[1])
            waves = np.hypot(wave_x[:, None], wave_y[None, :])
        else:
            waves = _frequencies(shape, cell_size)
        self._symbol = np.pi * waves.astype(np.float32)

    def apply(self, displacement: NDArray[np.float64]) -> NDArray[np.float64]:
        """Pressure that would cause about this displacement, per unit contact compliance.

        Parameters
        ----------
        displacement : ndarray, shape (nx, ny)
            Displacement of the cells [m].

        Returns
        -------
        ndarray, shape (nx, ny)
            Pressure times contact compliance [1]; its mean is zero.
        """
        size, scaled = _of_order_one(displacement, np.float32)
        spectrum = self._forth(scaled, workers=self._threads)
        spectrum *= self._symbol
        pressure = self._back(spectrum, workers=self._threads)
        return np.asarray(pressure * size)


def _of_order_one(field: NDArray[np.float64], number: type) -> tuple[np.float64, NDArray[Any]]:
    """A field's largest value, and the field by it: single precision has few exponents."""
    size = np.float64(max(float(field.max()), -float(field.min())) or 1.0)
    return size, np.divide(field, size, dtype=np.float64).astype(number, copy=False)


def _frequencies(shape: tuple[int, int], cell_size: tuple[float, float]) -> NDArray[np.float64]:
    """Waves per length, |q|/(2π), in the order of a real transform in two dimensions [1/m]."""
    along, across = fft.fftfreq(shape[0], cell_size[0]), fft.rfftfreq(shape[1], cell_size[1])
    return np.asarray(np.hypot(along[:, None], across[None, :]))


def _distances(padded: int, cells: int) -> NDArray[np.intp]:
    """Offsets 0, 1, 2, ..., 2, 1 in the order in which an FFT wants a centred even kernel.

    Those beyond the block stand in the padding and are never read; any value will do.
    """
    index = np.arange(padded)
    return np.minimum(np.minimum(index, padded - index), cells - 1)


Transform = Callable[..., NDArray[Any]]


def _periodic(shape: tuple[int, int]) -> tuple[Transform, Transform]:
    return fft.rfft2, partial(fft.irfft2, s=shape)


def _even_across(shape: tuple[int, int]) -> tuple[Transform, Transform]:
    def forth(field: NDArray[Any], workers: int) -> NDArray[Any]:
        rows = fft.dct(field, type=2, axis=1, workers=workers)
        return np.asarray(fft.rfft(rows, axis=0, workers=workers))

    def back(spectrum: NDArray[Any], workers: int) -> NDArray[Any]:
        columns = fft.irfft(spectrum, shape[0], axis=0, workers=workers)
        return np.asarray(fft.idct(columns, type=2, axis=1, workers=workers))

    return forth, back
