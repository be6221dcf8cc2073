"""Common cells in the settings of the runs of a command, also of runs that are resumed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from viscontact.case import CaseError
from viscontact.case.document import read_document
from viscontact.cli.sweep.request import PlannedRun
from viscontact.cli.terminal.messages import CommandError, say
from viscontact.results.run_files import CASE_NAME
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.sweep.common_cells import (
    KEY,
    cell_setting,
    common_cells,
    keeps_own_cells,
    recorded_cells,
)
from viscontact.studies.sweep.manifest import SweepRun
from viscontact.studies.sweep.varied_runs import case_name


def with_common_cells(
    planned: Sequence[PlannedRun],
    option: str,
    settings: Sequence[str] = (),
    earlier: Sequence[SweepRun] = (),
    memory: float | None = None,
) -> list[RunRequest]:
    """Add the common cells to the settings of runs, each within a memory [bytes]."""
    # Runs keep their own cells where the keys concern the grid, where the grid or its largest cell
    # is given, or where the common cells would be too many. A resumed sweep has those of its
    # manifest.
    sweeps: dict[Path, list[PlannedRun]] = {}
    for each in planned:
        sweeps.setdefault(each.request.case, []).append(each)
    added = {
        case: _setting(runs, option, settings, earlier, memory) for case, runs in sweeps.items()
    }
    requests = (each.request for each in planned)
    return [replace(each, settings=(*each.settings, *added[each.case])) for each in requests]


def _setting(
    planned: Sequence[PlannedRun],
    option: str,
    settings: Sequence[str],
    earlier: Sequence[SweepRun],
    memory: float | None,
) -> tuple[str, ...]:
    """Setting of the common cells of the runs of a case; none if they keep their own."""
    design, requests = planned[0].design, [each.request for each in planned]
    case, quiet = requests[0].case, requests[0].quiet
    try:
        if not design.keys or keeps_own_cells(case, design, settings):
            return ()
        if requests[0].output is not None:
            name = case_name(case, requests[0].output.parent.resolve())
            if (recorded := recorded_cells(earlier, name)) is not None:
                return recorded
        begun = [_begun_with(each) for each in requests if each.resume]
        if begun_with := [cells for cells in begun if cells is not None]:
            return begun_with[0]
        cells = common_cells(case, design, settings, requests[0].threads, memory)
    except (CaseError, CommandError):
        return ()  # reported when the runs are checked
    if not quiet:
        say(
            f"{option}: common cells of {cells} in all runs of {case}"
            if cells.affordable
            else f"{option}: each run of {case} has cells of its own, as common cells of {cells} "
            "would be too many; mesh-dependent values of different runs cannot be compared"
        )
    return cells.settings


def _begun_with(request: RunRequest) -> tuple[str, ...] | None:
    """Setting of the common cells of a run, none if it has its own; None if it has not begun."""
    recorded = (request.output or Path()) / CASE_NAME
    if not recorded.is_file():
        return None
    grid = read_document(recorded).data.get("grid")
    cell = grid.get(KEY) if isinstance(grid, dict) else None
    return cell_setting(*cell) if isinstance(cell, list) else ()
