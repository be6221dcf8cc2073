"""`show`, `export`, `report` and `verify`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from viscontact.cli.declared import argument, option
from viscontact.cli.quick_imports import quick_imports
from viscontact.cli.terminal.messages import put

RunDirectory = Annotated[Path, argument(metavar="DIR", help="Run directory, or its .nc file.")]

AtCreepage = Annotated[
    str | None,
    option(
        "--creepage",
        metavar="SHARE",
        help="One of the creepages of steady motion under friction, such as '1 %'.",
    ),
]


def show(
    directory: RunDirectory,
    everything: Annotated[bool, option("--all", help="Print every instant.")] = False,
    errors: Annotated[bool, option("--errors", help="Print the error below each number.")] = False,
    creepage: AtCreepage = None,
) -> None:
    """Print the history of a run as a table."""
    with quick_imports():
        from viscontact.cli.results.history_table import print_history
        from viscontact.cli.results.stored import checked_history

    with checked_history(directory, creepage) as found:
        print_history(found, directory, everything=everything, errors=errors)


def export(
    directory: RunDirectory,
    output: Annotated[
        Path | None,
        option(
            *("-o", "--output"),
            metavar="FILE.csv",
            help="History as .csv or .xlsx, by default CSV on stdout; stored fields as .pvd "
            "(ParaView) or .mat (MATLAB, with the history).",
        ),
    ] = None,
    point: Annotated[
        list[str] | None,
        option(
            "--point",
            metavar="X,Y",
            help="Add the pressure at a point, e.g. '1 mm,0 mm', at the stored instants; repeated.",
        ),
    ] = None,
    creepage: AtCreepage = None,
) -> None:
    """Write a run for other programs, in SI units: the history as CSV or XLSX, or the fields."""
    from viscontact.cli.results.exports import check_export, write_export
    from viscontact.cli.results.stored import checked_result

    check_export(output, point or ())
    with checked_result(directory, creepage) as ds:
        write_export(ds, output, point or ())


def report(
    directory: Annotated[
        Path, argument(metavar="DIR", help="Run directory, its .nc file, or a sweep.")
    ],
    output: Annotated[
        Path | None,
        option(
            *("-o", "--output"),
            metavar="OUT.html",
            help="Page, or a PDF by its suffix; by default report.html in DIR.",
        ),
    ] = None,
    creepage: AtCreepage = None,
) -> None:
    """Write a report on a run, or on all runs of a sweep, as one HTML page or as PDF."""
    from viscontact.cli.results.reports import write_report

    put(write_report(directory, output, creepage))


def verify(
    fast: Annotated[
        bool, option("--fast", help="Coarse meshes only: half a minute instead of minutes.")
    ] = False,
    output: Annotated[
        Path | None,
        option("-o", "--output", metavar="FILE.md", help="Write the table: .md or .csv."),
    ] = None,
) -> None:
    """Compare with exact solutions: case, reference, ours, error, observed order."""
    from viscontact.cli.results.verification_table import print_verification

    print_verification(fast=fast, output=output)
