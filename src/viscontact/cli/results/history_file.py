"""History of a run as CSV or as a workbook."""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from pathlib import Path

import xarray as xr

from viscontact.cli.terminal.messages import refuse
from viscontact.results.damage import DamagedFileError
from viscontact.results.history_csv import write_history
from viscontact.tables.workbook import write_csv_or_workbook
from viscontact.units.parsing import parse_quantity


def write_table(ds: xr.Dataset, output: Path | None, points: Sequence[str] = ()) -> None:
    """Write all scalars [SI] as CSV or, for ``.xlsx``, as a workbook, and pressure at points."""
    written = io.StringIO()
    try:
        write_history(ds, written, [_point(text) for text in points])
    except DamagedFileError:
        raise
    except ValueError as error:
        refuse(f"--point: {error}")
    if output is None:
        sys.stdout.write(written.getvalue())
        return
    try:
        with output.open("wb") as file:
            write_csv_or_workbook(file, written.getvalue(), output)
    except (OSError, ValueError) as error:
        refuse(f"{output}: cannot be written: {error}")


def _point(text: str) -> tuple[float, float]:
    """Read a point, ``X,Y`` with units; ValueError names the fault."""
    parts = text.split(",")
    if len(parts) != 2:
        raise ValueError(f"write X,Y with units, as '1 mm,0 mm', got {text!r}")
    x, y = (parse_quantity(part, "length") for part in parts)
    return x, y
