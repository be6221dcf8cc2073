"""`show`, `export`, `report` and `verify`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.terminal.messages import refuse

RunDirectory = Annotated[
    Path, typer.Argument(metavar="DIR", help="Run directory, or its .nc file.")
]


def show(
    directory: RunDirectory,
    everything: Annotated[bool, typer.Option("--all", help="Print every instant.")] = False,
    errors: Annotated[
        bool, typer.Option("--errors", help="Print the error below each number.")
    ] = False,
) -> None:
    """Print the history of a run as a table."""
    from viscontact.cli.results.history_table import print_history
    from viscontact.cli.results.stored import opened

    with opened(directory) as ds:
        print_history(ds, everything=everything, errors=errors)


def export(
    directory: RunDirectory,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE.csv", help="CSV file; stdout by default."),
    ] = None,
) -> None:
    """Write the history of a run as CSV, in SI units."""
    from viscontact.cli.results.history_table import write_csv
    from viscontact.cli.results.stored import opened

    if output is not None and output.suffix == ".nc":
        refuse(f"{output}: is the name of a result file; name a CSV file, e.g. -o history.csv")
    with opened(directory) as ds:
        write_csv(ds, output)


def report(
    directory: RunDirectory,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="OUT.html", help="Page; by default report.html in DIR."
        ),
    ] = None,
) -> None:
    """Write a report on a run as one HTML page."""
    from viscontact.cli.results.page import write_page

    print(write_page(directory, output))


def verify(
    fast: Annotated[
        bool, typer.Option("--fast", help="Coarse meshes only: half a minute instead of minutes.")
    ] = False,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE.md", help="Write the table: .md or .csv."),
    ] = None,
) -> None:
    """Compare with exact solutions: case, reference, ours, error, observed order."""
    from viscontact.cli.results.verification_table import print_verification

    print_verification(fast=fast, output=output)
