"""Cells of uniform pressure on a grid with two periods, whose operator takes samples.

There the convolution belongs to a pressure with no waves shorter than two cells, which has the
given values in the middle of the cells. A cell of uniform pressure has shorter ones, too. In a
middle they look like longer ones, so that a wave of cells, of wave number q, displaces the middles
by

    F(q) = Σ_G |q|/|q + G| sinc((q + G)_x d_x/2) sinc((q + G)_y d_y/2)

times what it does as samples, with G over all multiples of 2π over the edges d of a cell. Its terms
change sign along each axis; the outermost are weighed down, which sums such series fast.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.bodies.grid import Grid

#: Multiples of G on either side along each axis.
TERMS = 16


def as_samples(pressure: Floats, factor: Floats) -> Floats:
    """Values in the middle of cells that displace these as the cells of uniform pressure do.

    >>> factor = factor_of_cells(Grid((1, 4), (1.0, 4.0), periodic=True))
    >>> as_samples(np.array([[1.0, 0.0, 0.0, 0.0]]), factor).round(3).tolist()
    [[1.021, -0.042, 0.062, -0.042]]
    """
    return np.asarray(np.fft.irfft2(np.fft.rfft2(pressure) * factor, pressure.shape))


def factor_of_cells(grid: Grid) -> Floats:
    """F(q) of each entry of the spectrum of a real field [-]."""
    (nx, ny), (length, width) = grid.shape, grid.cell_size
    waves = np.fft.fftfreq(nx)[:, None], np.fft.rfftfreq(ny)[None, :]  # per cell
    total = np.zeros(np.broadcast_shapes(*(each.shape for each in waves)))
    orders = np.arange(-TERMS, TERMS + 1)
    shares = _shares(orders)
    for along, of_x in zip(orders, shares, strict=True):
        x = waves[0] + along
        for across, of_y in zip(orders, shares, strict=True):
            y = waves[1] + across
            wave = np.hypot(x / length, y / width)
            share = of_x * of_y * np.sinc(x) * np.sinc(y)
            total += np.divide(share, wave, out=np.zeros(total.shape), where=wave > 0)
    total *= np.hypot(waves[0] / length, waves[1] / width)
    total[0, 0] = 1.0
    return total


def _shares(orders: Integers) -> Floats:
    """Weights of terms that change sign, 1 in the middle and falling smoothly to the last."""
    place = np.clip((np.abs(orders) - TERMS / 2) / (TERMS / 2 + 1), 0.0, 1.0)
    return np.asarray(1 - place**3 * (10 - 15 * place + 6 * place**2))
