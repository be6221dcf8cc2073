"""From pressure to displacement, on the whole grid at once.

This module knows space, not time; the FFT back end, its threads and its number types live
here and nowhere else.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from viscontact.grid import Grid
from viscontact.influence import influence_coefficient


class Convolution:
    """The free half-space as an operator on cell pressures, by zero-padded real FFTs.

    Linear, not circular: the padding keeps the grid from seeing its own periodic images, so
    the result is the direct sum over all pairs of cells, to rounding.

    Parameters
    ----------
    grid : Grid
        The cells that carry pressure and displacement.
    threads : int
        Threads of one transform.

    Examples
    --------
    >>> import numpy as np
    >>> operator = Convolution(Grid((4, 4), (4.0, 4.0)))
    >>> pressure = np.zeros((4, 4))
    >>> pressure[1, 1] = 1.0
    >>> round(float(operator.apply(pressure)[1, 1]), 6)
    1.1222
    """

    def __init__(self, grid: Grid, threads: int = 1) -> None:
        self.shape = grid.shape
        self.threads = threads
        self._padded = tuple(fft.next_fast_len(2 * n - 1, real=True) for n in grid.shape)
        kernel = influence_coefficient(
            _wrapped_offsets(self._padded[0], grid.cell_size[0])[:, None],
            _wrapped_offsets(self._padded[1], grid.cell_size[1])[None, :],
            grid.cell_size,
        )
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
    grid : Grid
        The cells that carry pressure and displacement.
    threads : int
        Threads of one transform.

    References
    ----------
    K. L. Johnson, Contact Mechanics, Cambridge (1985), eq. 13.7: a wavy pressure of wave
    number q displaces the surface by 2 p/(q E*).
    """

    def __init__(self, grid: Grid, threads: int = 1) -> None:
        self.shape = grid.shape
        self.threads = threads
        dx, dy = grid.cell_size
        wave_x = 2 * np.pi * fft.fftfreq(grid.shape[0], dx)[:, None]
        wave_y = 2 * np.pi * fft.rfftfreq(grid.shape[1], dy)[None, :]
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


def _wrapped_offsets(cells: int, cell: float) -> NDArray[np.float64]:
    """Offsets 0, 1, 2, ..., -2, -1 cells: the order in which an FFT wants a centred kernel."""
    index = np.arange(cells)
    return np.where(index <= cells // 2, index, index - cells) * cell
