"""Preconditioner of the contact solver: the surface's inverse symbol."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from functools import cached_property
from typing import Any, Self

import numpy as np

from viscontact.backend.arrays import Floats, Integers, Numbers
from viscontact.backend.compiled_filter import CompiledFilter
from viscontact.backend.team import Team, Workspace
from viscontact.backend.transforms import Field, Transforms
from viscontact.mechanics.halfspace.moving_load import MovingCompliance
from viscontact.mechanics.halfspace.spectral import Spectra, SpectrumFilter
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse

#: Wave numbers per decade between which the response of layers is interpolated.
WAVES_PER_DECADE = 50


class Preconditioner:
    """Approximate inverse of the convolution, by the exact inverse symbol |q|/(2 L)."""

    # It acts on the unpadded block in single precision: only the search directions depend on it.

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        *,
        response: SurfaceResponse = HALF_SPACE,
        mirrored: tuple[bool, bool] = (False, False),
        transforms: Transforms | None = None,
        workspace: Workspace | None = None,
        team: Team | None = None,
    ) -> None:
        self._spectra = Spectra(shape, cell_size, mirrored, np.float32, transforms, workspace, team)
        if response is HALF_SPACE:
            half = self._spectra.half_wave_numbers
            self._least = self._filter = self._filter_by(half.astype(np.float32))
        else:
            self._set_ratios(response.ratio(self.waves))

    def with_ratios(self, ratios: Floats) -> Self:
        """Block of another surface, of the ratios L at `waves`."""
        other = copy(self)
        other._set_ratios(ratios)
        return other

    def _filter_by(self, symbol: Numbers) -> SpectrumFilter:
        return SpectrumFilter(self._spectra, symbol)

    @property
    def waves(self) -> Floats:
        """Wave numbers between which the response of layers is interpolated [1/m]."""
        return self._interpolation[0]

    @cached_property
    def _interpolation(self) -> tuple[Floats, Integers, Floats]:
        """Wave numbers, the one before each entry of a spectrum, and its place behind that."""
        q = 2 * self._spectra.half_wave_numbers
        least, largest = q[q > 0].min(), q.max()
        count = 1 + int(WAVES_PER_DECADE * np.log10(largest / least))
        place = np.log(np.maximum(q, least) / least) * (count / np.log(largest / least))
        before = np.minimum(place.astype(np.intp), count - 1)
        return np.geomspace(least, largest, count + 1), before, place - before

    def _set_ratios(self, ratios: Floats) -> None:
        """Divide |q|/2 by L, whose logarithm is linear in that of the wave number."""
        # Of a sum of several terms, rounding may be negative where nothing is left.
        known = np.log(np.maximum(np.abs(ratios), np.finfo(float).tiny))
        half = self._spectra.half_wave_numbers
        self._least = self._filter_by((half / np.exp(known.max())).astype(np.float32))
        symbol = half / np.exp(self._interpolated(known))
        # The mean of a block is a wave of about the longest length in it, not of none.
        symbol[0, 0] = min([*symbol[0, 1:2], *symbol[1:2, 0]])
        self._filter = self._filter_by(symbol.astype(np.float32))

    def _interpolated(self, known: Floats) -> Floats:
        """Values at all wave numbers, linear in the logarithm, from those at `waves`."""
        _, before, part = self._interpolation
        return np.asarray(known[before] + np.diff(known)[before] * part)

    @property
    def compiled(self) -> tuple[CompiledFilter | None, CompiledFilter | None]:
        """Filters of `apply` and `stiffness_of` in the compiled core, where that can do them."""
        return self._filter.compiled, self._least.compiled

    def apply(self, displacement: Field, into: Field | None = None) -> Field:
        """Pressure times contact compliance [-] for about this displacement [m]; zero mean."""
        return self._filter.apply(displacement, into)

    def stiffness_of(self, cells: Field, into: Field | None = None) -> Field:
        """Stiffness where some cells are displaced by 1, others by 0 [1/m]."""
        # That of the stiffest half-space that is nowhere stiffer than the surface.
        return self._least.apply(cells, into)


class MovingPreconditioner(Preconditioner):
    """Approximate inverse of the convolution with a moving table: |q|/2 over Σ L J*(k V) [Pa]."""

    # The complex compliance delays pressure behind displacement; its modulus alone would take more
    # search directions.

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        terms: Sequence[tuple[SurfaceResponse, MovingCompliance]],
        axis: int,
        *,
        mirrored: tuple[bool, bool] = (False, False),
        transforms: Transforms | None = None,
    ) -> None:
        super().__init__(shape, cell_size, mirrored=mirrored, transforms=transforms)
        waves = self._spectra.wave_numbers[axis]
        waves = waves[:, None] if axis == 0 else waves[None, :]
        total: Any = 0.0
        for response, compliance in terms:
            own = compliance.at_wave_number(waves)
            total = total + (own if response is HALF_SPACE else self._ratios_of(response) * own)
        inverse = self._spectra.real_at_shortest(axis, np.asarray(1 / total))
        symbol = self._spectra.half_wave_numbers * inverse
        if any(response is not HALF_SPACE for response, _ in terms):  # as of layers at rest
            symbol[0, 0] = min(abs(each) for each in (*symbol[0, 1:2], *symbol[1:2, 0]))
        self._filter = self._filter_by(symbol.astype(np.complex64))

    def _ratios_of(self, response: SurfaceResponse) -> Floats:
        """L at all wave numbers; that of a term may be negative [-]."""
        known = response.ratio(self.waves)
        if (known > 0).all():
            return np.asarray(np.exp(self._interpolated(np.log(known))))
        return self._interpolated(known)
