"""Preconditioner of the contact solver: the half-space's inverse symbol."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.fourier import (
    Transforms,
)
from viscontact.halfspace.spectral import Spectra


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
    mirrored : tuple of bool
        Whether the block is one half of a problem that is even across x = 0, and across y = 0.
    transforms : Transforms, optional
        Who transforms; the fastest that are installed when left out.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        *,
        mirrored: tuple[bool, bool] = (False, False),
        transforms: Transforms | None = None,
    ) -> None:
        self._spectra = Spectra(shape, cell_size, mirrored, np.float32, transforms)
        self._symbol = self._spectra.half_wave_numbers.astype(np.float32)

    def apply(self, displacement: NDArray[np.float64]) -> NDArray[np.float64]:
        """Pressure that would cause about this displacement, per unit contact compliance.

        Parameters
        ----------
        displacement : ndarray, shape (nx, ny)
            Displacement of the cells [m].

        Returns
        -------
        ndarray, shape (nx, ny)
            Pressure times contact compliance [-]; its mean is zero.
        """
        return self._spectra.filtered(displacement, self._symbol)
