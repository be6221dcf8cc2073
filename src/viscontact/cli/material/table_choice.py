"""Messages on the part of a file that is read as a table, in the words of the command line."""

from __future__ import annotations

import re
from pathlib import Path

from viscontact.cli.terminal.messages import say
from viscontact.tables import Table, split_sheet, with_typed_meanings


def say_chosen(file: Path, table: Table) -> None:
    """Say which sheet of several is read, and which columns are left out."""
    sheet = split_sheet(table.source)[1]
    if table.source != file and sheet is not None:
        say(f"{file.name}: the sheet {sheet!r} is read; choose another one as {file.name}#SHEET")
    if table.left_out:
        say(f"{table.source.name}: columns left out: {', '.join(table.left_out)}")


def as_option(why: str) -> str:
    """Return a message of the reader of tables in the words of the command line."""
    why = with_typed_meanings(why, "--columns")
    why = re.sub(r"^columns: ", "--columns: ", why)
    why = re.sub(r"leave the stress out$", "leave --stress out", why)
    return why.replace("with columns=", "with --columns").replace(
        "can be given in columns", "can be given by --columns 'time [s], ...'"
    )
