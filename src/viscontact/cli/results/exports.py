"""`export`: a run as files of other programs."""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from pathlib import Path

import xarray as xr

from viscontact.cli.terminal.messages import refuse
from viscontact.results.damage import DamagedFileError
from viscontact.results.field_files import write_matlab, write_paraview
from viscontact.results.history_csv import write_history
from viscontact.tables.workbook import write_csv_or_workbook
from viscontact.units.parsing import parse_quantity

#: Endings of files with the history, and writers of files with the fields.
TABLES = (".csv", ".xlsx")
FIELD_WRITERS = {".pvd": write_paraview, ".mat": write_matlab}


def check_export(output: Path | None, points: Sequence[str]) -> None:
    """Refuse a file whose ending names no format, and points where no table is written."""
    if output is None or output.suffix.lower() in TABLES:
        return
    if output.suffix.lower() not in FIELD_WRITERS:
        refuse(
            f"{output}: name a CSV or an XLSX file for the history, a PVD file for ParaView, or a "
            "MAT file for MATLAB, e.g. -o history.csv or -o fields.pvd; result.nc in the directory "
            "of the run is a netCDF file, which many programs read"
        )
    if points:
        refuse(f"{output}: --point adds columns to a table, e.g. -o history.csv; leave it out")


def write_export(ds: xr.Dataset, output: Path | None, points: Sequence[str] = ()) -> None:
    """Write a run to a file of the kind that its ending names; without one as CSV on stdout."""
    try:
        if output is None:
            sys.stdout.write(_table(ds, points))
        elif output.suffix.lower() in FIELD_WRITERS:
            FIELD_WRITERS[output.suffix.lower()](ds, output)
        else:
            table = _table(ds, points)
            with output.open("wb") as file:
                write_csv_or_workbook(file, table, output)
    except DamagedFileError:
        raise
    except (OSError, ValueError) as error:
        refuse(f"{output}: cannot be written: {error}")


def _table(ds: xr.Dataset, points: Sequence[str]) -> str:
    """All scalars [SI], and pressure at points, as CSV."""
    written = io.StringIO()
    try:
        write_history(ds, written, [_point(text) for text in points])
    except DamagedFileError:
        raise
    except ValueError as error:
        refuse(f"--point: {error}")
    return written.getvalue()


def _point(text: str) -> tuple[float, float]:
    """Read a point, ``X,Y`` with units; ValueError names the fault."""
    parts = text.split(",")
    if len(parts) != 2:
        raise ValueError(f"write X,Y with units, as '1 mm,0 mm', got {text!r}")
    x, y = (parse_quantity(part, "length") for part in parts)
    return x, y
