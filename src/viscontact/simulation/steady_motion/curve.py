"""Curve of steady contacts over speed: solved, measured and checked."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.bodies.grid import MIN_CELLS_ACROSS, Grid
from viscontact.mechanics.contact.rim import Rim
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.checks.collector import WarningCollector
from viscontact.simulation.checks.contact_geometry import Geometry
from viscontact.simulation.checks.covers import covers_of
from viscontact.simulation.checks.ends import datum_of_ends_warnings, stress_left_on_ends
from viscontact.simulation.checks.friction import coupling_warnings
from viscontact.simulation.checks.half_space_theory import (
    SINGULAR_KINDS,
    corner_warnings,
    geometry_warnings,
)
from viscontact.simulation.checks.material import (
    data_warnings,
    law_warnings,
    origin_warnings,
    passage_warnings,
    splitting_warnings,
)
from viscontact.simulation.checks.mesh import cells_across_spots, layer_warnings, mesh_warnings
from viscontact.simulation.checks.motion import edge_warnings, free_tilt_warnings
from viscontact.simulation.checks.periodicity import datum_warnings
from viscontact.simulation.checks.singularities import strain_of
from viscontact.simulation.checks.temperature import shift_warnings
from viscontact.simulation.checks.tested_limits import (
    Contact,
    limit_warnings,
    limited_bodies,
    temperature_warnings,
)
from viscontact.simulation.steady_motion.contact import (
    Neighbour,
    SteadyContact,
    SteadySolver,
    gap_on,
)
from viscontact.simulation.steady_motion.coupled import CoupledSolver
from viscontact.simulation.steady_motion.error_bars import (
    Measured,
    entry_is_singular,
    error_bars,
    unknown_bars,
)
from viscontact.simulation.steady_motion.preparation import SteadySetup
from viscontact.simulation.steady_motion.problem import SteadyProblem
from viscontact.simulation.steady_motion.state import force_across, resistance_of, rim_of, state_of
from viscontact.simulation.steady_motion.traction_bars import (
    coupled_bars,
    traction_bars,
    unknown_traction_bars,
)
from viscontact.simulation.transient.grid_enlargement import overrun
from viscontact.units.formatting import format_quantity

#: Remedy where chosen grids have too few cells.
FEWER_SPEEDS = "compute the fast and the slow speeds in different runs"

#: Ratio of speeds up to which a contact on the same grid is the guess for the next.
NEAR = 2.5


class SteadyCurve:
    """Loop over the speeds of a run, which can continue to the same bits after any of them."""

    outcome = Outcome.CONVERGED

    def __init__(
        self, run: SteadySetup, restart_data: RestartData | None = None, *, errors: bool = True
    ) -> None:
        self._run, self._errors = run, errors
        self.done = 0
        self._before: Neighbour | None = None
        self.bars: list[Mapping[str, float | Floats]] = []  # at each speed; empty without errors
        # Convolutions of the solver at each speed, in those of its grid.
        self.work: list[float] = []
        #: Largest stress left on free ends over the peak pressure, at the speeds so far [-].
        self.end_stress_left = 0.0
        self.warnings = WarningCollector()
        if restart_data is not None:
            self._restore(restart_data)

    def __iter__(self) -> Iterator[ContactState]:
        """Solve at the remaining speeds; yield each state, with the warnings that are new."""
        speeds = self._run.problem.speeds.tolist()
        for speed, grid in list(zip(speeds, self._run.grids, strict=True))[self.done :]:
            fresh = self.warnings.new(run_warnings(self._run)) if not self.done else ()
            state, found = self._solve(speed, grid)
            self.done += 1
            yield replace(state, warnings=fresh + self.warnings.new(found))

    @property
    def left(self) -> int:
        """Speeds still to come."""
        return len(self._run.grids) - self.done

    def restart_data(self) -> RestartData:
        """Return the state after a speed as plain data."""
        before = self._before
        return {
            "done": self.done,
            "warnings": dict(self.warnings.issued),
            "bars": [dict(each) for each in self.bars],
            "end_stress_left": self.end_stress_left,
            "before": before and {"pressure": before.pressure, "motion": before.motion},
        }

    def _restore(self, data: RestartData) -> None:
        self.done, self.bars = int(data["done"]), list(data["bars"])
        self.end_stress_left = float(data.get("end_stress_left", 0.0))
        self.warnings.new(data["warnings"])
        if data["before"] is not None:
            last = self.done - 1
            speed, grid = float(self._run.problem.speeds[last]), self._run.grids[last]
            pressure, motion = data["before"]["pressure"], data["before"]["motion"]
            if pressure.shape != grid.shape:
                raise ValueError("the pressure belongs to another grid")
            self._before = Neighbour(speed, grid, pressure, motion)

    def _solve(self, speed: float, grid: Grid) -> tuple[ContactState, dict[str, str]]:
        """State and warnings of the contact at one speed."""
        solver, problem = self._run.coupled or self._run.solver, self._run.problem
        tolerance = problem.contact.tolerance
        coarser = self._run.solver.coarser_grid(grid) if self._errors else None
        coarse = _solved_if_any(solver, speed, coarser, tolerance)
        near = _nearby_contact(self._before, speed, grid) if coarse is None else coarse.neighbour
        contact = solver.solve(speed, grid, tolerance, near)
        work = contact.solution.work
        if coarse is not None:
            part = coarse.solution.values[0].size / contact.solution.values[0].size
            work += coarse.solution.work * part
        _refuse(contact, tolerance, chosen=not isinstance(problem.contact.grid, Grid))
        fine = self._measure(contact)
        found = _warnings(problem, contact, fine.rim)
        fine = self._with_traction(fine, contact)
        if self._errors:
            passed = grid.cell_size[problem.axis] / speed
            singular = entry_is_singular(problem.contact.compliance, passed)
            singular |= bool(SINGULAR_KINDS & set(found))
            self.bars.append(self._bars(contact, fine, coarse, singular=singular))
        self.work.append(work)
        self._before = contact.neighbour
        return fine.state, found

    def _bars(
        self,
        contact: SteadyContact,
        fine: Measured,
        coarse: SteadyContact | None,
        *,
        singular: bool,
    ) -> Mapping[str, float | Floats]:
        """Error bars, from a contact on a coarser grid if there is one."""
        problem, traction = self._run.problem, fine.state.rolling_traction
        if coarse is None or not (coarse.solution.converged and coarse.in_contact.any()):
            return {**unknown_bars(problem), **unknown_traction_bars(traction)}
        other = self._measure(coarse)
        bars: dict[str, float | Floats] = {
            **error_bars(problem, fine, other, singular=singular, ends=self._ends_error(contact))
        }
        if traction is None:
            return bars
        if problem.contact.is_coupled:
            bars |= coupled_bars(problem, fine, bars)
        try:
            rough = self._with_traction(other, coarse).state.rolling_traction
        except ConvergenceError:
            return bars | unknown_traction_bars(traction)
        assert rough is not None  # as of the finer contact
        return bars | traction_bars(problem, fine, traction, rough)

    def _ends_error(self, contact: SteadyContact) -> float:
        """Relative error by free ends: of their operator, and by stress that is left on them."""
        if not self._run.problem.contact.ended_bodies:
            return 0.0
        left = stress_left_on_ends(self._run.problem.contact, contact.grid, contact.pressure)
        self.end_stress_left = max(self.end_stress_left, left)
        return self._run.ends_error + left

    def _measure(self, contact: SteadyContact) -> Measured:
        problem = self._run.problem
        rim = rim_of(problem, contact)
        against = resistance_of(problem, contact)
        sinks = self._run.solver.laws.sinks and not all(contact.grid.periodic)
        datum = problem.contact.has_datum(contact.grid) and not sinks
        state = state_of(problem, contact, rim, against, datum=datum)
        if not self._run.tilts_from_datum:
            state = replace(state, tilt_x=math.nan)
        return Measured(state, rim, against)

    def _with_traction(self, found: Measured, contact: SteadyContact) -> Measured:
        """A contact with its tractions, of a body that rolls with creepages."""
        solver = self._run.tractions
        if solver is None:
            return found
        traction = contact.traction or solver.solve(contact)
        return replace(found, state=replace(found.state, rolling_traction=traction))


def _solved_if_any(
    solver: SteadySolver | CoupledSolver, speed: float, grid: Grid | None, tolerance: float
) -> SteadyContact | None:
    """Contact on a coarser grid; None without one, or where coupled bodies are not solved there."""
    try:
        return None if grid is None else solver.solve(speed, grid, tolerance)
    except ConvergenceError:
        return None


def _nearby_contact(before: Neighbour | None, speed: float, grid: Grid) -> Neighbour | None:
    """Contact at the last speed, if it is close by: elsewhere a coarser grid helps more."""
    if before is None or before.grid != grid:
        return None
    ratio = before.speed / speed
    return before if 1 / NEAR <= ratio <= NEAR else None


def _refuse(contact: SteadyContact, tolerance: float, *, chosen: bool) -> None:
    """Raise if a contact is not found, reaches the rim, or has too few cells."""
    grid, speed = contact.grid, format_quantity(contact.speed, "m/s", 6)
    solution = contact.solution
    cut = np.logical_and(overrun(contact.in_contact), np.logical_not(grid.periodic))
    if cut.any():
        size = " x ".join(format_quantity(each, "m") for each in grid.size)
        remedy = (
            f"Give a grid of your own, larger than {size}"
            if chosen
            else f"Enlarge grid.size, now {size}, move grid.centre, or leave the grid out"
        )
        raise DomainError(
            f"grid: the contact reaches the edge of the grid at {speed}; it need not lie at the "
            f"body's centre. {remedy}"
        )
    if not solution.converged:
        raise ConvergenceError(
            f"the contact solver stopped at {speed} with residual {solution.residual:.2g}, short "
            f"of the tolerance {tolerance:g}; likely causes: a resultant that hardly fits under "
            "the body, a grid too coarse for the contact, or a tolerance near rounding"
        )
    if not contact.in_contact.any():
        raise ValueError(
            f"load: at {speed} the body does not touch the surface, so there is no contact in "
            "steady motion; press it on"
        )


def run_warnings(run: SteadySetup) -> dict[str, str]:
    """Warnings, by kind, that hold for all speeds."""
    problem = run.problem
    compliance, laws, surface = problem.contact.compliance, run.solver.laws, problem.contact.surface
    found = law_warnings(laws.error, compliance.inversion_error)
    found |= splitting_warnings(surface.splitting_error)
    found |= origin_warnings(problem.contact.materials)
    found |= temperature_warnings(problem.contact.materials) | shift_warnings(problem.contact)
    found |= datum_warnings(run.grids[0], ("approach",), supported=surface.is_supported)
    found |= datum_of_ends_warnings(problem.contact, ("approach",), tilts=run.tilts_from_datum)
    found |= coupling_warnings(problem.contact)
    found |= layer_warnings(problem.contact.thinnest_layer, run.grids[0].cell_size)
    if run.tolerance_reached is not None:
        requested = problem.contact.automatic_grid
        assert requested is not None
        found["lattice"] = (
            "grid: the contacts at these speeds differ so much in size that in their common cells "
            f"the smallest has a tolerance of about {run.tolerance_reached:.2g} in place of "
            f"{requested.tolerance:.2g}; {FEWER_SPEEDS}"
        )
    if laws.sinks and not all(run.grids[0].periodic):
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
        found |= free_tilt_warnings([f"tilt_{problem.motion.along}"])
    return found


def geometry_of(
    problem: SteadyProblem,
    open_gap: Floats,
    grid: Grid,
    passed: float,
    *,
    predicted: bool = False,
) -> Geometry:
    """Return what the warnings about a contact's geometry need; it is `passed` in a time [s]."""
    body = problem.contact
    return Geometry(
        body.indenter,
        open_gap,
        grid,
        thickness=body.thickness,
        indenter_gives=body.indenter_material is not None
        and "indenter_material" not in body.ended_bodies,
        planes=body.planes,
        covers=covers_of(body.bodies, passed),
        is_supported=body.surface.is_supported,
        predicted=predicted,
    )


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
    passed = (rim.length, rim.width)[problem.axis] / contact.speed
    geometry = geometry_of(problem, gap_on(problem, grid), grid, passed)
    spots = cells_across_spots(contact.in_contact, periodic=grid.periodic)
    pressure, motion = contact.pressure, contact.solution.motion
    strain = strain_of(float(pressure.max()), contact.domain.local_compliance)
    force = float(pressure.sum()) * grid.cell_area
    load = Contact(
        force / max(rim.area, force / float(pressure.max())),
        min(rim.length, rim.width) / 2,
        float(motion[0]) if body.has_datum(grid) else math.nan,
        passed,
        f"at {format_quantity(contact.speed, 'm/s')}",
        float(pressure.max()),
        grid.line_length is not None,
        True,
    )
    return (
        mesh_warnings(rim.cells_across, spots)
        | corner_warnings(geometry, grid.largest_at(pressure), strain)
        | geometry_warnings(geometry, rim, motion, contact.displacement, pressure)
        | data_warnings(passed, body.data_times)
        | passage_warnings(passed, body.data_times)
        | limit_warnings(limited_bodies(body.bodies), load)
        | edge_warnings(along=False, across=math.isnan(force_across(problem, contact)))
    )
