"""Commands that are promised and not built yet: refused by name."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.messages import refuse


def report(
    directory: Annotated[Path | None, typer.Argument(metavar="DIR", help="A run.")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="HTML file.")] = None,
) -> None:
    """One self-contained page of a run (not built yet)."""
    refuse("report is not built yet; `viscontact show` and `viscontact plot` show a run")
