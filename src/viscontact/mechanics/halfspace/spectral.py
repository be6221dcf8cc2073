"""Spectral operators of the surface: exact on a periodic grid, approximate elsewhere.

A pressure wave of wave number q displaces the surface of a half-space by 2 p/|q| per unit contact
compliance, that of layers by L(q) times as much.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), eq. 13.7; H. M. Stanley, T. Kato, J.
Tribol. 119 (1997) 481.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from functools import partial
from typing import Any, Self, TypeAlias

import numpy as np

from viscontact.backend.arrays import Complexes, Floats, Numbers
from viscontact.backend.compiled_filter import CompiledFilter, compiled_filter
from viscontact.backend.team import Team, Workspace, blocks_of, order_of
from viscontact.backend.transforms import (
    Field,
    Transforms,
    fastest_transforms,
    fill_of_order,
    multiply_by_even,
    restore_of_order,
    transforms_by,
)
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse

#: Factor of waves by their wave numbers along the motion [1/m].
WaveFactor: TypeAlias = Callable[[Floats], Complexes]


class PeriodicConvolution:
    """Surface displacement of a half-space, or of layers, whose load is periodic in x and y.

    A circular convolution with the exact symbol 2 L/|q|. A mean pressure displaces a half-space
    without limit: displacement counts from the mean plane, so its mean is zero; on a rigid base
    from the free surface.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        response: SurfaceResponse = HALF_SPACE,
        *,
        single: bool = False,
        transforms: Transforms | None = None,
        workspace: Workspace | None = None,
        team: Team | None = None,
    ) -> None:
        self.shape = shape
        number = np.float32 if single else np.float64
        given = transforms, workspace, team
        self._spectra = Spectra(shape, cell_size, (False, False), number, *given)
        half = self._spectra.half_wave_numbers
        half[0, 0] = np.inf  # q = 0 comes below
        symbol = 1 / half
        if response is not HALF_SPACE:
            symbol *= _ratios(response, half)
        # On a half-space the mean pressure leaves the mean plane where it is.
        mean = response.mean_displacement
        self._has_datum = bool(np.isfinite(mean))
        symbol[0, 0] = mean if self._has_datum else 0.0
        self._filter = SpectrumFilter(self._spectra, symbol.astype(number))

    def sum_of(self, parts: Sequence[Self], weights: Sequence[float]) -> Self:
        """Weighted sum of operators on the same block, in the precision of this one."""
        total = copy(self)
        pairs = zip(weights, parts, strict=True)
        symbol = np.asarray(sum(weight * part._filter.symbol for weight, part in pairs))
        total._has_datum = all(part._has_datum for part in parts)
        if not total._has_datum:
            symbol[0, 0] = 0.0
        total._filter = SpectrumFilter(self._spectra, symbol.astype(self._spectra.number))
        return total

    @property
    def compiled(self) -> CompiledFilter | None:
        """The same in the compiled core; None where that cannot do it."""
        return self._filter.compiled

    @property
    def workspace(self) -> Workspace:
        """Memory that it works in."""
        return self._spectra.workspace

    def apply(self, pressure: Field, into: Field | None = None) -> Field:
        """Displacement over compliance [Pa m] under a pressure [Pa]; written to `into` if given."""
        return self._filter.apply(pressure, into)


def _ratios(response: SurfaceResponse, half: Floats) -> Floats:
    """L at half wave numbers, of which the infinite ones stand for others [-]."""
    waves, places = np.unique(half, return_inverse=True)
    waves[-1] = waves[0]  # in place of infinity
    return np.asarray(response.ratio(2 * waves)[places].reshape(half.shape))


class MovingPeriodicConvolution(PeriodicConvolution):
    """`PeriodicConvolution` in steady motion: 2/|q| times Σ L(|q|) times complex factors by q."""

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        terms: Sequence[tuple[SurfaceResponse, WaveFactor]],
        axis: int,
        *,
        single: bool = False,
        transforms: Transforms | None = None,
    ) -> None:
        super().__init__(shape, cell_size, single=single, transforms=transforms)
        half = self._spectra.half_wave_numbers
        half[0, 0] = np.inf  # q = 0 comes below
        total: Any = 0.0
        mean = 0.0
        for response, factor in terms:
            along = self._spectra.factor_along(axis, factor)
            total = total + (along if response is HALF_SPACE else _ratios(response, half) * along)
            mean += response.mean_displacement * float(along.flat[0].real)
        symbol = np.asarray(self._filter.symbol * total)
        self._has_datum = bool(np.isfinite(mean))
        symbol[0, 0] = mean if self._has_datum else 0.0
        kind = np.complex64 if single else np.complex128
        self._filter = SpectrumFilter(self._spectra, symbol.astype(kind))


_multiply_rows = partial(multiply_by_even, axis=1)


class SpectrumFilter:
    """Product of the spectra of fields and one symbol, in the compiled core where it can do that.

    A real symbol is even along both axes, as every function of |q| is.
    """

    def __init__(self, spectra: Spectra, symbol: Numbers) -> None:
        self._spectra, self.compiled = spectra, spectra.compiled(symbol)
        self._symbol = None if self.compiled is not None else symbol

    @property
    def symbol(self) -> Numbers:
        """The symbol at all waves of a spectrum."""
        if self.compiled is not None:
            return self._spectra.at_all_waves(self.compiled.symbol)
        assert self._symbol is not None  # kept where the core does not keep it
        return self._symbol

    def apply(self, field: Field, into: Field | None = None) -> Field:
        """Return the filtered field, in an array if one is given."""
        if self.compiled is None:
            return self._spectra.filtered(field, self.symbol, into)
        return self.compiled.apply(field, into, self._spectra.workspace)


class Spectra:
    """Transforms of a block that is periodic, or even across its first line (`mirrored`)."""

    def __init__(
        self,
        shape: tuple[int, int],
        cell_size: tuple[float, float],
        mirrored: tuple[bool, bool],
        number: type,
        transforms: Transforms | None,
        workspace: Workspace | None = None,
        team: Team | None = None,
    ) -> None:
        self._transforms = transforms or transforms_by(fastest_transforms())
        self._even = [axis for axis in (0, 1) if mirrored[axis]]
        # A real transform comes first, which keeps half of its spectrum; then a complex one.
        self._fourier = [axis for axis in (1, 0) if not mirrored[axis]]
        waves = [self._waves(axis, shape[axis], cell_size[axis]) for axis in (0, 1)]
        #: Signed wave numbers along x and y, in the order of the transform [1/m].
        self.wave_numbers = 2 * np.pi * waves[0], 2 * np.pi * waves[1]
        self._shape, self._number = shape, np.dtype(number)
        self._workspace, self._team = workspace or Workspace(), team or Team()
        kind = np.result_type(self._number, np.complex64)
        self._spectrum = (len(waves[0]), len(waves[1])), kind
        self._rows = blocks_of(shape[0], shape[1] * self._number.itemsize)
        self._wave_rows = blocks_of(len(waves[0]), len(waves[1]) * kind.itemsize)

    @property
    def number(self) -> np.dtype[Any]:
        """Kind of the numbers of fields."""
        return self._number

    @property
    def half_wave_numbers(self) -> Floats:
        """|q|/2 at each entry of a spectrum, a new array [1/m]."""
        x, y = self.wave_numbers
        return np.asarray(np.hypot(x[:, None], y[None, :]) / 2)

    def compiled(self, symbol: Numbers) -> CompiledFilter | None:
        """Filter of the compiled core by a symbol, where it can do that."""
        axes = [self._shape[axis] for axis in (0, 1)]
        halves = [
            slice(None) if axis in self._even else slice(axes[axis] // 2 + 1) for axis in (0, 1)
        ]
        even = 0 in self._even, 1 in self._even
        given = self._team, self._shape, self._shape, even, symbol[halves[0], halves[1]]
        return compiled_filter(*given, single=self._number == np.float32)

    def at_all_waves(self, symbol: Floats) -> Floats:
        """A symbol that is even along both axes, of that of waves that are not negative."""
        (first, second), _ = self._spectrum
        x, y = (
            np.minimum(np.arange(count), abs(self._shape[axis] - np.arange(count)))
            if axis in self._fourier
            else np.arange(count)
            for axis, count in enumerate((first, second))
        )
        return np.asarray(symbol[np.ix_(x, y)])

    def filtered(
        self,
        field: Field,
        symbol: Numbers,
        into: Field | None = None,
    ) -> Field:
        """Field whose spectrum is that of the given field times a symbol."""
        rows, team = self._rows, self._team
        size = order_of(field, rows, self._number, team)
        block, spectrum = self._workspace.arrays((self._shape, self._number), self._spectrum)
        team.each_rows(partial(fill_of_order, size), rows, block, field)
        spectrum = self._transform(block, spectrum)
        team.each_rows(_multiply_rows, self._wave_rows, spectrum, symbol)
        back = self._transform_back(spectrum, block)
        found = np.empty(self._shape) if into is None else into
        team.each_rows(partial(restore_of_order, size), rows, back, found)
        return found

    @property
    def workspace(self) -> Workspace:
        """Memory that filters work in."""
        return self._workspace

    def factor_along(self, axis: int, factor: WaveFactor) -> Complexes:
        """Factor of each entry of a spectrum by its wave number along an axis [1/m]."""
        values = np.asarray(factor(self.wave_numbers[axis]), dtype=np.complex128)
        return self.real_at_shortest(axis, values[:, None] if axis == 0 else values[None, :])

    def real_at_shortest(self, axis: int, values: Complexes) -> Complexes:
        """Factors, real at the shortest wave of an even number of cells, its own mirror image."""
        cells = self._shape[axis]
        if cells % 2 == 0:
            shortest = (cells // 2,) if axis == 0 else (slice(None), cells // 2)
            values[shortest] = values[shortest].real
        return values

    def _transform(self, block: Numbers, spectrum: Numbers) -> Numbers:
        for axis in self._even:
            block = self._transforms.cosine_forward(block, axis)
        if self._fourier:
            block = self._transforms.real_forward(block, spectrum, self._fourier[0])
        for axis in self._fourier[1:]:
            block = self._transforms.complex_forward(block, axis)
        return block

    def _transform_back(self, spectrum: Numbers, block: Numbers) -> Numbers:
        for axis in self._fourier[1:]:
            spectrum = self._transforms.complex_inverse(spectrum, axis)
        if self._fourier:
            spectrum = self._transforms.real_inverse(spectrum, block, self._fourier[0])
        for axis in self._even:
            spectrum = self._transforms.cosine_inverse(spectrum, axis)
        return spectrum

    def _waves(self, axis: int, cells: int, edge: float) -> Floats:
        """Waves per length along an axis, |q|/(2π), in the order of its transform [1/m]."""
        if axis in self._even:
            return np.arange(cells) / (2 * cells * edge)
        frequencies = np.fft.rfftfreq if axis == self._fourier[0] else np.fft.fftfreq
        return np.asarray(frequencies(cells, edge))
