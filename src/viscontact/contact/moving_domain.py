"""Half-space operators on a grid that moves with a body at constant speed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.domain import ContactDomain
from viscontact.contact.response_parts import Operator
from viscontact.fourier import Transforms
from viscontact.grid import Grid
from viscontact.halfspace.convolution import Convolution
from viscontact.halfspace.influence import influence_coefficient
from viscontact.halfspace.moving_load import (
    Coefficient,
    MovingCompliance,
    moving_influence_table,
)
from viscontact.halfspace.periodic_influence import periodic_influence_coefficient
from viscontact.halfspace.preconditioner import MovingPreconditioner
from viscontact.halfspace.spectral import MovingPeriodicConvolution

#: Fewest cells of a coarser grid along an axis.
COARSEST = 32


class MovingDomain(ContactDomain):
    """Half-space under a body in steady motion, in the coordinates of the body.

    The unit displacement is that of the moving contact over a reference compliance
    (`compliance`): that of a wave as long as the grid, so that it has the size of an elastic one.
    Only evenness across the motion halves the problem. The grid may be periodic across the motion,
    or along both axes, under a body that is periodic itself.

    `axis` is that of the motion, which is towards its positive end; `mirrored` means even across
    it. `added` is an elastic compliance added to the operator [1/Pa], for the proximal point
    method; `moving_table` the influence table without it, if it is known.
    """

    def __init__(
        self,
        grid: Grid,
        moving_compliance: MovingCompliance,
        axis: int,
        *,
        mirrored: bool = False,
        added: float = 0.0,
        transforms: Transforms | None = None,
        moving_table: NDArray[np.float64] | None = None,
    ) -> None:
        self.moving_compliance, self.axis = moving_compliance, axis
        self._added, self._moving_table = added, moving_table
        self._coefficient = _coefficient_on(grid, axis)
        wave = np.array(2 * np.pi / grid.size[axis])
        #: Compliance that unit displacements are relative to [1/Pa].
        self.compliance = abs(complex(moving_compliance.at_wave_number(wave)))
        even = (mirrored and axis == 1, mirrored and axis == 0)
        super().__init__(grid, mirrored=even, transforms=transforms)

    def coarser(self) -> MovingDomain | None:
        """Same region in cells twice as long and wide; None if their number is odd or too small.

        An axis with a single cell keeps it.
        """
        shape = coarser_shape(self.grid.shape)
        if shape is None or np.any(np.logical_and(self.mirrored, np.mod(shape, 2))):
            return None
        return self._on(replace(self.grid, shape=shape))

    def with_elastic(self, added: float) -> MovingDomain:
        """Same region with an elastic compliance added to the operator [1/Pa]."""
        return self._on(self.grid, added, self._moving_table)

    @cached_property
    def elastic(self) -> Operator:
        """Displacement per unit elastic compliance [Pa m] of pressure [Pa] on all cells."""
        if all(self.grid.periodic):
            return self._filtered(np.ones_like, self.shape)
        return self._convolved(self._elastic_table, self.shape)

    @cached_property
    def loss(self) -> Operator:
        """Slope of the delayed displacement, Σ (Ji/li) (K p - Ei K p) [-], of pressure [Pa]."""
        moving = self.moving_compliance
        if all(self.grid.periodic):
            return self._filtered(moving.loss_at_wave_number, self.shape)
        rates = replace(moving, instant=0.0, amplitudes=moving.amplitudes / moving.lengths)
        grid = self.grid
        delayed = moving_influence_table(
            grid.shape, grid.cell_size, rates, self.axis, self._coefficient
        )
        lost = rates.relaxed * self._elastic_table - delayed
        return self._convolved(lost + self._drift, self.shape)

    @property
    def _drift(self) -> float:
        """Slope of the surface behind a line contact by its old creep, per pressure of a cell [-].

        The deflection of a strip falls as -(2/π) F ln(distance) with the force F on its length.
        """
        if self.grid.has_datum:
            return 0.0
        across = self.grid.shape[1 - self.axis]
        force = self.grid.cell_size[self.axis] / across
        return 2 / np.pi * force * self.moving_compliance.drift

    def _on(
        self, grid: Grid, added: float = 0.0, moving_table: NDArray[np.float64] | None = None
    ) -> MovingDomain:
        return MovingDomain(
            grid,
            self.moving_compliance,
            self.axis,
            mirrored=any(self.mirrored),
            added=added,
            transforms=self._transforms,
            moving_table=moving_table,
        )

    @cached_property
    def _elastic_table(self) -> NDArray[np.float64]:
        rest = MovingCompliance(1.0, np.empty(0), np.empty(0))
        return moving_influence_table(
            self.grid.shape, self.grid.cell_size, rest, self.axis, self._coefficient
        )

    def _influence_table(self) -> NDArray[np.float64]:
        if all(self.grid.periodic):
            return np.empty((0, 0))
        if self._moving_table is None:
            relative = self.moving_compliance.scaled(1 / self.compliance)
            self._moving_table = moving_influence_table(
                self.grid.shape, self.grid.cell_size, relative, self.axis, self._coefficient
            )
            if not self.grid.has_datum:  # from the farthest place on, as that of the memory is far
                self._moving_table -= self._drift / self.compliance * self._offsets
                self._moving_table -= self._moving_table.min()
        if not self._added:
            return self._moving_table
        return self._moving_table + self._added / self.compliance * self._elastic_table

    @property
    def _offsets(self) -> NDArray[np.float64]:
        """Signed offsets along the motion of the entries of a table, as a column or a row [m]."""
        count, cell = self.grid.shape[self.axis], self.grid.cell_size[self.axis]
        offsets = cell * np.arange(1 - count, count, dtype=np.float64)
        return offsets[:, None] if self.axis == 0 else offsets[None, :]

    def _preconditioner(self, shape: tuple[int, int]) -> MovingPreconditioner:
        total = self._relative
        options: Any = {"mirrored": self.mirrored, "transforms": self._transforms}
        return MovingPreconditioner(shape, self.grid.cell_size, total, self.axis, **options)

    @property
    def _relative(self) -> MovingCompliance:
        """Compliance of the operator over the reference one, with what is added [-]."""
        moving = self.moving_compliance
        return replace(moving, instant=moving.instant + self._added).scaled(1 / self.compliance)

    def _operator(self, shape: tuple[int, int], *, single: bool) -> Operator:
        if all(self.grid.periodic):
            return self._filtered(self._relative.at_wave_number, shape, single=single)
        return self._convolved(self._coefficients, shape, single=single)

    def _filtered(
        self,
        factor: Callable[[NDArray[np.float64]], NDArray[np.complex128]],
        shape: tuple[int, int],
        *,
        single: bool = False,
    ) -> MovingPeriodicConvolution:
        """Operator on a period by the factors of its waves along the motion."""
        size, transforms = self.grid.cell_size, self._transforms
        return MovingPeriodicConvolution(
            shape, size, factor, self.axis, single=single, transforms=transforms
        )

    def _convolved(
        self, table: NDArray[np.float64], shape: tuple[int, int], *, single: bool = False
    ) -> Operator:
        """Convolution with a table over a block of the domain's cells."""
        axis = self.axis
        along, across = shape[axis], shape[1 - axis] * (1 + any(self.mirrored))
        middle = table.shape[axis] // 2
        signed = slice(middle - along + 1, middle + along)
        part = (signed, slice(across)) if axis == 0 else (slice(across), signed)
        return Convolution(
            table[part],
            mirrored=self.mirrored,
            single=single,
            signed=axis,
            periodic=(self.grid.periodic[0], self.grid.periodic[1]),
            transforms=self._transforms,
        )


def _coefficient_on(grid: Grid, axis: int) -> Coefficient:
    """Influence coefficients of an elastic surface, with images across the motion if periodic."""
    if not grid.periodic[1 - axis]:
        return influence_coefficient
    period = grid.size[1 - axis]

    def with_images(
        along: NDArray[np.float64], across: NDArray[np.float64], cell: tuple[float, float]
    ) -> NDArray[np.float64]:
        if grid.shape[1 - axis] == 1:  # pieces of any length make the strip
            return periodic_influence_coefficient(across, along, (cell[0], cell[0]), cell[0], size)
        near = np.minimum(across, period - across)
        return periodic_influence_coefficient(near, along, cell[::-1], period, size)

    size = grid.size[axis]
    return with_images


def coarser_shape(shape: tuple[int, int]) -> tuple[int, int] | None:
    """Half the numbers of cells; None if they are odd or too small. A single cell is kept.

    Examples
    --------
    >>> coarser_shape((64, 1)), coarser_shape((64, 62))
    ((32, 1), None)
    """
    if max(shape) == 1 or any(n > 1 and (n % 2 or n < 2 * COARSEST) for n in shape):
        return None
    return max(shape[0] // 2, 1), max(shape[1] // 2, 1)
