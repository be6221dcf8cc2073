"""Largest contact and pressure of a run, by which its mesh and its times are judged at its end."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

from viscontact.backend.arrays import Bools
from viscontact.backend.errors import DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import MIN_CELLS_ACROSS, Grid
from viscontact.mechanics.state import ContactState
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.checks.mesh import cells_across_spots, mesh_warnings
from viscontact.simulation.checks.steps import unreported_peak_warnings


@dataclass(frozen=True, eq=False)
class LargestContact:
    """Largest contact and largest pressure of the states so far."""

    area: float = 0.0  # [m²]
    cells_across: int = 0
    in_contact: Bools | None = None  # its cells; None where its spots were counted before
    periodic: tuple[bool, bool] = (False, False)
    spots_before: float = 0.0  # cells across its spots, as counted before
    peak: float = 0.0  # largest pressure [Pa]
    peak_time: float = 0.0  # [s]
    peak_reported: float = 0.0  # largest pressure of the states that are reported [Pa]

    @cached_property
    def cells_across_spots(self) -> float:
        """Cells across the spots of the largest contact, which take a pass to count."""
        if self.in_contact is None:
            return self.spots_before
        return cells_across_spots(self.in_contact, periodic=self.periodic)

    def after(self, state: ContactState, *, asked: bool) -> LargestContact:
        """Return the largest ones with a further state; `asked`: not before the first instant."""
        found = self
        if state.contact_area > self.area:
            cells, periodic = state.in_contact, state.grid.periodic
            given = state.contact_area, state.cells_across, cells, periodic, 0.0
            found = LargestContact(*given, self.peak, self.peak_time, self.peak_reported)
        if asked and state.peak_pressure > self.peak:
            found = replace(found, peak=state.peak_pressure, peak_time=state.time)
        return found

    def reported(self, state: ContactState) -> LargestContact:
        """Return the same with a state that is reported."""
        if state.peak_pressure <= self.peak_reported:
            return self
        return replace(self, peak_reported=state.peak_pressure)

    def mesh_warnings(self) -> dict[str, str]:
        """Warn of few cells across the largest contact, or across its spots."""
        return mesh_warnings(self.cells_across, self.cells_across_spots) if self.area else {}

    def peak_warnings(self) -> dict[str, str]:
        """Warn of a largest pressure between the instants of the result."""
        if not self.area:
            return {}
        return unreported_peak_warnings(self.peak, self.peak_time, self.peak_reported)

    def refuse_coarse_mesh(self, grid: Grid) -> None:
        """Raise DomainError if the largest contact had fewer than four cells across."""
        if not self.area or self.cells_across >= MIN_CELLS_ACROSS:
            return
        nx, ny = grid.shape
        raise DomainError(
            f"grid: only {self.cells_across} cells lie across the run's largest contact and "
            f"{MIN_CELLS_ACROSS} are the least (20 or more recommended); use more cells than "
            f"{nx} x {ny} or a smaller grid.size"
        )

    def restart_data(self) -> RestartData:
        """Return the same as plain data, with its spots counted."""
        return {
            "area": self.area,
            "cells_across": self.cells_across,
            "spots_before": self.cells_across_spots,
            "peak": self.peak,
            "peak_time": self.peak_time,
            "peak_reported": self.peak_reported,
        }
