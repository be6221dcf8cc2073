"""Plan of a sensitivity: the runs around the values of a case, all on one grid."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.case import Case, CaseError
from viscontact.runs.preparation import PreparedRun, prepared
from viscontact.studies.case_values import case_with, fields_setting
from viscontact.studies.cells import coarser, covering, grid_setting, shape_setting
from viscontact.studies.evaluation import Level
from viscontact.studies.sensitivity.differences import ABOVE, BELOW, CENTRAL, Stencil
from viscontact.studies.sensitivity.inputs import CaseNumber
from viscontact.studies.sensitivity.samples import Samples
from viscontact.studies.sweep.continuation import recorded_runs
from viscontact.studies.sweep.varied_runs import VariedRun

#: Halvings of the step of an input that is close to a limit, before its differences are one-sided.
HALVINGS = 3
#: Parts of a distribution whose values the common grid covers.
EXTREMES = (1e-4, 1 - 1e-4)
#: Name of the run with the values of the case.
NOMINAL = "nominal"

_WITHOUT_ERRORS = {"output.errors": "false"}


@dataclass(frozen=True)
class Derivative:
    """Derivative of the outputs by an input: its stencil, and the step in the logarithm."""

    given: CaseNumber
    stencil: Stencil
    step: float

    def settings(self, point: int) -> dict[str, str]:
        """Setting of the case at a point."""
        return {self.given.key: self.given.at(point * self.step)}

    def run_name(self, point: int, cells: Level = "case") -> str:
        """Name of the run at a point; the nominal one has the values of the case."""
        return named(f"{self.given.key}{point:+d}" if point else NOMINAL, cells)


def named(name: str, cells: Level) -> str:
    """Name of a run on the cells of the case, or on coarser ones."""
    return name if cells == "case" else f"{name}, coarse"


@dataclass(frozen=True)
class Plan:
    """Runs of a sensitivity."""

    case: Path
    settings: Mapping[str, str]  # of all runs
    cells: Mapping[Level, Mapping[str, str]]  # settings of the common grid, by kind
    derivatives: tuple[Derivative, ...]
    samples: Samples | None = None
    fields: Mapping[str, str] = field(default_factory=dict)  # setting of those that are kept

    def runs(self) -> list[VariedRun]:
        """Return all runs, first that of the case itself."""
        return list(self._runs())

    def _runs(self) -> Iterator[VariedRun]:
        for cells in self.cells:
            # Only the run of the case needs error bars.
            own = {} if cells == "case" else _WITHOUT_ERRORS
            yield self._run(named(NOMINAL, cells), own, (), cells)
            for each in self.derivatives:
                for point in each.stencil.points:
                    own = {**_WITHOUT_ERRORS, **each.settings(point)}
                    yield self._run(each.run_name(point, cells), own, (each.given.key,), cells)
        for name, settings in self.samples.runs() if self.samples else ():
            yield self._run(name, {**_WITHOUT_ERRORS, **settings}, tuple(settings), "case")

    def _run(
        self, name: str, own: Mapping[str, str], varied: tuple[str, ...], cells: Level
    ) -> VariedRun:
        settings = {**self.settings, **self.cells[cells], **self.fields, **own}
        directory = re.sub(r"[^\w.+-]+", "-", name)
        whole = self.case.parent.resolve() / self.case.name
        return VariedRun(whole, settings, varied, name, directory, "sample")


def planned(
    path: Path,
    settings: Mapping[str, str],
    inputs: Sequence[CaseNumber],
    step: float,
    directory: Path | None,
    samples: Samples | None = None,
    *,
    chosen: bool,
) -> tuple[Plan, list[str]]:
    """Plan derivatives by some inputs, and samples, with notes on inputs that cannot change.

    CaseError if an input that was `chosen` cannot change, or a bound of the samples is refused.
    """
    found, notes, grids = [], [], []
    case = case_with(path, settings)
    nominal = prepared(case)
    for given in inputs:
        try:
            derivative, runs = _derivative(path, settings, given, step)
        except CaseError as error:
            if chosen:
                raise
            notes.append(f"{given.key}: left out, as it cannot change: {error.problems[0]}")
            continue
        found.append(derivative)
        grids += [each.run.grid for each in runs]
    if samples is not None:
        grids += _of_samples(path, settings, samples)
    recorded = _recorded_grid(path, settings, directory)
    grid = recorded or covering(nominal.run.grid, grids)
    cells = _settings_of(case, grid)
    if not case.errors:
        del cells["coarse"]
    return Plan(path, settings, cells, tuple(found), samples, fields_setting(case)), notes


def _of_samples(path: Path, settings: Mapping[str, str], samples: Samples) -> list[Grid]:
    """Grids of the bounds of each input, and of those together that have large or small grids."""

    def grid(values: Mapping[str, str]) -> Grid:
        return prepared(case_with(path, {**settings, **values})).run.grid

    found, corners = [], ({}, {})  # type: tuple[list[Grid], tuple[dict[str, str], dict[str, str]]]
    for each in samples.inputs:
        ends = sorted(
            ((grid({each.key: value}), value) for value in map(each.value, EXTREMES)),
            key=lambda end: math.prod(end[0].size),
        )
        found += [end for end, _ in ends]
        for corner, (_, value) in zip(corners, ends, strict=True):
            corner[each.key] = value
    return [*found, *(map(grid, corners) if len(samples.inputs) > 1 else ())]


def _settings_of(case: Case, grid: Grid) -> dict[Level, Mapping[str, str]]:
    """Settings of the common grid; the case may have given one."""
    if isinstance(case.grid, Grid):
        return {"case": {}, "coarse": shape_setting(coarser(case.grid).shape)}
    return {"case": grid_setting(grid), "coarse": grid_setting(coarser(grid))}


def _derivative(
    path: Path, settings: Mapping[str, str], given: CaseNumber, step: float
) -> tuple[Derivative, list[PreparedRun]]:
    """Derivative with the first step and stencil whose outer points the case accepts."""
    tried = [Derivative(given, CENTRAL, step / 2**n) for n in range(HALVINGS + 1)]
    tried += [Derivative(given, each, step / 4) for each in (BELOW, ABOVE)]
    problem: CaseError | None = None
    for each in tried:
        outer = {min(each.stencil.points), max(each.stencil.points)}
        try:
            runs = [
                prepared(case_with(path, {**settings, **each.settings(point)}))
                for point in sorted(outer)
            ]
        except CaseError as error:
            problem = problem or error
        else:
            return each, runs
    assert problem is not None
    raise problem


def _recorded_grid(path: Path, settings: Mapping[str, str], directory: Path | None) -> Grid | None:
    """Grid of the runs that a directory holds; None without any."""
    runs = [] if directory is None else recorded_runs(directory)
    if not runs:
        return None
    first = runs[0].settings
    kept = {key: value for key, value in first.items() if key.partition(".")[0] == "grid"}
    grid = case_with(path, {**settings, **kept}).grid
    return grid if isinstance(grid, Grid) else None
