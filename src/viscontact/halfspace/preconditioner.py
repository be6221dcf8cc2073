"""Preconditioner of the contact solver: the surface's inverse symbol."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.fourier import Transforms
from viscontact.halfspace.moving_load import MovingCompliance
from viscontact.halfspace.spectral import Spectra
from viscontact.halfspace.surface_response import HALF_SPACE, SurfaceResponse

#: Wave numbers per decade between which the response of layers is interpolated.
WAVES_PER_DECADE = 50


class Preconditioner:
    """Approximate inverse of the convolution: |q|/(2 L), the exact inverse symbol of the surface.

    It acts on the unpadded block in single precision. The solution does not depend on this
    accuracy, only the search directions do. `mirrored`: the block is one half of a problem that is
    even across x = 0, and across y = 0.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        *,
        response: SurfaceResponse = HALF_SPACE,
        mirrored: tuple[bool, bool] = (False, False),
        transforms: Transforms | None = None,
    ) -> None:
        self._spectra = Spectra(shape, cell_size, mirrored, np.float32, transforms)
        symbol = self._spectra.half_wave_numbers
        if response is not HALF_SPACE:
            symbol = symbol / _ratios(response, 2 * symbol)
            # The mean of a block is a wave of about the longest length in it, not of none.
            symbol[0, 0] = min([*symbol[0, 1:2], *symbol[1:2, 0]])
        self._symbol = symbol.astype(np.float32)

    def apply(self, displacement: NDArray[np.float64]) -> NDArray[np.float64]:
        """Pressure times contact compliance [-] for about this displacement [m]; zero mean."""
        return self._spectra.filtered(displacement, self._symbol)


def _ratios(response: SurfaceResponse, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """L at all wave numbers [1/m], interpolated between enough of them; 1 where it is q = 0."""
    least, largest = q[q > 0].min(), q.max()
    waves = np.geomspace(least, largest, 2 + int(WAVES_PER_DECADE * np.log10(largest / least)))
    # Of a sum of several terms, rounding may be negative where nothing is left.
    known = np.log(np.maximum(np.abs(response.ratio(waves)), np.finfo(float).tiny))
    return np.asarray(np.exp(np.interp(np.log(np.maximum(q, least)), np.log(waves), known)))


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
