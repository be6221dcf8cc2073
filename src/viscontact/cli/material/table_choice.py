"""Messages on the part of a file that is read as a table."""

from __future__ import annotations

from pathlib import Path

from viscontact.cli.terminal.messages import say
from viscontact.tables import Table, split_sheet


def say_chosen(file: Path, table: Table) -> None:
    """Say which sheet of several is read, and which columns are left out."""
    sheet = split_sheet(table.source)[1]
    if table.source != file and sheet is not None:
        say(f"{file.name}: the sheet {sheet!r} is read; choose another one as {file.name}#SHEET")
    if table.left_out:
        say(f"{table.source.name}: columns left out: {', '.join(table.left_out)}")
