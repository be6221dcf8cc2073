"""Common cells of the runs of a sweep, so that their results can be compared.

Runs that vary a key choose automatic grids of their own. A peak pressure without a limit depends on
the cells, and the errors of all other values jump from grid to grid. Therefore the runs of one case
get the smallest cells that any of them chooses, as the setting `grid.largest_cell`, which is
recorded with each run. A run is resumed on the cells that it began with.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from viscontact.case import CaseError, read_case
from viscontact.case.document import read_document
from viscontact.cli.many.request import PlannedRun
from viscontact.cli.terminal.messages import CommandError, say
from viscontact.run_files import CASE_NAME
from viscontact.runs import resources
from viscontact.runs.execution.checked_run import prepare
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.processes.request import RunRequest
from viscontact.runs.sweep.extremes import extreme_rows
from viscontact.runs.sweep.manifest import SweepRun
from viscontact.simulation.setup import RunSetup
from viscontact.units.formatting import format_quantity

#: Key of the case, in its section `grid`.
_KEY = "largest_cell"

#: Most cells of a run on common cells, unless its own choice has more.
MOST_CELLS = 2**16


def with_common_cells(
    planned: Sequence[PlannedRun], option: str, earlier: Sequence[SweepRun] = ()
) -> list[RunRequest]:
    """Add the common cells to the settings of runs that differ in the values of some keys.

    Runs keep their own cells where the keys concern the grid, where the grid or its largest cell
    is given, or where the common cells would be too many. The cells of a sweep that is resumed
    are those of its earlier runs in the manifest.
    """
    sweeps: dict[Path, list[PlannedRun]] = {}
    for each in planned:
        sweeps.setdefault(each.request.case, []).append(each)
    added = {case: _settings(runs, option, earlier) for case, runs in sweeps.items()}
    requests = (each.request for each in planned)
    return [replace(each, settings=(*each.settings, *added[each.case])) for each in requests]


def _settings(
    planned: Sequence[PlannedRun], option: str, earlier: Sequence[SweepRun]
) -> tuple[str, ...]:
    """Setting of the common cells of the runs of a case; none if they keep their own."""
    design, requests = planned[0].design, [each.request for each in planned]
    if not design.keys or any(key.partition(".")[0] == "grid" for key in design.keys):
        return ()
    try:
        asked = read_case(requests[0].case, requests[0].settings).automatic_grid
        if len(requests) == 1 or asked is None or asked.largest_cell is not None:
            return ()
        places = {each.output.name for each in requests if each.output is not None}
        for run in earlier:
            if run.directory in places:
                cell = run.settings.get(f"grid.{_KEY}")
                return () if cell is None else (f"grid.{_KEY}={cell}",)
        begun = [found for each in requests if each.resume and (found := _begun_with(each))]
        if begun:
            return begun[0].settings
        return _chosen([requests[row] for row in extreme_rows(design)], option)
    except (CaseError, CommandError):
        return ()  # reported when the runs are checked


@dataclass(frozen=True)
class _Begun:
    """Setting of the common cells of a run that has begun; none if it has cells of its own."""

    settings: tuple[str, ...]


def _begun_with(request: RunRequest) -> _Begun | None:
    """Cells that a run began with; None if it has not begun."""
    recorded = (request.output or Path()) / CASE_NAME
    if not recorded.is_file():
        return None
    grid = read_document(recorded).data.get("grid")
    cell = grid.get(_KEY) if isinstance(grid, dict) else None
    return _Begun(_setting(*cell) if isinstance(cell, list) else ())


def _chosen(requests: Sequence[RunRequest], option: str) -> tuple[str, ...]:
    """The smallest cells that any of the runs chooses, as a setting."""
    runs = [prepare(each.case, each.settings, each.threads).run for each in requests]
    dx, dy = np.min([run.grid.cell_size for run in runs], axis=0).tolist()
    shown = " x ".join(format_quantity(length, "m", 3) for length in (dx, dy))
    affordable = all(_is_affordable(run, (dx, dy)) for run in runs)
    if not requests[0].quiet:
        say(
            f"{option}: common cells of {shown} in all runs of {requests[0].case}"
            if affordable
            else f"{option}: each run of {requests[0].case} has cells of its own, as common cells "
            f"of {shown} would be too many; mesh-dependent values of different runs cannot be "
            "compared"
        )
    return _setting(*(f"{1e6 * length:.9g} um" for length in (dx, dy))) if affordable else ()


def _is_affordable(run: RunSetup, cell: tuple[float, float]) -> bool:
    """Test whether a run on smaller cells fits into the limit and into the free memory."""
    before = math.prod(run.grid.shape)
    now = math.prod(size / length for size, length in zip(run.grid.size, cell, strict=True))
    arrays = (resources.run_memory(run) - resources.PROGRAM) * now / before
    return now <= max(before, MOST_CELLS) and resources.PROGRAM + arrays < available_memory()


def _setting(dx: str, dy: str) -> tuple[str, ...]:
    return (f"grid.{_KEY}=[{dx}, {dy}]",)
