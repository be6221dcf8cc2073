"""Findings of a stored result, for which xarray is imported only if there are any."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from viscontact.mechanics.state import LEAKAGE
from viscontact.results.single_spot import ends_in_one_spot
from viscontact.results.stored_result import StoredResult
from viscontact.results.variables import ALLOWABLE

if TYPE_CHECKING:
    from viscontact.cli.terminal.console import TextConsole
    from viscontact.results.stored_result import Result


def print_stored_findings(console: TextConsole, ds: Result, directory: Path) -> None:
    """Print what `print_findings` prints of the result in a directory, which is open."""
    if not isinstance(ds, StoredResult):
        from viscontact.cli.results.findings import print_findings

        print_findings(console, ds)
        return
    stated = (ALLOWABLE, "events", LEAKAGE)
    plain = not any(name in ds.attrs for name in stated) and "creepage" not in ds.sizes
    if plain and ends_in_one_spot(ds):
        return
    from viscontact.cli.results.findings import print_findings
    from viscontact.results.netcdf import open_results

    with open_results(directory) as found:
        print_findings(console, found)
