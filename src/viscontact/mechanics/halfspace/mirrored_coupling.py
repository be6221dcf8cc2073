"""Maps between traction along the surface and displacement into it, of mirrored contacts.

The pressure is even across each mirror plane; the traction across the plane is odd there, the other
component even. Only cells with positive coordinates along mirrored axes are kept, and transformed
by cosines and sines there (`mirrored_shear`), and by Fourier transforms along the other axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.transforms import (
    Transforms,
    fast_length,
    fastest_transforms,
    transforms_by,
)
from viscontact.mechanics.halfspace.coupling_influence import CouplingTables
from viscontact.mechanics.halfspace.halved_shear import mirrored_waves, part_along
from viscontact.mechanics.halfspace.shear_filter import in_single, wrapped


class MirroredCouplingFilter:
    """Maps of a unit coupling c J = 1 on the cells beyond the mirror planes of a block [m]."""

    def __init__(
        self,
        tables: CouplingTables,
        mirrored: tuple[bool, bool],
        periodic: tuple[bool, bool],
        transforms: Transforms | None = None,
    ) -> None:
        self._tables, self._mirrored, self._periodic = tables, mirrored, periodic
        self._number: np.dtype[Any] = np.dtype(np.float64)
        self._transforms = transforms or transforms_by(fastest_transforms())
        counts = tables.along_x.shape
        nx, ny = (n // 2 if even else n for n, even in zip(counts, mirrored, strict=True))
        self.shape = nx, ny
        self._lengths = [
            n if repeats else fast_length(n if even else 2 * n - 1)
            for n, even, repeats in zip(counts, mirrored, periodic, strict=True)
        ]
        #: Axis of Fourier transforms, if any.
        self._plain = mirrored.index(False) if not all(mirrored) else None
        self._symbol = tuple(
            self._waves(table, own) for own, table in enumerate((tables.along_x, tables.along_y))
        )

    def within(self, shape: tuple[int, int]) -> MirroredCouplingFilter:
        """The same maps on a smaller block, of a shape without mirror images."""
        nx, ny = (n * (1 + even) for n, even in zip(shape, self._mirrored, strict=True))
        tables = self._tables.within((nx, ny))
        return MirroredCouplingFilter(tables, self._mirrored, self._periodic, self._transforms)

    def in_single(self) -> MirroredCouplingFilter:
        """The same maps in single precision."""
        same = copy(self)
        same._number = np.dtype(np.float32)
        same._symbol = tuple(in_single(each) for each in self._symbol)
        return same

    def normal(self, traction: Floats) -> Floats:
        """Displacement into the surface under tractions along it [Pa m]."""
        terms = []
        for own, (field, symbol) in enumerate(zip(traction, self._symbol, strict=True)):
            spectrum = self._forward(field, own)
            if self._mirrored[own]:  # sines of k = 1, 2, ... M to cosines of k = 0, 1, ...
                moved = np.zeros_like(spectrum)
                moved[part_along(own, slice(1, None))] = spectrum[part_along(own, slice(-1))]
                spectrum = moved
            terms.append(spectrum * symbol)
        return self._inverse(terms[0] + terms[1], None)

    def along(self, pressure: Floats) -> Floats:
        """Displacement along the surface under pressure [Pa m], (2, nx, ny)."""
        spectrum, found = self._forward(pressure, None), []
        for own, symbol in enumerate(self._symbol):
            if self._mirrored[own]:
                moved = np.zeros_like(spectrum)
                given = spectrum * symbol
                moved[part_along(own, slice(-1))] = given[part_along(own, slice(1, None))]
            else:
                moved = spectrum * -symbol
            found.append(self._inverse(moved, own))
        return np.stack(found)

    def _waves(self, table: Floats, own: int) -> Numbers:
        """Symbol of a kernel that is odd along an axis: of sines to cosines, or imaginary."""
        found: Numbers = table
        factor: complex = 1.0
        if self._plain is not None:
            sign = -1 if self._plain == own else 1
            kernel = wrapped(table, self._plain, self._lengths[self._plain], sign)
            waves = np.fft.rfft(kernel, axis=self._plain)
            found, factor = (waves.imag, 1j) if sign < 0 else (waves.real, 1.0)
        for axis in (0, 1):
            if self._mirrored[axis]:
                found = mirrored_waves(found, self._lengths, axis, -1 if axis == own else 1)
                found = found[part_along(axis, slice(-1))]
                factor = -factor if axis == own else factor
        return np.ascontiguousarray(found) * factor

    def _forward(self, field: Floats, odd: int | None) -> Numbers:
        """Spectrum of a padded field that is odd along one axis, if that is mirrored."""
        transforms, shape = self._transforms, self.shape
        first, last = self._order
        # Lines that are padded only are not transformed along the first axis.
        lines = self._empty([shape[at] if at == last else self._lengths[at] for at in (0, 1)])
        lines[: shape[0], : shape[1]] = field
        lines = self._turned(lines, first, odd)
        padded = self._empty(self._lengths)
        padded[part_along(last, slice(shape[last]))] = lines
        if self._plain is None:
            return self._turned(padded, last, odd)
        waves = list(self._lengths)
        waves[last] = waves[last] // 2 + 1
        kind = np.result_type(self._number, np.complex64)
        return transforms.real_forward(padded, np.empty(waves, kind), last)

    def _empty(self, lengths: Sequence[int]) -> Floats:
        """Field of zeros."""
        return np.zeros(lengths, self._number)

    @property
    def _order(self) -> tuple[int, int]:
        """Axes in the order of the transforms: that of Fourier transforms is the last."""
        return (1, 0) if self._plain in (None, 0) else (0, 1)

    def _turned(self, field: Floats, axis: int, odd: int | None) -> Floats:
        """Sines or cosines of a field along a mirrored axis, in its place."""
        transforms = self._transforms
        turn = transforms.sine_forward if axis == odd else transforms.cosine_forward
        return turn(field, axis)

    def _inverse(self, spectrum: Numbers, odd: int | None) -> Floats:
        """Field of a spectrum, odd along one axis if that is mirrored, without what was padded."""
        first, last = self._order
        if self._plain is None:
            field = self._turned_back(spectrum, last, odd)
        else:
            spare = np.empty(self._lengths, self._number)
            field = self._transforms.real_inverse(spectrum, spare, last)
        lines = np.ascontiguousarray(field[part_along(last, slice(self.shape[last]))])
        lines = self._turned_back(lines, first, odd)
        return np.asarray(lines[: self.shape[0], : self.shape[1]])

    def _turned_back(self, spectrum: Floats, axis: int, odd: int | None) -> Floats:
        """Field of sines or cosines along a mirrored axis, in its place."""
        transforms = self._transforms
        turn = transforms.sine_inverse if axis == odd else transforms.cosine_inverse
        return turn(spectrum, axis)
