"""From pressure to displacement, on the whole grid at once.

This module knows space, not time; the FFT back end, its threads and its number types live
here and nowhere else.
"""

from __future__ import annotations

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

    def __init__(self, coefficients: NDArray[np.float64], threads: int = 1) -> None:
        self.shape = coefficients.shape
        self.threads = threads
        self._padded = tuple(fft.next_fast_len(2 * n - 1, real=True) for n in self.shape)
        near, across = (
            _distances(padded, cells)
            for padded, cells in zip(self._padded, self.shape, strict=True)
        )
        kernel = coefficients[near[:, None], across[None, :]]
        # The wrapped kernel is even along both axes, so its transform is real.
        self._symbol = np.ascontiguousarray(fft.rfft2(kernel, workers=threads).real)

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
        # Only the rows that hold data are transformed along y, forth and back.
        rows = fft.rfft(pressure, my, axis=1, workers=self.threads)
        spectrum = fft.fft(rows, mx, axis=0, workers=self.threads)
        spectrum *= self._symbol
        columns = fft.ifft(spectrum, axis=0, overwrite_x=True, workers=self.threads)
        return np.asarray(
            fft.irfft(columns[:nx], my, axis=1, overwrite_x=True, workers=self.threads)[:, :ny]
        )


class Preconditioner:
    """A cheap rough inverse of `Convolution`: |q|/2, the half-space's exact inverse symbol.

    It works on the unpadded grid and in single precision. Neither spoils the solution, for a
    preconditioner only shapes the search directions.

    Parameters
    ----------
    shape : tuple of int
        Cells (nx, ny).
    cell_size : tuple of float
        Edge lengths (dx, dy) of a cell [m].
    threads : int
        Threads of one transform.

    References
    ----------
    K. L. Johnson, Contact Mechanics, Cambridge (1985), eq. 13.7: a wavy pressure of wave
    number q displaces the surface by 2 p/(q E*).
    """

    def __init__(
        self, shape: tuple[int, int], cell_size: tuple[float, float], threads: int = 1
    ) -> None:
        self.shape = shape
        self.threads = threads
        wave_x = 2 * np.pi * fft.fftfreq(shape[0], cell_size[0])[:, None]
        wave_y = 2 * np.pi * fft.rfftfreq(shape[1], cell_size[1])[None, :]
        self._symbol = (np.hypot(wave_x, wave_y) / 2).astype(np.float32)

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
        # Scaled to order one: single precision has a narrow range of exponents.
        size = float(np.abs(displacement).max()) or 1.0
        spectrum = fft.rfft2((displacement / size).astype(np.float32), workers=self.threads)
        spectrum *= self._symbol
        pressure = fft.irfft2(spectrum, self.shape, overwrite_x=True, workers=self.threads)
        return np.asarray(pressure * size, dtype=np.float64)


def _distances(padded: int, cells: int) -> NDArray[np.intp]:
    """Offsets 0, 1, 2, ..., 2, 1 in the order in which an FFT wants a centred even kernel.

    Those beyond the block stand in the padding and are never read; any value will do.
    """
    index = np.arange(padded)
    return np.minimum(np.minimum(index, padded - index), cells - 1)
