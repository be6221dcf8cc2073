"""`verify`: our results beside exact ones."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


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
