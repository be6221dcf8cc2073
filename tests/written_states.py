"""States made of known numbers, written to a file and looked for there: nothing is solved."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscontact import Grid
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.results.variables import FIELDS, LINES, scalars_of
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.result_writer import ResultWriter

GRID = Grid((6, 5), (2e-3, 1e-3))
TIMES = np.arange(12) / 7.0
SOME = [0.0, float(TIMES[4]), float(TIMES[5]), float(TIMES[11])]
GIVEN = {"title": "µ", "tolerance": 1e-6}
NAMES = tuple(scalars_of())
NUMBERS = [name for name in NAMES if name not in ("outcome", "iterations", "cells_across")]


def state(row: int, grid: Grid = GRID, times: NDArray[np.float64] = TIMES) -> ContactState:
    """The state of a row: reproducible numbers with all their bits, NaN and warnings among them."""
    random = np.random.default_rng(row)
    fields: dict[str, Any] = {name: random.standard_normal(grid.shape) for name in FIELDS}
    fields["in_contact"] = fields["pressure"] > 0
    fields["gap"][0, 0] = np.inf
    fields |= {name: random.standard_normal(grid.shape[0]) for name in LINES}
    scalars = {name: float(value) for name, value in zip(NUMBERS, random.random(99), strict=False)}
    if row % 3 == 0:
        scalars |= {"eccentricity_x": np.nan, "loss_per_cycle": np.nan}
    return ContactState(
        time=float(times[row]),
        **fields,
        grid=grid,
        **scalars,
        iterations=int(random.integers(99)),
        cells_across=row,
        outcome=Outcome(row % 2),
        warnings=(f"warning {row}: 5 µm", "another") if row % 4 == 1 else (),
    )


def faults_of(
    path: Path, at_least: int, some: list[float] | None, times: NDArray[np.float64] = TIMES
) -> list[str]:
    """Compare every bit of a file with the rows it should hold; return what differs.

    Asked for with `some`, fields are those of these instants only; else those of all.
    """
    with netCDF4.Dataset(str(path)) as file:
        file.set_auto_maskandscale(False)
        rows = len(file.dimensions["time"])
        states = [state(row, times=times) for row in range(rows)]
        kept = [each for each in states if some is None or each.time in some]
        truth = {name: [getattr(each, name) for each in states] for name in ("time", *NAMES)}
        if some != []:
            truth |= {name: [getattr(each, name) for each in kept] for name in (*FIELDS, *LINES)}
        if some:
            truth["field_time"] = [each.time for each in kept]
        faults = [f"{rows} rows"] if rows < at_least else []
        for name, expected in truth.items():
            found = file.variables[name][:]
            if found.tobytes() != np.array(expected, found.dtype).tobytes():
                faults.append(name)
        said = "\n".join(text for each in states for text in each.warnings)
        return faults + (["warnings"] if file.getncattr("warnings") != said else [])


def begun(path: Path, fields: Any = SOME) -> ResultWriter:
    """A writer of a new result."""
    return ResultWriter(path, Contents(GRID, TIMES, KeptFields(fields), GIVEN))


def resumed(path: Path, position: dict[str, Any], fields: Any = SOME) -> ResultWriter:
    """A writer that goes on."""
    return ResultWriter.resume(path, Contents(GRID, TIMES, KeptFields(fields), GIVEN), position)


def write(writer: ResultWriter, end: int = len(TIMES)) -> None:
    """Append and publish rows up to one."""
    for row in range(writer.position["rows"], end):
        writer.append(state(row))
        assert writer.publish()


def names(path: Path) -> list[str]:
    """What lies in a file's directory."""
    return sorted(each.name for each in path.parent.iterdir())
