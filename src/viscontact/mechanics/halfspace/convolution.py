"""Discrete convolution of pressure and influence coefficients by zero-padded transforms."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from functools import cached_property, partial
from typing import NamedTuple, Self, TypeAlias

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.compiled_filter import compiled_filter
from viscontact.backend.team import Team, Workspace, blocks_of, order_of
from viscontact.backend.transforms import (
    Field,
    Transforms,
    as_reals,
    fastest_transforms,
    fill_of_order,
    multiply_by_even,
    restore_of_order,
    transforms_by,
)
from viscontact.mechanics.halfspace.kernel_spectrum import kernel_spectrum, padded_length

#: Work on a block of lines by a thread of that number.
_Work: TypeAlias = Callable[[slice, int], None]


class _PaddedLines(NamedTuple):
    """Lines that are longer than their data, and both parts of them."""

    whole: Numbers
    data: Numbers
    rest: Numbers


class Convolution:
    """Surface displacement of a half-space under cell pressures, by the DC-FFT algorithm.

    Zero padding makes the circular convolution linear: the result is the direct sum over all pairs
    of cells, to rounding (S. Liu, Q. Wang, G. Liu, Wear 243 (2000) 101); along a `periodic` axis it
    is circular. Along a `mirrored` axis, of an even number of cells, only those with positive
    coordinates are kept, and a half-sample even sequence convolved with an even kernel is its
    DCT-II times the kernel's transform (S. A. Martucci, IEEE Trans. Signal Process. 42 (1994)
    1038). `coefficients` [m] are those of the whole block, from `influence_table` or
    `periodic_layered_table`, even along both axes but for a `signed` one, with the 2 n - 1 offsets
    of `moving_influence_table`. Lines are padded, transformed and multiplied in blocks that stay in
    the cache; threads do not change a bit.
    """

    def __init__(  # noqa: PLR0913
        self,
        coefficients: Floats,
        *,
        mirrored: tuple[bool, bool] = (False, False),
        periodic: tuple[bool, bool] = (False, False),
        single: bool = False,
        signed: int | None = None,
        transforms: Transforms | None = None,
        team: Team | None = None,
        workspace: Workspace | None = None,
    ) -> None:
        transforms = transforms or transforms_by(fastest_transforms())
        counts = [
            (entries + 1) // 2 if axis == signed else entries
            for axis, entries in enumerate(coefficients.shape)
        ]
        self.shape = _mirrored_shape(counts, mirrored)
        self._lengths = [
            padded_length(cells, unpadded=mirrored[axis], exact=periodic[axis])
            for axis, cells in enumerate(counts)
        ]
        # A real Fourier transform comes first, and keeps half of its spectrum; then a complex one.
        self._first = first = 0 if mirrored == (False, True) else 1
        self._second = second = 1 - first
        self._even, self._signed = mirrored, signed
        self._number = np.dtype(np.float32 if single else np.float64)
        self._complex = np.result_type(self._number, np.complex64)
        self._team, self.workspace = team or Team(transforms.threads), workspace
        symbol = kernel_spectrum(coefficients, self._lengths, mirrored, first, transforms, signed)
        self._set_symbol(symbol)
        kind = self._number if mirrored[first] else self._complex
        waves = symbol.shape[first]
        self._lines = blocks_of(self.shape[second], self._lengths[first] * self._number.itemsize)
        self._waves = blocks_of(waves, self._lengths[second] * kind.itemsize)
        self._kinds, self._threads = (self._number, kind), transforms.threads
        #: Parts of these, by thread, axis and number of lines.
        self._kept: dict[tuple[int, int, int], _PaddedLines] = {}
        is_one_block = len(self._lines) == len(self._waves) == 1
        # Threads share the blocks out, or else the lines of the only one.
        self._transforms = transforms if is_one_block else transforms_by(transforms.name)
        #: Shape and kind of the spectrum along the first axis of cells with data.
        self._half = _shape(first, waves, self.shape[second]), np.dtype(kind)

    def sum_of(self, parts: Sequence[Self], weights: Sequence[float]) -> Self:
        """Weighted sum of operators on the same block, in the precision of this one."""
        total = copy(self)
        pairs = zip(weights, parts, strict=True)
        total._set_symbol(np.asarray(sum(weight * part._known_symbol for weight, part in pairs)))
        return total

    def _set_symbol(self, symbol: Numbers) -> None:
        """Multiply spectra by a symbol from now on: in the compiled core, where that can do it."""
        lengths = self._lengths[0], self._lengths[1]
        is_single = self._number == np.float32
        #: The same in the compiled core; None where that cannot do it.
        self.compiled = compiled_filter(
            *(self._team, self.shape, lengths, self._even, symbol), single=is_single
        )
        if self.compiled is None:
            kind = self._number if self._signed is None else self._complex
            self._symbol = symbol.astype(kind)

    @property
    def _known_symbol(self) -> Numbers:
        """The symbol, which the core has in an order of its own."""
        return self._symbol if self.compiled is None else self.compiled.symbol

    def apply(self, pressure: Field, into: Field | None = None) -> Field:
        """Displacement over compliance [Pa m] under a pressure [Pa]; written to `into` if given."""
        if self.compiled is not None:
            return self.compiled.apply(pressure, into, self.workspace)
        result = np.empty(self.shape) if into is None else into
        # 1. Scale the pressure to order one; 2. transform, multiply by the symbol, transform back;
        # 3. undo the scaling.
        size = order_of(pressure, self._lines, self._number, self._team, self._second)
        half = self._half_spectrum()
        self._for_each_block(self._lines, partial(self._transform, pressure, size, half))
        self._for_each_block(self._waves, partial(self._multiply, half))
        self._for_each_block(self._lines, partial(self._transform_back, result, size, half))
        return result

    @cached_property
    def _padded(self) -> list[tuple[Numbers, Numbers]]:
        """Padded lines for each thread, along the first and along the second axis."""
        first, second = self._first, self._second
        real, kind = self._kinds
        return [
            (
                np.zeros(_shape(first, self._lengths[first], self._lines[0].stop), real),
                np.zeros(_shape(second, self._lengths[second], self._waves[0].stop), kind),
            )
            for _ in range(self._threads)
        ]

    def _half_spectrum(self) -> Numbers:
        """Array for the spectrum along the first axis; in the padded lines if they hold it."""
        if len(self._waves) == 1:
            return self._padded_lines(0, 1, self._waves[0].stop).data
        return self.workspace.array(*self._half) if self.workspace else np.empty(*self._half)

    def _for_each_block(self, blocks: Sequence[slice], work: _Work) -> None:
        """Work on all blocks; with several threads, each takes every so many of them."""
        threads = min(len(blocks), len(self._padded))
        if threads == 1:
            for block in blocks:
                work(block, 0)
            return

        def share(thread: int) -> None:
            for block in blocks[thread::threads]:
                work(block, thread)

        self._team.each(share, range(threads))

    def _padded_lines(self, thread: int, axis: int, count: int) -> _PaddedLines:
        """A number of a thread's padded lines along the first (0) or the second axis."""
        key = thread, axis, count
        if key not in self._kept:
            along, across = (self._first, self._second)[:: 1 - 2 * axis]
            whole = _part(self._padded[thread][axis], across, slice(count))
            cells = self.shape[along]
            parts = (_part(whole, along, part) for part in (slice(cells), slice(cells, None)))
            self._kept[key] = _PaddedLines(whole, *parts)
        return self._kept[key]

    def _transform(
        self, pressure: Field, size: float, half: Numbers, lines: slice, thread: int
    ) -> None:
        """Transform lines of the pressure along the first axis."""
        first, second, transforms = self._first, self._second, self._transforms
        padded = self._padded_lines(thread, 0, lines.stop - lines.start)
        fill_of_order(size, padded.data, _part(pressure, second, lines))
        padded.rest[...] = 0
        spectrum = _part(half, second, lines)
        if self._even[first]:
            spectrum[...] = transforms.cosine_forward(padded.whole, first)
        else:
            transforms.real_forward(padded.whole, spectrum, first)

    def _multiply(self, half: Numbers, waves: slice, thread: int) -> None:
        """Transform waves along the second axis, multiply them by the symbol, transform back."""
        first, second, transforms = self._first, self._second, self._transforms
        spectrum = _part(half, first, waves)
        lines = self._padded_lines(thread, 1, waves.stop - waves.start)
        apart = len(self._waves) > 1
        if apart:
            lines.data[...] = spectrum
        lines.rest[...] = 0
        given = lines.whole
        found = self._along_second(transforms.cosine_forward, transforms.complex_forward, given)
        multiply_by_even(found, _part(self._symbol, first, waves), second)
        found = self._along_second(transforms.cosine_inverse, transforms.complex_inverse, found)
        if not apart and (found is given or np.may_share_memory(found, spectrum)):
            return  # in place
        spectrum[...] = _part(found, second, slice(self.shape[second]))

    def _transform_back(
        self, result: Field, size: float, half: Numbers, lines: slice, thread: int
    ) -> None:
        """Transform lines back along the first axis, into the result."""
        first, second, transforms = self._first, self._second, self._transforms
        spectrum = _part(half, second, lines)
        if self._even[first]:
            moved = transforms.cosine_inverse(spectrum, first)
        else:
            padded = self._padded_lines(thread, 0, lines.stop - lines.start).whole
            moved = transforms.real_inverse(spectrum, padded, first)
        moved = _part(moved, first, slice(self.shape[first]))
        restore_of_order(size, moved, _part(result, second, lines))

    def _along_second(
        self,
        cosine: Callable[[Numbers, int], Numbers],
        fourier: Callable[[Numbers, int], Numbers],
        spectrum: Numbers,
    ) -> Numbers:
        """Transform in place along the second axis; cosines act on real and imaginary parts."""
        if not self._even[self._second]:
            return fourier(spectrum, self._second)
        if self._even[self._first]:
            return cosine(spectrum, self._second)
        return cosine(as_reals(spectrum), self._second).view(spectrum.dtype)[..., 0]


def _mirrored_shape(shape: list[int], mirrored: tuple[bool, bool]) -> tuple[int, int]:
    nx, ny = (cells // (1 + even) for cells, even in zip(shape, mirrored, strict=True))
    return nx, ny


def _shape(axis: int, along: int, across: int) -> tuple[int, int]:
    """Shape of a number of lines along an axis, by their length and number."""
    return (along, across) if axis == 0 else (across, along)


def _part(field: Numbers, axis: int, part: slice) -> Numbers:
    """Part of a field along an axis, in the same memory."""
    return field[part] if axis == 0 else field[:, part]
