"""Collection of the results of a sweep in one file."""

from __future__ import annotations

import io
from collections import Counter
from pathlib import Path

from viscontact.cli.terminal.messages import put, refuse, stop
from viscontact.cli.terminal.progress import counted
from viscontact.runs.directory.atomic_files import replacing
from viscontact.studies.sweep.collecting import write_joint_result
from viscontact.studies.sweep.joint_layout import JointLayout, joint_layout
from viscontact.studies.sweep.run_table import write_run_table
from viscontact.studies.sweep.states import State
from viscontact.tables.workbook import WORKBOOK, write_csv_or_workbook

#: Suffixes of the formats.
SUFFIXES = (".nc", ".csv", WORKBOOK)


def collect_results(directory: Path, output: Path, *, fields: bool, quiet: bool) -> None:
    """Write the joint result of a sweep; exit code 1 if a run has no result."""
    if output.suffix not in SUFFIXES:
        refuse(f"{output}: name a netCDF, CSV or XLSX file, e.g. -o {output.stem or 'sweep'}.nc")
    if not output.absolute().parent.is_dir():
        refuse(f"{output}: there is no directory {output.parent}")
    if fields and output.suffix != ".nc":
        refuse("--fields: a table has no fields; name a netCDF file, e.g. -o sweep.nc")
    layout = _layout(directory, quiet=quiet)
    if fields and layout.fields is None:
        refuse(f"--fields: {_why_no_fields(layout)}")
    try:
        _write(layout, output, fields=fields, quiet=quiet)
    except (OSError, ValueError) as error:
        refuse(f"{output}: cannot be written: {error}")
    put(output)
    _report_missing(layout)


def _layout(directory: Path, *, quiet: bool) -> JointLayout:
    try:
        with counted("run", quiet=quiet) as progress:
            return joint_layout(directory, progress)
    except (FileNotFoundError, NotADirectoryError):
        refuse(f"{directory}: no sweep there; `viscontact run ... --vary ... -o {directory}`")
    except (OSError, ValueError) as error:
        refuse(str(error))


def _write(layout: JointLayout, output: Path, *, fields: bool, quiet: bool) -> None:
    with counted("run", quiet=quiet) as progress:
        if output.suffix == ".nc":
            write_joint_result(layout, output, progress, fields=fields)
            return
        text = io.StringIO()
        write_run_table(layout, text, progress)
        with replacing(output) as file:
            write_csv_or_workbook(file, text.getvalue(), output)


def _why_no_fields(layout: JointLayout) -> str:
    if layout.has_fields:
        return "the runs store fields on different grids or at different instants"
    return "no run has fields; see output.fields of the case"


def _report_missing(layout: JointLayout) -> None:
    """End with exit code 1, and the number of runs in each state, if a run has no result."""
    counts = Counter(each.state.value for each in layout.states)
    del counts[State.DONE.value]
    if counts:
        others = ", ".join(f"{count} {state}" for state, count in counts.items())
        stop(
            f"{counts.total()} of {len(layout.runs)} runs have no result: {others}; "
            f"`viscontact status {layout.directory}` lists them"
        )
