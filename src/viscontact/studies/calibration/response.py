"""Runs of a calibration: the response of a case to the load of a record, on fixed cells."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.bodies.loads import ApproachHistory, ForceHistory, LoadHistory
from viscontact.bodies.loads.history import Control
from viscontact.case import Case
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.coarser_grids import aligned_spacing, coarser_grid
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import RunSetup, prepare_run
from viscontact.studies.calibration.record import ContactRecord, Drive, compared_column
from viscontact.studies.case_values import case_with
from viscontact.studies.evaluation import Level
from viscontact.studies.journal import Entry

#: Cells of the search across the longer and the shorter edge of the grid, at least, if the case has
#: more.
_LONG_EDGE, _SHORT_EDGE = 64, 16
#: Least ratio of cells that makes coarser ones worth while.
_LEAST_RATIO = 1.25


@dataclass(frozen=True, eq=False)
class Experiment:
    """Measured record with the case that describes it, and the cells of its runs."""

    case: Path
    settings: Mapping[str, str]  # fixed values by key
    record: ContactRecord
    drive: Drive
    control: Control  # of the load of the case
    own_cells: Grid  # of the case
    coarse_cells: Grid  # of the search
    may_grow: bool  # the grid of the case is automatic
    number: int = 0  # of the record

    @property
    def compared(self) -> Control:
        """Column that is fitted."""
        return compared_column(self.drive, self.control)

    @property
    def measured(self) -> Floats:
        """Values that are fitted [N or m]."""
        return self.record.column(self.compared)


@dataclass(frozen=True)
class Mounting:
    """Zero of the approach, and compliance of the machine."""

    contact_point: float = 0.0  # reading at first touch [m]
    compliance: float = 0.0  # of the machine [m/N]


@dataclass(frozen=True, eq=False)
class RecordRun:
    """Run of a test: force and approach at the rows of the record [N, m], without the machine."""

    experiment: Experiment
    values: Mapping[str, str]  # by key of the case
    mounting: Mounting  # counts if the reading of the approach is prescribed
    level: Level

    @property
    def key(self) -> str:
        """Cells, number of the record, mounting and values."""
        values = ", ".join(f"{key}={value}" for key, value in self.values.items())
        point, compliance = self.mounting.contact_point, self.mounting.compliance
        return f"{self.level} {self.experiment.number} {point!r} {compliance!r} {values}"

    def __call__(self) -> Entry:
        """Simulate the run."""
        test = self.experiment
        cells = test.own_cells if self.level == "case" else test.coarse_cells
        case = case_with(test.case, {**test.settings, **self.values})
        load, rows, instants = history_of(case, test.record, test.drive, self.mounting)
        if self.level == "case":
            instants = _halve_steps(instants)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", AccuracyWarning)
            run = prepare_run(_problem(case, load, instants, cells))
            if test.may_grow:  # the cells stay, but a larger contact gets more of them
                run = replace(run, problem=replace(run.problem, grid=case.automatic_grid))
            states = [state for state in March(run, warns=False) if state is not None]
        chosen = np.searchsorted([state.time for state in states], rows * (1 - 1e-12))
        names = ("force", "approach")
        found = {name: [float(getattr(states[n], name)) for n in chosen] for name in names}
        if case.adhesion is not None:
            events = [event for state in states for event in state.events]
            begin = float(test.record.times[0] - rows[0])
            found["jump_times"] = [begin + event.time for event in events]
            found["jump_forces"] = [float(event.force[1] - event.force[0]) for event in events]
        return Entry(found)


def history_of(
    case: Case, record: ContactRecord, drive: Drive, mounting: Mounting
) -> tuple[LoadHistory, Floats, Floats]:
    """Load of the run of a record, its rows' times in the run, and all instants of the run [s]."""
    if drive == "case":
        rows = record.times
        own = case.instants if case.adaptive is None else np.zeros(0)
        return case.load, rows, np.unique(np.concatenate([rows, own[own <= rows[-1]]]))
    times = record.times - record.times[0]
    points = [case.load.at(float(time)) for time in times]

    def along(name: str) -> list[float] | None:
        values = [getattr(point, name) for point in points]
        return None if values[0] is None else values

    tilts = (along("tilt_x"), along("tilt_y"))
    arms = (along("eccentricity_x") or 0.0, along("eccentricity_y") or 0.0)
    if drive == "force":
        force = np.maximum(record.column("force"), 0.0)
        return ForceHistory(times, force, *arms, *tilts), times, np.unique(times)
    if any(map(np.any, arms)):
        raise ValueError(
            "load: an eccentricity goes with a prescribed force; under a prescribed approach give "
            "load.tilt_x or load.tilt_y"
        )
    level = record.column("approach") - mounting.contact_point
    if mounting.compliance:
        level = level - mounting.compliance * record.column("force")
    spring = case.load.stage_stiffness if isinstance(case.load, ApproachHistory) else None
    if spring is not None:  # the record has the approach of the body, not of the stage
        level = level + record.column("force") / spring
    load = ApproachHistory(times, level, *tilts, stage_stiffness=spring)
    return load, times, np.unique(times)


def cells_of(case: Case, record: ContactRecord, drive: Drive) -> tuple[Grid, Grid]:
    """Cells of the runs of a record: those of the case, and coarser ones of the search."""
    load, _, instants = history_of(case, record, drive, Mounting())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        run = prepare_run(_problem(case, load, instants, case.grid))
    return run.grid, _coarse(run)


def _problem(
    case: Case, load: LoadHistory, instants: Floats, cells: Grid | AutomaticGrid | None
) -> Problem:
    return Problem(
        *(case.indenter, case.material, load, cells, instants, case.indenter_material),
        tolerance=case.tolerance,
        kept=NO_FIELDS,
        temperature=case.temperature,
        friction=case.friction,
        tangential=case.tangential,
        adhesion=case.adhesion,
    )


def _coarse(run: RunSetup) -> Grid:
    """Coarser cells over the same region; those of the run if it has few, or a cohesive zone."""
    if run.law is not None:
        return run.grid
    edges = [n for n in run.grid.shape if n > 1]
    ratio = min(max(2.0, max(edges) / _LONG_EDGE), min(edges) / _SHORT_EDGE)
    if ratio < _LEAST_RATIO:
        return run.grid
    return coarser_grid(run.grid, aligned_spacing(run, ratio, True), True)


def _halve_steps(instants: Floats) -> Floats:
    """Instants with further ones in the middle of the steps, from time 0 on [s]."""
    whole = np.union1d([0.0], instants)
    return np.union1d(whole, (whole[1:] + whole[:-1]) / 2)
