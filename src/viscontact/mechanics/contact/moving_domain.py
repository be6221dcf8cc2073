"""Surface operators on a grid that moves with a body at constant speed."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.transforms import Transforms
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.response_parts import Operator
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.ended_convolution import WeightedOperators
from viscontact.mechanics.halfspace.ended_response import EndedResponse, has_ends, parts_of
from viscontact.mechanics.halfspace.influence import influence_coefficient
from viscontact.mechanics.halfspace.layered_influence import (
    layered_influence_coefficient,
    periodic_layered_coefficient,
)
from viscontact.mechanics.halfspace.moving_load import (
    Coefficient,
    MovingCompliance,
    moving_influence_table,
)
from viscontact.mechanics.halfspace.moving_surface import MovingSurface
from viscontact.mechanics.halfspace.periodic_influence import periodic_influence_coefficient
from viscontact.mechanics.halfspace.preconditioner import MovingPreconditioner
from viscontact.mechanics.halfspace.spectral import MovingPeriodicConvolution, WaveFactor
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse

#: Compliance of a surface at rest.
REST = MovingCompliance(1.0, np.empty(0), np.empty(0))

#: Fewest cells of a coarser grid along an axis.
COARSEST = 32


class MovingDomain(ContactDomain):
    """Surface under a body in steady motion towards the positive end of `axis`, in its coordinates.

    The unit displacement is over a reference `compliance`, that of a wave as long as the grid, so
    that it has the size of an elastic one. `mirrored` means even across the motion. The grid may be
    periodic across the motion, or along both axes, under a body that is periodic itself. `added` is
    an elastic compliance [1/Pa], for the proximal point method; `moving_table` the influence table
    without it.
    """

    def __init__(
        self,
        grid: Grid,
        surface: MovingSurface,
        axis: int,
        *,
        mirrored: bool = False,
        added: float = 0.0,
        transforms: Transforms | None = None,
        moving_table: Floats | None = None,
    ) -> None:
        self.surface, self.axis = surface, axis
        self._added, self._moving_table = added, moving_table
        self._samples: dict[SurfaceResponse, Coefficient] = {}
        wave = 2 * np.pi / grid.size[axis]
        #: Compliance that unit displacements are relative to [1/Pa].
        self.compliance = abs(complex(surface.at_length(wave).at_wave_number(np.array(wave))))
        self._at_rest = surface.relaxed_response(wave)
        even = (mirrored and axis == 1, mirrored and axis == 0)
        super().__init__(grid, mirrored=even, transforms=transforms)

    def coarser(self) -> MovingDomain | None:
        """Same region in doubled cells, but for an axis of one; None if odd or too small."""
        shape = coarser_shape(self.grid.shape)
        if shape is None or np.any(np.logical_and(self.mirrored, np.mod(shape, 2))):
            return None
        if not all(self._ended.can_be_halved(response) for response, _ in self.surface.terms):
            return None
        return self._on_grid(replace(self.grid, shape=shape))

    def with_elastic(self, added: float) -> MovingDomain:
        """Same region with an elastic compliance added to the operator [1/Pa]."""
        if self._ends:  # what its operators are made of is kept
            domain = copy(self)
            domain._added = added
            domain._build_operators()
            domain._last = domain.whole
            return domain
        return self._on_grid(self.grid, added, self._moving_table)

    @cached_property
    def elastic(self) -> Operator:
        """Displacement per unit elastic compliance [Pa m] of pressure [Pa] on all cells."""
        if all(self.grid.periodic):
            return self._filter_operator([(self._at_rest, np.ones_like)], self.shape)
        if self._ends:
            return self._sum_with_ends([(self._at_rest, REST, 1.0)], self.shape, 0)
        return self._convolved(self._elastic_table(self._at_rest), self.shape)

    @cached_property
    def loss(self) -> Operator:
        """Slope of the delayed displacement, Σ (Ji/li) (K p - Ei K p) [-], of pressure [Pa]."""
        terms = self.surface.terms
        if all(self.grid.periodic):
            factors = [(response, moving.loss_at_wave_number) for response, moving in terms]
            return self._filter_operator(factors, self.shape)
        if self._ends:
            return self._loss_with_ends
        first, *others = (self._loss_of_term(*term) for term in terms)
        return self._convolved(sum(others, start=first) + self._drift, self.shape)

    @property
    def local_compliance(self) -> float:
        """Compliance of short waves at the frequency of the reference wave [1/Pa]."""
        wave = np.array(2 * np.pi / self.grid.size[self.axis])
        return abs(complex(self.surface.short_waves.at_wave_number(wave)))

    @property
    def _drift(self) -> float:
        """Slope of the surface behind a line contact by old creep, per pressure of a cell [-]."""
        # The deflection of a strip falls as -(2/π) F ln(distance) with the force F on its length.
        if self.grid.has_datum:
            return 0.0
        across = self.grid.shape[1 - self.axis]
        force = self.grid.cell_size[self.axis] / across
        return 2 / np.pi * force * self.surface.drift

    def _on_grid(
        self, grid: Grid, added: float = 0.0, moving_table: Floats | None = None
    ) -> MovingDomain:
        return MovingDomain(
            grid,
            self.surface,
            self.axis,
            mirrored=any(self.mirrored),
            added=added,
            transforms=self._transforms,
            moving_table=moving_table,
        )

    def _elastic_table(self, response: SurfaceResponse) -> Floats:
        """Influence table of an elastic surface, kept."""
        if response not in self._tables:
            self._tables[response] = self._table_of_term(response, REST)
        return self._tables[response]

    def _table_of_term(self, response: SurfaceResponse, compliance: MovingCompliance) -> Floats:
        """Influence table of a term in motion."""
        if response not in self._samples:
            self._samples[response] = _coefficient_on(self.grid, self.axis, response)
        cells = self.grid.shape, self.grid.cell_size
        return moving_influence_table(*cells, compliance, self.axis, self._samples[response])

    def _loss_of_term(self, response: SurfaceResponse, moving: MovingCompliance) -> Floats:
        """Table of the slope of the delayed displacement under a term."""
        rates = _rates_of(moving)
        elastic = self._elastic_table(response)
        return rates.relaxed * elastic - self._table_of_term(response, rates)

    def _influence_table(self) -> Floats:
        if all(self.grid.periodic) or self._ends:
            return np.empty((0, 0))
        if self._moving_table is None:
            relative = self.surface.scaled(1 / self.compliance)
            first, *others = (self._table_of_term(*term) for term in relative.terms)
            self._moving_table = sum(others, start=first)
            # Without a datum from the farthest place on, as that of the memory is far.
            if not (self.grid.has_datum or self.surface.is_supported):
                self._moving_table -= self._drift / self.compliance * self._offsets
                self._moving_table -= self._moving_table.min()
        if not self._added:
            return self._moving_table
        share = self._added / self.compliance
        return self._moving_table + share * self._elastic_table(self._at_rest)

    @property
    def _offsets(self) -> Floats:
        """Signed offsets along the motion of the entries of a table, as a column or a row [m]."""
        count, cell = self.grid.shape[self.axis], self.grid.cell_size[self.axis]
        offsets = cell * np.arange(1 - count, count, dtype=np.float64)
        return offsets[:, None] if self.axis == 0 else offsets[None, :]

    def _preconditioner(self, shape: tuple[int, int], start: int) -> MovingPreconditioner:
        options: Any = {"mirrored": self.mirrored, "transforms": self._transforms}
        terms, cell_size = self._relative, self.grid.cell_size
        return MovingPreconditioner(shape, cell_size, terms, self.axis, **options)

    @property
    def _relative(self) -> tuple[tuple[SurfaceResponse, MovingCompliance], ...]:
        """Terms of the operator over the reference compliance, with what is added [-]."""
        whole = self.surface.with_elastic(self._at_rest, self._added)
        return whole.scaled(1 / self.compliance).terms

    def _operator(self, shape: tuple[int, int], start: int, *, single: bool) -> Operator:
        if all(self.grid.periodic):
            factors = [(response, moving.at_wave_number) for response, moving in self._relative]
            return self._filter_operator(factors, shape, single=single)
        if self._ends:
            terms = [(response, moving, 1.0) for response, moving in self._scaled_terms]
            terms += [(self._at_rest, REST, self._added / self.compliance)] * bool(self._added)
            found = self._sum_with_ends(terms, shape, start, single=single)
            return found if self._datum is None else found.less(self._datum)
        return self._convolved(self._coefficients, shape, single=single)

    @property
    def _ends(self) -> bool:
        """True of a half-space that ends."""
        return any(has_ends(response) for response, _ in self.surface.terms)

    @cached_property
    def _scaled_terms(self) -> tuple[tuple[SurfaceResponse, MovingCompliance], ...]:
        """Terms over the reference compliance [-]."""
        return self.surface.scaled(1 / self.compliance).terms

    @property
    def _loss_with_ends(self) -> WeightedOperators:
        """Slope of the delayed displacement of a half-space that ends."""
        terms = []
        for response, moving in self.surface.terms:
            rates = _rates_of(moving)
            terms += [(response, REST, rates.relaxed), (response, rates, -1.0)]
        return self._sum_with_ends(terms, self.shape, 0)

    @cached_property
    def _datum(self) -> float | None:
        """Least displacement by a unit of pressure on a cell, if old loads have no datum [Pa m]."""
        # Between two ends displacement counts from the farthest place on, as that of the memory is
        # far.
        responses = [part for response, _ in self.surface.terms for part, _ in parts_of(response)]
        ended = [part for part in responses if isinstance(part, EndedResponse)]
        if self.surface.is_supported or all(None in part.planes for part in ended):
            return None
        terms = [(response, moving, 1.0) for response, moving in self._scaled_terms]
        operator = self._sum_with_ends(terms, self.shape, 0)
        unit = np.zeros(self.shape)
        row = self._ended.middle_row(ended[0])
        unit[row, 0] = 1.0
        ahead = operator.apply(unit)[row, -1]
        behind = operator.apply(unit[:, ::-1])[row, 0]
        return float(min(ahead, behind))

    def _sum_with_ends(
        self,
        terms: Sequence[tuple[SurfaceResponse, MovingCompliance, float]],
        shape: tuple[int, int],
        start: int,
        *,
        single: bool = False,
    ) -> WeightedOperators:
        """Weighted sum of terms, of which a half-space ends, over a block from a row on."""
        operators: list[Any] = []
        weights = []
        for response, moving, factor in terms:
            for part, weight in parts_of(response):
                if isinstance(part, EndedResponse):
                    operators.append(
                        self._ended.operator(part, shape, start, single=single, moving=moving)
                    )
                else:
                    table = self._table_of_term(part, moving)
                    operators.append(self._convolved(table, shape, single=single))
                weights.append(factor * weight)
        return WeightedOperators(operators, weights)

    def _filter_operator(
        self,
        terms: Sequence[tuple[SurfaceResponse, WaveFactor]],
        shape: tuple[int, int],
        *,
        single: bool = False,
    ) -> MovingPeriodicConvolution:
        """Operator on a period by the terms' factors of its waves along the motion."""
        size, transforms = self.grid.cell_size, self._transforms
        return MovingPeriodicConvolution(
            shape, size, terms, self.axis, single=single, transforms=transforms
        )

    def _convolved(
        self, table: Floats, shape: tuple[int, int], *, single: bool = False
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


def _rates_of(moving: MovingCompliance) -> MovingCompliance:
    """Delayed part of a compliance with its modes over their lengths, Ji/li."""
    return replace(moving, instant=0.0, amplitudes=moving.amplitudes / moving.lengths)


def _coefficient_on(grid: Grid, axis: int, response: SurfaceResponse) -> Coefficient:
    """Influence coefficients of an elastic surface, with images across the motion if periodic."""
    across_cells, size = grid.shape[1 - axis], grid.size[axis]

    def free(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        if response is HALF_SPACE:
            return influence_coefficient(along, across, cell)
        return layered_influence_coefficient(along[:, 0], across.size, cell, response)

    def with_images(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        if response is not HALF_SPACE:
            turned = (cell[1], cell[0])
            half = periodic_layered_coefficient(
                across_cells, np.abs(along[:, 0]), turned, response, size
            )
            places = np.arange(across_cells)
            return half[np.minimum(places, across_cells - places)].T
        if across_cells == 1:  # pieces of any length make the strip
            return periodic_influence_coefficient(across, along, (cell[0], cell[0]), cell[0], size)
        period = grid.size[1 - axis]
        near = np.minimum(across, period - across)
        return periodic_influence_coefficient(near, along, cell[::-1], period, size)

    found = with_images if grid.periodic[1 - axis] else free
    return found if response is HALF_SPACE else _cached(found)


def _cached(coefficient: Coefficient) -> Coefficient:
    """Coefficients that are kept: displacement and loss ask for those of the same places."""
    known: dict[bytes, Floats] = {}

    def kept(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        key = along.tobytes()  # all have the same places across, and cells
        if key not in known:
            known[key] = coefficient(along, across, cell)
        return known[key]

    return kept


def coarser_shape(shape: tuple[int, int]) -> tuple[int, int] | None:
    """Half the numbers of cells; None if they are odd or too small. A single cell is kept."""
    if max(shape) == 1 or any(n > 1 and (n % 2 or n < 2 * COARSEST) for n in shape):
        return None
    return max(shape[0] // 2, 1), max(shape[1] // 2, 1)
