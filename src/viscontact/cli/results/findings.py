"""Spots, events and verdicts of a result, printed below its table."""

from __future__ import annotations

import xarray as xr

from viscontact.cli.results.traction_table import traction_tables
from viscontact.cli.terminal.console import TextConsole, styled
from viscontact.cli.terminal.messages import put
from viscontact.results.contact_spots import last_spots
from viscontact.results.leakage.of_case import leakage_lines
from viscontact.results.recorded_events import recorded_events
from viscontact.results.rolling import has_creepages
from viscontact.results.verdicts import compared, verdicts

_COLOURS = {"passed": "green", "failed": "red", "undecided": "yellow"}


def print_findings(console: TextConsole, ds: xr.Dataset) -> None:
    """Print spots, tractions over creepage, events, and verdicts on allowable values if any."""
    if spots := last_spots(ds):
        put(spots.text)
    if has_creepages(ds):
        for table in traction_tables(ds):
            console.print(table, crop=False)
    for line in leakage_lines(ds):
        put(line)
    for event in recorded_events(ds):
        put(f"event at {event.text}")
    for each in verdicts(ds):
        verdict = styled(each.verdict, _COLOURS[each.verdict])
        console.print(verdict, compared(ds, each), sep=": ", highlight=False)
