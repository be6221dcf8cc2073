"""`show` and `export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

RunDirectory = Annotated[
    Path, typer.Argument(metavar="DIR", help="A run's directory, or its .nc file.")
]


def show(
    directory: RunDirectory,
    everything: Annotated[
        bool, typer.Option("--all", help="Every instant, not only as many as fit.")
    ] = False,
    errors: Annotated[
        bool, typer.Option("--errors", help="The error of every number below it.")
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
        typer.Option("-o", "--output", metavar="FILE.csv", help="Where to; stdout if left out."),
    ] = None,
) -> None:
    """Write the history of a run as CSV, in SI units."""
    from viscontact.cli.results.history_table import write_csv
    from viscontact.cli.results.stored import opened
    from viscontact.cli.terminal.messages import refuse

    if output is not None and output.suffix == ".nc":
        refuse(f"{output}: is where a result belongs; name a CSV file, e.g. -o history.csv")
    with opened(directory) as ds:
        write_csv(ds, output)
