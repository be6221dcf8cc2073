"""`report`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.commands.showing import RunDirectory


def report(
    directory: RunDirectory,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="OUT.html", help="Where to; report.html in DIR if left out."
        ),
    ] = None,
) -> None:
    """Write a run as one page of HTML, to look at and to send."""
    from viscontact.cli.results.page import write_page

    print(write_page(directory, output))
