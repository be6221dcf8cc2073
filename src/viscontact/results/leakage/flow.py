"""Flow of a thin fluid film through a gap (Reynolds' equation), by finite volumes.

With the pressure p and the gap h, q = -h³/(12 η) grad p and div q = 0, without flow into contact.
There is an unknown for each cell of the channels. Between two cells the conductance is that of
their halves in series (the harmonic mean of h³/12). The flow of unit viscosity under a unit
difference of pressure over the length L is T W/L, with the width W and the transmissivity T [m³].

A border of contact that is oblique to the cells is a staircase. Faces alone let nothing flow past
its steps, so that the wall seems to be up to 0.35 cells further in the fluid. Of the four cells
around a corner, three open ones and one in contact stand for the step of a wall at 45°: the fluid
is on the whole of their square, and not on half of it as the two faces have it. Each half of a face
that ends at such a corner therefore counts twice. Walls along the cells and at 45° are then exact.

References
----------
O. Reynolds, Phil. Trans. R. Soc. 177 (1886) 157; S. V. Patankar, Numerical Heat Transfer and Fluid
Flow, Hemisphere 1980, section 4.2-3.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np
import scipy

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.leakage.channels import FlowAxis, components

#: Conductance of a face between cells of two gaps, over 1/12.
FaceMean = Callable[[Floats, Floats], Floats]


def harmonic(one: Floats, other: Floats) -> Floats:
    """Harmonic mean of h³: two half cells in series, from below on rough gaps."""
    a, b = one**3, other**3
    return np.asarray(2 * a * b / (a + b))


def of_mean_gap(one: Floats, other: Floats) -> Floats:
    """h³ of the mean gap, from above on rough gaps."""
    return np.asarray(((one + other) / 2) ** 3)


@dataclass(frozen=True, eq=False)
class ChannelFlow:
    """Solved flow through the channels of a gap, of unit viscosity and difference of pressure."""

    pressure: Floats  # over the difference, (nx, ny); NaN outside the channels
    flux_x: Floats  # through the face beyond each cell along x, (nx, ny) [m³]
    flux_y: Floats  # along y
    flow: FlowAxis
    length: float  # along the flow [m]
    width: float  # across it [m]
    at_steps: float  # of the flow, what the steps of the border let pass in addition, at least [m³]

    @cached_property
    def sections(self) -> Floats:
        """Flow through each section across the axis [m³]."""
        axis = self.flow.axis
        through = (self.flux_x, self.flux_y)[axis].sum(axis=1 - axis)
        return np.asarray(through if self.flow.ends == "period" else through[:-1])

    @property
    def transmissivity(self) -> float:
        """T [m³]: h³/12 between parallel plates."""
        return float(self.sections.mean()) * self.length / self.width

    @property
    def of_steps(self) -> float:
        """Transmissivity that the steps of staircase borders add, at least [m³]."""
        return self.at_steps * self.length / self.width

    @property
    def imbalance(self) -> float:
        """Largest difference of the flow through two sections, over their mean [-]."""
        mean = float(self.sections.mean())
        return float(np.ptp(self.sections)) / mean if mean > 0 else 0.0


def solved_flow(
    gap: Floats,
    cells: Bools,
    flow: FlowAxis,
    cell_size: tuple[float, float],
    mean: FaceMean = harmonic,
) -> ChannelFlow:
    """Flow along an axis through the cells of channels, whose gaps are positive [m]."""
    return solved_flows(gap, cells, (flow,), cell_size, mean)[0]


def solved_flows(
    gap: Floats,
    cells: Bools,
    flows: Sequence[FlowAxis],
    cell_size: tuple[float, float],
    mean: FaceMean = harmonic,
) -> list[ChannelFlow]:
    """Flows along axes through the cells of channels, by one factorisation.

    Several are those from period to period through the same cells: only their sources differ.
    """
    scale = float(gap[cells].max())  # so that no cube underflows
    scaled = np.where(cells, gap / scale, 0.0)
    each_faces = [_Faces(scaled, cells, flow, cell_size, mean) for flow in flows]
    factors = each_faces[0].factorised()
    return [_flow(faces, scale**3 / 12, factors) for faces in each_faces]


def _flow(faces: _Faces, factor: float, factors: Any) -> ChannelFlow:
    """Flow by the factors of its matrix, with a unit of conductance [m³]."""
    pressure = np.zeros(faces.cells.shape)
    pressure[faces.cells] = factors.solve(faces.source())
    flux_x, flux_y = faces.fluxes(pressure)
    shape, axis = faces.cells.shape, faces.flow.axis
    length, width = (shape[a] * faces.cell_size[a] for a in (axis, 1 - axis))
    shown = np.where(faces.cells, pressure + faces.mean_fall, np.nan)
    steps = factor * faces.dissipation_at_steps(pressure)
    return ChannelFlow(shown, factor * flux_x, factor * flux_y, faces.flow, length, width, steps)


@dataclass(frozen=True, eq=False)
class _Faces:
    """Faces between cells of channels, and the linear system of their flows."""

    gap: Floats  # scaled; 0 outside the channels
    cells: Bools
    flow: FlowAxis
    cell_size: tuple[float, float]
    mean: FaceMean

    @cached_property
    def conductances(self) -> tuple[Floats, Floats]:
        """Of the face beyond each cell along x and along y; 0 at closed ones (nx, ny)."""
        return self._conductance(0), self._conductance(1)

    def _conductance(self, axis: int) -> Floats:
        next_gap = np.roll(self.gap, -1, axis)
        both = (self.gap > 0) & (next_gap > 0)
        found = np.zeros(self.gap.shape)
        found[both] = self.mean(self.gap[both], next_gap[both])
        if not self.flow.joined[axis]:
            np.moveaxis(found, axis, 0)[-1] = 0.0
        dx, dy = self.cell_size
        return found * self._widths[axis] * (dy / dx if axis == 0 else dx / dy)

    @cached_property
    def _widths(self) -> tuple[Floats, Floats]:
        """Widths of the faces that count, over their own, along x and along y (nx, ny)."""
        return self._width(0), self._width(1)

    def _width(self, axis: int) -> Floats:
        closed, across = self.gap <= 0, 1 - axis
        beyond = np.roll(closed, -1, axis)
        width = np.ones(self.gap.shape)
        for side, border in ((1, 0), (-1, -1)):
            # Of the cells beside both cells of a face, one is open and one is not.
            steps = np.roll(closed, side, across) ^ np.roll(beyond, side, across)
            if not self.flow.joined[across]:
                np.moveaxis(steps, across, 0)[border] = False
            width += 0.5 * steps
        return width

    @cached_property
    def ends(self) -> tuple[Floats, Floats]:
        """Conductances of the outer faces, half a cell from the first and last centres."""
        axis = self.flow.axis
        across = self.cell_size[1 - axis] / self.cell_size[axis]
        lines = np.moveaxis(self.gap, axis, 0)
        return 2 * across * lines[0] ** 3, 2 * across * lines[-1] ** 3

    @property
    def mean_fall(self) -> Floats:
        """Pressure that falls evenly by one over the period; 0 for given pressures at the ends."""
        count = self.gap.shape[self.flow.axis]
        if self.flow.ends == "pressure":
            return np.zeros(self.gap.shape)
        along = 1 - (np.arange(count) + 0.5) / count
        return np.broadcast_to(
            along[:, None] if self.flow.axis == 0 else along[None, :], self.gap.shape
        )

    @cached_property
    def unknown(self) -> Any:
        """Numbers of the unknowns; -1 outside."""
        unknown = np.full(self.cells.shape, -1)
        unknown[self.cells] = np.arange(int(self.cells.sum()))
        return unknown

    def factorised(self) -> Any:
        """Factors of the balance of the flows out of each cell."""
        # Symmetric and positive definite: no pivoting, and an ordering for symmetric matrices.
        return scipy.sparse.linalg.splu(
            self._matrix(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )

    def _matrix(self) -> Any:
        count = int(self.cells.sum())
        diagonal = np.zeros(count)
        rows, columns, values = [], [], []
        for one, other, conductance in self._joints():
            np.add.at(diagonal, one, conductance)
            np.add.at(diagonal, other, conductance)
            rows += [one, other]
            columns += [other, one]
            values += [-conductance, -conductance]
        self._close(diagonal)
        rows.append(np.arange(count))
        columns.append(np.arange(count))
        values.append(diagonal)
        places = np.concatenate(rows), np.concatenate(columns)
        return scipy.sparse.csc_matrix((np.concatenate(values), places), shape=(count, count))

    def _joints(self) -> Iterator[tuple[Any, Any, Floats]]:
        """Unknowns on both sides of the open faces, and their conductances, along x and along y."""
        for axis, conductance in enumerate(self.conductances):
            face = conductance > 0
            other = np.roll(self.unknown, -1, axis)
            yield self.unknown[face], other[face], conductance[face]

    def source(self) -> Floats:
        """Flow into each cell by the pressures at the ends, or by that which falls evenly."""
        source = np.zeros(int(self.cells.sum()))
        if self.flow.ends == "pressure":
            inside, conductance = self._first_and_last()[0]
            np.add.at(source, inside, conductance)  # of unit pressure; it is 0 at the last
            return source
        one, other, conductance = list(self._joints())[self.flow.axis]
        drop = conductance / self.gap.shape[self.flow.axis]
        np.add.at(source, one, -drop)
        np.add.at(source, other, drop)
        return source

    def _first_and_last(self) -> list[tuple[Any, Floats]]:
        """Unknowns at both outer faces, and the conductances of these."""
        lines = np.moveaxis(self.unknown, self.flow.axis, 0)
        return [
            (lines[end][lines[end] >= 0], conductance[lines[end] >= 0])
            for end, conductance in zip((0, -1), self.ends, strict=True)
        ]

    def _close(self, diagonal: Floats) -> None:
        """Give the pressures at the ends, or that of one cell of each component."""
        if self.flow.ends == "pressure":
            for inside, conductance in self._first_and_last():
                np.add.at(diagonal, inside, conductance)
            return
        numbers, _ = components(self.cells, self.flow.joined)
        # The widest cell of each, whose equation is not lost in rounding.
        order = np.argsort(-self.gap, axis=None, kind="stable")
        _, first = np.unique(numbers.ravel()[order], return_index=True)
        for place in order[first].tolist():
            index = int(self.unknown.flat[place])
            if index >= 0:
                diagonal[index] *= 2  # the flows balance, so that its pressure is 0

    def fluxes(self, pressure: Floats) -> tuple[Floats, Floats]:
        """Flows through the face beyond each cell along x and y."""
        falls = self._falls(pressure)
        return self.conductances[0] * falls[0], self.conductances[1] * falls[1]

    def _falls(self, pressure: Floats) -> tuple[Floats, Floats]:
        """Falls of the pressure from each cell to the next one along x and y."""
        falls = [pressure - np.roll(pressure, -1, axis) for axis in (0, 1)]
        if self.flow.ends == "period":
            falls[self.flow.axis] = falls[self.flow.axis] + 1 / self.gap.shape[self.flow.axis]
        return falls[0], falls[1]

    def dissipation_at_steps(self, pressure: Floats) -> float:
        """Flow that is due to the widths added at steps.

        The flow is the least dissipation Σ k (Δp)² of all pressures, so that this is the least
        by which it is larger than without them.
        """
        parts = zip(self.conductances, self._widths, self._falls(pressure), strict=True)
        return float(sum(((1 - 1 / wide) * k * fall**2).sum() for k, wide, fall in parts))
