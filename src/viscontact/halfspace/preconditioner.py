"""Preconditioner of the contact solver: the half-space's inverse symbol."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.fourier import Transforms
from viscontact.halfspace.moving_load import MovingCompliance
from viscontact.halfspace.spectral import Spectra


class Preconditioner:
    """Approximate inverse of the convolution: |q|/2, the exact inverse symbol of the half-space.

    It acts on the unpadded block in single precision. The solution does not depend on this
    accuracy, only the search directions do. `mirrored`: the block is one half of a problem that is
    even across x = 0, and across y = 0.
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
        """Pressure times contact compliance [-] for about this displacement [m]; zero mean."""
        return self._spectra.filtered(displacement, self._symbol)


class MovingPreconditioner(Preconditioner):
    """Approximate inverse of the convolution with `moving_influence_table`: |q|/2 over J*(k V).

    A wave's complex compliance delays pressure behind displacement; its modulus alone would take
    more search directions. `apply` returns a pressure [Pa].
    """

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        compliance: MovingCompliance,
        axis: int,
        *,
        mirrored: tuple[bool, bool] = (False, False),
        transforms: Transforms | None = None,
    ) -> None:
        super().__init__(shape, cell_size, mirrored=mirrored, transforms=transforms)
        along = self._spectra.factor_along(axis, lambda wave: 1 / compliance.at_wave_number(wave))
        self._symbol = (self._spectra.half_wave_numbers * along).astype(np.complex64)
