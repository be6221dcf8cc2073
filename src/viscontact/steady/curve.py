"""Curve of steady contacts over speed: solved, measured, checked and labelled."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
import xarray as xr

from viscontact.checks.collector import WarningCollector
from viscontact.checks.half_space_theory import (
    SINGULAR_KINDS,
    Geometry,
    corner_warnings,
    geometry_warnings,
)
from viscontact.checks.material import data_warnings, law_warnings
from viscontact.checks.mesh import cells_across_spots, mesh_warnings
from viscontact.checks.motion import edge_warnings, free_tilt_warnings
from viscontact.checks.periodicity import datum_warnings
from viscontact.checks.singularities import strain_of
from viscontact.contact.rim import Rim
from viscontact.errors import ConvergenceError, DomainError
from viscontact.grid import MIN_CELLS_ACROSS, Grid
from viscontact.simulation.grid_enlargement import overrun
from viscontact.state import ContactState
from viscontact.steady.contact import SteadyContact, gap_on
from viscontact.steady.dataset import steady_dataset
from viscontact.steady.error_bars import (
    Measured,
    entry_is_singular,
    error_bars,
    unknown_bars,
)
from viscontact.steady.preparation import PreparedRun
from viscontact.steady.problem import SteadyProblem
from viscontact.steady.state import force_across, resistance_of, rim_of, state_of
from viscontact.units.formatting import format_quantity

#: Remedy where chosen grids have too few cells.
FEWER_SPEEDS = "compute the fast and the slow speeds in different runs"

#: Ratio of speeds up to which a contact on the same grid is the guess for the next.
NEAR = 2.5


@dataclass
class SteadyCurve:
    """Contacts at the speeds of a run, from the fastest to the slowest.

    `done` holds the states so far by speed [m/s], `bars` their error bars, `work` the convolutions
    of the solver at each speed, in those of its grid.
    """

    problem: SteadyProblem
    run: PreparedRun
    errors: bool
    done: dict[float, ContactState] = field(default_factory=dict)
    bars: dict[float, Mapping[str, float]] = field(default_factory=dict)
    work: dict[float, float] = field(default_factory=dict)
    warnings: WarningCollector = field(default_factory=WarningCollector)

    def states(self) -> Iterator[tuple[ContactState, tuple[str, ...]]]:
        """Solve at each speed; yield the state, and the warnings that are new."""
        speeds = self.problem.speeds
        fresh = self.warnings.new(_run_warnings(self.problem, self.run))
        before: SteadyContact | None = None
        for index in np.argsort(-speeds).tolist():
            speed, grid = float(speeds[index]), self.run.grids[index]
            before, state, found = self._solve(speed, grid, before)
            fresh += self.warnings.new(found)
            yield state, fresh
            fresh = ()

    def dataset(self, transforms: str, wall_time: float) -> xr.Dataset | None:
        """The states so far, in the order of the speeds; None if there are none.

        With the library of the transforms and the time of the run [s].
        """
        speeds = np.array([speed for speed in self.problem.speeds.tolist() if speed in self.done])
        if not speeds.size:
            return None
        attributes = {
            "warnings": "\n".join(self.warnings.issued.values()),
            "memory_error": self.run.solver.law.error,
            "inversion_error": self.problem.contact.compliance.inversion_error,
            "transforms": transforms,
            "wall_time": wall_time,
        }
        states = [self.done[speed] for speed in speeds.tolist()]
        bars = [self.bars[speed] for speed in speeds.tolist()] if self.errors else None
        return steady_dataset(self.problem, speeds, states, bars, attributes)

    def _solve(
        self, speed: float, grid: Grid, before: SteadyContact | None
    ) -> tuple[SteadyContact, ContactState, dict[str, str]]:
        """Contact at one speed with its state and warnings, added to those that are done."""
        solver, tolerance = self.run.solver, self.problem.contact.tolerance
        coarse = solver.coarser(speed, grid, tolerance) if self.errors else None
        contact = solver.solve(speed, grid, tolerance, coarse or _near(before, speed, grid))
        self.work[speed] = contact.solution.work
        if coarse is not None:
            part = coarse.solution.values[0].size / contact.solution.values[0].size
            self.work[speed] += coarse.solution.work * part
        _refuse(contact, tolerance, chosen=not isinstance(self.problem.contact.grid, Grid))
        fine = self._measured(contact)
        found = _warnings(self.problem, contact, fine.rim)
        if self.errors:
            passed = grid.cell_size[self.problem.axis] / speed
            singular = entry_is_singular(self.problem.contact.compliance, passed)
            singular |= bool(SINGULAR_KINDS & set(found))
            self.bars[speed] = self._bars(fine, coarse, singular=singular)
        kept = bool(np.isin(speed, self.problem.kept))
        self.done[speed] = fine.state if kept else fine.state.without_fields()
        return contact, fine.state, found

    def _bars(
        self, fine: Measured, coarse: SteadyContact | None, *, singular: bool
    ) -> Mapping[str, float]:
        """Error bars, from a contact on a coarser grid if there is one."""
        if coarse is None or not (coarse.solution.converged and coarse.pressure.any()):
            return unknown_bars(self.problem)
        return error_bars(self.problem, fine, self._measured(coarse), singular=singular)

    def _measured(self, contact: SteadyContact) -> Measured:
        rim = rim_of(self.problem, contact)
        against = resistance_of(self.problem, contact)
        flows = self.run.solver.law.fluidity > 0 and not all(contact.grid.periodic)
        datum = contact.grid.has_datum and not flows
        state = state_of(self.problem, contact, rim, against, datum=datum)
        return Measured(state, rim, against)


def _near(before: SteadyContact | None, speed: float, grid: Grid) -> SteadyContact | None:
    """Contact at the neighbouring speed, if it is close by: elsewhere a coarser grid helps more."""
    if before is None or before.grid != grid or before.speed > NEAR * speed:
        return None
    return before


def _refuse(contact: SteadyContact, tolerance: float, *, chosen: bool) -> None:
    """Raise if a contact is not found, reaches the rim, or has too few cells."""
    grid, speed = contact.grid, format_quantity(contact.speed, "m/s", 6)
    solution = contact.solution
    cut = np.logical_and(overrun(contact.pressure), np.logical_not(grid.periodic))
    if cut.any():
        size = " x ".join(format_quantity(each, "m") for each in grid.size)
        remedy = (
            f"Give a grid of your own, larger than {size}"
            if chosen
            else f"Enlarge grid.size, now {size}, move grid.centre, or leave the grid out"
        )
        raise DomainError(
            f"grid: the contact reaches the grid's rim at {speed}; it need not lie at the body's "
            f"centre. {remedy}"
        )
    if not solution.converged:
        raise ConvergenceError(
            f"the contact solver stopped at {speed} with residual {solution.residual:.2g}, short "
            f"of the tolerance {tolerance:g}; likely causes: a resultant that hardly fits under "
            "the body, a grid too coarse for the contact, or a tolerance near rounding"
        )
    if not contact.pressure.any():
        raise ValueError(
            f"load: at {speed} the body does not touch the surface, so there is no contact in "
            "steady motion; press it on"
        )


def _run_warnings(problem: SteadyProblem, run: PreparedRun) -> dict[str, str]:
    """Warnings, by kind, that hold for all speeds."""
    compliance, law = problem.contact.compliance, run.solver.law
    found = law_warnings(law.error, compliance.inversion_error)
    found |= datum_warnings(run.grids[0], ("approach",))
    if run.tolerance_reached is not None:
        requested = problem.contact.automatic_grid
        assert requested is not None
        found["lattice"] = (
            "grid: the contacts at these speeds differ so much in size that in their common cells "
            f"the smallest has a tolerance of about {run.tolerance_reached:.2g} in place of "
            f"{requested.tolerance:.2g}; {FEWER_SPEEDS}"
        )
    if run.solver.law.fluidity and not all(run.grids[0].periodic):
        found["fluid"] = (
            "the material flows, so that the approach grows without limit with the distance "
            "travelled: approach is not defined (NaN), and displacement has an unknown constant"
        )
    if compliance.instant == 0:
        found["instant"] = (
            "the law has no instant compliance: where the surface is loaded first, pressure may "
            "depend on the mesh"
        )
    if problem.tilts_freely:
        found |= free_tilt_warnings([f"tilt_{problem.along}"])
    return found


def _warnings(problem: SteadyProblem, contact: SteadyContact, rim: Rim) -> dict[str, str]:
    """Warnings, by kind, about the contact at one speed."""
    body, grid = problem.contact, contact.grid
    if rim.cells_across < MIN_CELLS_ACROSS:
        more = (
            f"use more cells than {grid.shape[0]} x {grid.shape[1]} or a smaller grid.size"
            if isinstance(body.grid, Grid)
            else FEWER_SPEEDS
        )
        raise DomainError(
            f"grid: only {rim.cells_across} cells lie across the contact at "
            f"{format_quantity(contact.speed, 'm/s')} and {MIN_CELLS_ACROSS} are the least (20 or "
            f"more recommended); {more}"
        )
    geometry = Geometry(
        body.indenter,
        gap_on(problem, grid),
        grid,
        thickness=body.thickness,
        indenter_gives=body.indenter_material is not None,
    )
    pressure, motion = contact.pressure, contact.solution.motion
    strain = strain_of(float(pressure.max()), contact.domain.compliance)
    passed = (rim.length, rim.width)[problem.axis] / contact.speed
    return (
        mesh_warnings(rim.cells_across, cells_across_spots(pressure > 0, periodic=grid.periodic))
        | corner_warnings(geometry, grid.largest_at(pressure), strain)
        | geometry_warnings(geometry, rim, motion, contact.displacement, pressure)
        | data_warnings(passed, body.measured_until)
        | edge_warnings(along=False, across=math.isnan(force_across(problem, contact)))
    )
