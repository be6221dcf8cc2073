"""Pressure and gap at one instant or speed."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from viscontact.backend.arrays import Bools, Field, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.body_edge import Outline
from viscontact.results.run_axis import TIME, RunAxis
from viscontact.units.axis_flags import NEITHER, AxisFlags
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True)
class Snapshot:
    """Pressure and gap at one instant or speed."""

    time: float  # [s]; in steady motion the speed [m/s]
    x: Floats  # cell centres, shape (nx,) [m]
    y: Floats  # cell centres, shape (ny,) [m]
    pressure: Floats  # shape (nx, ny), positive in compression [Pa]
    gap: Floats  # shape (nx, ny), positive when open [m]
    in_contact: Bools  # cells where the bodies touch, shape (nx, ny)
    body_end: Outline | None = None  # where the indenter ends between the cells, if known
    periodic: AxisFlags = NEITHER  # axes along which the fields are one period
    axis: RunAxis = TIME  # quantity in which the snapshots of a result differ
    least_pull: float = 0.0  # least tension of the cohesive zone [Pa]; 0 without adhesion

    def __post_init__(self) -> None:
        object.__setattr__(self, "periodic", AxisFlags(self.periodic, "periodic"))

    @property
    def grid(self) -> Grid:
        """Cells of the fields."""
        (nx, ny), (dx, dy) = self.pressure.shape, self.cell_size
        return Grid((nx, ny), (nx * dx, ny * dy), self.periodic.plain, centre=self.middle)

    @property
    def touching(self) -> bool:
        """True if the bodies are in contact at this instant."""
        return bool(self.in_contact.any())

    @property
    def in_zone(self) -> Bools:
        """Cells of the cohesive zone, which pull outside the contact, shape (nx, ny)."""
        return ~self.in_contact & (self.pressure <= -self.least_pull) & (self.least_pull > 0)

    @property
    def cell_size(self) -> tuple[float, float]:
        """Edge lengths (dx, dy) of a cell [m]."""
        return float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0])

    def extent(self) -> tuple[float, float, float, float]:
        """Box (x_min, x_max, y_min, y_max) around the contact and its cohesive zone [m]."""
        rows, columns = ((self.in_contact | self.in_zone).any(axis=axis) for axis in (1, 0))
        return self._box(self.x[rows], self.y[columns])

    def borders(self) -> tuple[float, float, float, float]:
        """Box (x_min, x_max, y_min, y_max) around all cells [m]."""
        return self._box(self.x, self.y)

    def _box(self, x: Floats, y: Floats) -> tuple[float, float, float, float]:
        dx, dy = self.cell_size
        return (
            float(x[0] - dx / 2),
            float(x[-1] + dx / 2),
            float(y[0] - dy / 2),
            float(y[-1] + dy / 2),
        )

    def with_border(self, cells: int) -> Snapshot:
        """Snapshot with more cells at each border: next periods, or open cells."""
        beyond = np.arange(1, cells + 1)[:, None] * self.cell_size
        x, y = (
            np.concatenate([at[0] - step[::-1], at, at[-1] + step])
            for at, step in zip((self.x, self.y), beyond.T, strict=True)
        )
        pressure = _pad(self.pressure, cells, self.periodic, 0.0)
        gap = _pad(self.gap, cells, self.periodic, np.inf)
        touched = _pad(self.in_contact, cells, self.periodic, False)
        end = self.body_end
        body_end = None if end is None else _with_border(end, cells, self.periodic)
        options: Any = {"axis": self.axis, "least_pull": self.least_pull}
        return Snapshot(self.time, x, y, pressure, gap, touched, body_end, **options)

    @property
    def middle(self) -> tuple[float, float]:
        """Middle of the grid [m]."""
        return float(self.x[0] + self.x[-1]) / 2, float(self.y[0] + self.y[-1]) / 2

    def section(
        self, along: Literal["x", "y"] = "x", at: float | None = None
    ) -> tuple[Floats, Floats]:
        """Cell centres [m] and pressure [Pa] on a line that crosses the other axis at `at` [m]."""
        # Between two rows of cells the pressure is interpolated linearly: on an even grid the line
        # through the middle, the default, takes the mean of the two middle rows.
        return self.line(self.pressure, along, at)

    def contact_section(
        self, along: Literal["x", "y"] = "x", at: float | None = None
    ) -> tuple[Floats, Bools]:
        """Cell centres [m] of `section`, and whether the bodies touch there."""
        positions, share = self.line(self.in_contact.astype(np.float64), along, at)
        return positions, share > 0

    def line(
        self, field: Floats, along: Literal["x", "y"], at: float | None
    ) -> tuple[Floats, Floats]:
        """Cell centres [m] and a field on a line that crosses the other axis at `at` [m]."""
        if along not in ("x", "y"):
            raise ValueError(f"along must be 'x' or 'y', got {along!r}")
        positions, across = (self.x, self.y) if along == "x" else (self.y, self.x)
        rows = field.T if along == "x" else field
        at = self.middle[1 if along == "x" else 0] if at is None else at
        if not across[0] <= at <= across[-1]:
            raise ValueError(
                f"at must lie on the grid, between {format_quantity(across[0], 'm')} and "
                f"{format_quantity(across[-1], 'm')}, got {format_quantity(at, 'm')}"
            )
        upper = int(np.clip(np.searchsorted(across, at), 1, across.size - 1))
        share = (at - across[upper - 1]) / (across[upper] - across[upper - 1])
        return positions, (1 - share) * rows[upper - 1] + share * rows[upper]

    def line_load(self) -> tuple[Floats, Floats]:
        """Cell centres along x [m], and the pressure integrated over y there [N/m]."""
        return self.x, self.pressure.sum(axis=1) * self.cell_size[1]


def _pad(field: Field, cells: int, periodic: AxisFlags, beyond: float) -> Field:
    """Field with more cells at each border: those of the next period, or a value."""
    for axis in (0, 1):
        width = [(cells, cells) if axis == each else (0, 0) for each in (0, 1)]
        if periodic[axis]:
            field = np.pad(field, width, mode="wrap")
        else:
            field = np.pad(field, width, constant_values=beyond)
    return field


def _with_border(body_end: Outline, cells: int, periodic: AxisFlags) -> Outline:
    # Where the body ends between one period and the next is not known.
    along_x = np.pad(body_end.along_x, ((0, 1), (0, 0)), constant_values=np.nan)
    along_y = np.pad(body_end.along_y, ((0, 0), (0, 1)), constant_values=np.nan)
    along_x, along_y = (_pad(each, cells, periodic, np.nan) for each in (along_x, along_y))
    return Outline(along_x[:-1], along_y[:, :-1])
