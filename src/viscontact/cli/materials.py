"""`material`: the shipped library, and the curves of a law."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def material(
    which: Annotated[
        str | None,
        typer.Argument(
            metavar="[NAME|FILE]",
            help="A shipped material, or a case file; lists the shipped ones if left out.",
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FIG.png", help="Draw it: .png, .pdf or .svg."),
    ] = None,
) -> None:
    """Show creep and relaxation of a law, and where a shipped one is from."""
    from viscontact.cli.material_tables import list_library, show_material

    if which is None:
        list_library(output)
    else:
        show_material(which, output)
