"""Leakage at one instant: transmissivity, its error, channel and critical constriction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field, replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.results.leakage.channels import (
    FlowAxis,
    channel,
    critical_constriction,
    critical_gap_error,
)
from viscontact.results.leakage.effective_medium import effective_transmissivity
from viscontact.results.leakage.flow import (
    ChannelFlow,
    FaceMean,
    harmonic,
    of_mean_gap,
    solved_flows,
)

#: Multiple of the tolerance of a run, over the scatter of its gap, below which a gap is noise.
NOISE = 10.0

#: Most unknowns of a direct solution, and its memory for each [bytes].
MOST_UNKNOWNS, MEMORY = 4_300_000, 1300


@dataclass(frozen=True, eq=False)
class InstantLeakage:
    """Flow through the gap of one instant along one axis."""

    gap: Floats  # shape (nx, ny) [m]
    touched: Bools  # cells in contact
    grid: Grid
    flow: FlowAxis
    tolerance: float  # relative error of the gap
    other: FlowAxis | None = None  # axis of a flow that is found at this instant as well
    #: Flows along the other axis that were found at once, by the mean at faces and the axis.
    solved: dict[tuple[FaceMean, FlowAxis], ChannelFlow] = field(default_factory=dict)

    def along(self, flows: Sequence[FlowAxis]) -> list[InstantLeakage]:
        """Leakage of the same gap along one axis or both."""
        others = (*flows[1:], *flows[:1]) if len(flows) > 1 else (None,)
        return [
            replace(self, flow=flow, other=other) for flow, other in zip(flows, others, strict=True)
        ]

    @property
    def extents(self) -> tuple[float, float]:
        """Extents of the grid along and across the flow [m]."""
        size = self.grid.size
        return size[self.flow.axis], size[1 - self.flow.axis]

    @cached_property
    def opened(self) -> Bools:
        """Cells whose gap is more than the noise of the contact's solution."""
        free = ~self.touched & (self.gap > 0)
        known = self.gap[free & np.isfinite(self.gap)]
        noise = NOISE * self.tolerance * float(known.std()) if known.size else 0.0
        return np.asarray(free & (self.gap > noise))

    @cached_property
    def critical(self) -> tuple[float, int, int]:
        """Critical gap [m], 0 if closed, and its cell."""
        return critical_constriction(self.gap, self.opened, self.flow)

    @cached_property
    def critical_error(self) -> float:
        """Error of the critical gap; of a contact that is closed, how open it might be [m]."""
        return critical_gap_error(self.gap, self.opened, self.flow)

    @property
    def percolates(self) -> bool:
        """True if a channel leads through."""
        return self.critical[0] > 0

    @property
    def cells_across(self) -> int:
        """Open cells across the critical constriction, along x or y, where they are fewer."""
        _, i, j = self.critical
        lines = zip((self.opened[:, j], self.opened[i]), (i, j), self.grid.periodic, strict=True)
        return min(_run_length(line, at, wraps=bool(wraps)) for line, at, wraps in lines)

    def slope(self, part: float) -> float:
        """Slope of the gap that a part of the channel's cells does not exceed [-]."""
        squares = np.zeros(self.gap.shape)
        for axis, (cell, repeats) in enumerate(
            zip(self.grid.cell_size, self.grid.periodic, strict=True)
        ):
            rise = np.diff(self.gap, axis=axis, append=np.take(self.gap, [0], axis)) / cell
            if not repeats:
                np.moveaxis(rise, axis, 0)[-1] = 0.0
            squares += np.square(rise)
        return float(np.sqrt(np.quantile(squares[self.cells], part)))

    @cached_property
    def cells(self) -> Bools:
        """Cells of the channels."""
        return channel(~self.touched & (self.gap > 0), self.flow)

    @cached_property
    def solution(self) -> ChannelFlow | None:
        """Flow by the harmonic mean at faces; None if closed."""
        return self._solved(harmonic) if self.percolates else None

    def _solved(self, mean: FaceMean) -> ChannelFlow:
        count = int(self.cells.sum())
        if count > MOST_UNKNOWNS:
            raise ValueError(
                f"leakage: the channels have {count} cells, and a direct solution of more than "
                f"{MOST_UNKNOWNS} takes over {MEMORY * MOST_UNKNOWNS / 1e9:.0f} GB; run on a grid "
                "of at most 2048 by 2048 cells"
            )
        if not np.isfinite(self.gap[self.cells]).all():
            raise ValueError(
                "leakage: the channel leads beyond the end of the body, where the gap is infinite "
                "or unknown; give a grid within the body"
            )
        if (mean, self.flow) in self.solved:
            return self.solved.pop((mean, self.flow))
        flows = [self.flow, *self._alike]
        own, *others = solved_flows(self.gap, self.cells, flows, self.grid.cell_size, mean)
        self.solved.update({(mean, each.flow): each for each in others})
        return own

    @cached_property
    def _alike(self) -> list[FlowAxis]:
        """The other axis, if the flow along it has the same cells and faces."""
        if self.other is None or {self.flow.ends, self.other.ends} != {"period"}:
            return []
        same = np.array_equal(channel(~self.touched & (self.gap > 0), self.other), self.cells)
        return [self.other] if same and self.flow.joined == self.other.joined else []

    @property
    def transmissivity(self) -> float:
        """T [m³], exactly 0 if closed."""
        return 0.0 if self.solution is None else self.solution.transmissivity

    @cached_property
    def error(self) -> float:
        """Error of T, by the faces between cells and by the steps of the contact's border [m³].

        With the mean gap at faces T deviates to the other side.
        """
        if self.solution is None:
            return 0.0
        by_faces = abs(self._solved(of_mean_gap).transmissivity - self.transmissivity)
        return by_faces + self.solution.of_steps

    @cached_property
    def row(self) -> dict[str, float]:
        """Values of the scalars."""
        critical, i, j = self.critical
        closed = np.where(self.touched | (self.gap <= 0), 0.0, self.gap)
        finite = bool(np.isfinite(closed).all())
        transmissivity = self.transmissivity
        return {
            "transmissivity": transmissivity,
            "transmissivity_error": self.error,
            "percolates": float(self.percolates),
            "critical_gap": critical,
            "critical_gap_error": self.critical_error,
            "critical_x": float(self.grid.x[i]) if self.percolates else np.nan,
            "critical_y": float(self.grid.y[j]) if self.percolates else np.nan,
            "effective_gap": float(np.cbrt(12 * transmissivity)),
            "mean_gap": float(closed.mean()),
            "transmissivity_effective_medium": effective_transmissivity(closed)
            if finite
            else np.nan,
            "flux_imbalance": 0.0 if self.solution is None else self.solution.imbalance,
        }


def _run_length(line: Bools, at: int, *, wraps: bool) -> int:
    """Number of open cells in a row around a place; of an endless row a large one."""
    shut = np.flatnonzero(~line)
    if not shut.size:
        return np.iinfo(int).max if wraps else line.size
    if wraps:
        return int(((shut - at) % line.size).min() + ((at - shut) % line.size).min() - 1)
    before, after = shut[shut < at], shut[shut > at]
    return int(after.min(initial=line.size) - before.max(initial=-1) - 1)
