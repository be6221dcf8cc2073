"""Common cells of the runs of a sweep, so that their results can be compared.

Runs that vary a key choose automatic grids of their own. A peak pressure without a limit depends on
the cells, and the errors of all other values jump from grid to grid. Therefore the runs of one case
get the smallest cells that any of them chooses, as the setting `grid.largest_cell`, which is
recorded with each run. A run is resumed on the cells that it began with.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import read_case
from viscontact.runs import run_memory
from viscontact.runs.analysis import Analysis
from viscontact.runs.execution.prepared_case import prepare
from viscontact.runs.machine.memory import available_memory
from viscontact.studies.sweep.designs import Design
from viscontact.studies.sweep.extremes import extreme_rows
from viscontact.studies.sweep.manifest import SweepRun
from viscontact.units.formatting import format_quantity

#: Key of the case, in its section `grid`.
KEY = "largest_cell"

#: Most cells of a run on common cells, unless its own choice has more.
MOST_CELLS = 2**16


@dataclass(frozen=True)
class CommonCells:
    """Smallest cells that any of some runs chooses, and whether all can be computed on them."""

    lengths: tuple[float, float]  # [m]
    affordable: bool

    @property
    def settings(self) -> tuple[str, ...]:
        """Setting of the cells; none if there are too many of them."""
        lengths = (f"{1e6 * length:.9g} um" for length in self.lengths)
        return cell_setting(*lengths) if self.affordable else ()

    def __str__(self) -> str:
        return " x ".join(format_quantity(length, "m", 3) for length in self.lengths)


def cell_setting(dx: str, dy: str) -> tuple[str, ...]:
    """Setting of cells of given lengths."""
    return (f"grid.{KEY}=[{dx}, {dy}]",)


def recorded_cells(earlier: Sequence[SweepRun], case: str) -> tuple[str, ...] | None:
    """Setting of the common cells of the runs of a case in a manifest; None without such runs."""
    for run in earlier:
        if run.case == case and f"grid.{KEY}" not in run.changed:
            cell = run.settings.get(f"grid.{KEY}")
            return () if cell is None else (f"grid.{KEY}={cell}",)
    return None


def keeps_own_cells(case: Path, design: Design, settings: Sequence[str]) -> bool:
    """Test whether the runs of a design keep their own cells; CaseError if the first is refused."""
    # They do where the keys concern the grid, or where the grid or its largest cell is given.
    if len(design.rows) == 1 or any(key.partition(".")[0] == "grid" for key in design.keys):
        return True
    automatic = read_case(case, (*settings, *design.settings(0))).automatic_grid
    return automatic is None or automatic.largest_cell is not None


def common_cells(
    case: Path,
    design: Design,
    settings: Sequence[str],
    threads: int = 1,
    memory: float | None = None,
) -> CommonCells:
    """Common cells of the runs of a design, memory in bytes; CommandError if one is refused."""
    available = available_memory() if memory is None else memory
    chosen = [(*settings, *design.settings(row)) for row in extreme_rows(design)]
    runs = [prepare(case, each, threads, memory, roughly=True).run for each in chosen]
    dx, dy = np.min([run.grid.cell_size for run in runs], axis=0).tolist()
    return CommonCells((dx, dy), all(_is_affordable(run, (dx, dy), available) for run in runs))


def _is_affordable(run: Analysis[Any, Any], cell: tuple[float, float], available: float) -> bool:
    """Test whether a run on smaller cells fits into the limit and into some memory [bytes]."""
    before = math.prod(run.grid.shape)
    now = math.prod(size / length for size, length in zip(run.grid.size, cell, strict=True))
    arrays = (run.memory - run_memory.PROGRAM) * now / before
    return now <= max(before, MOST_CELLS) and run_memory.PROGRAM + arrays < available
