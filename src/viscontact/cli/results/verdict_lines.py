"""Verdicts of a result on its allowable values, as lines of a table."""

from __future__ import annotations

from collections.abc import Iterator

import xarray as xr
from rich.markup import escape

from viscontact.results.run_axis import run_axis
from viscontact.results.verdicts import Verdict, verdicts

_COLOURS = {"passed": "green", "failed": "red", "undecided": "yellow"}


def verdict_lines(ds: xr.Dataset) -> Iterator[str]:
    """Yield a line for each allowable value, with markup; nothing without any."""
    for each in verdicts(ds):
        yield f"[{_COLOURS[each.verdict]}]{each.verdict}[/]: {escape(_comparison(ds, each))}"


def _comparison(ds: xr.Dataset, each: Verdict) -> str:
    name = each.label[:1].lower() + each.label[1:]
    found = f" {each.found} at {run_axis(ds).place(each.at)}" if each.found else ""
    reason = f"; {each.reason}" if each.reason else ""
    margin = f", margin {each.shown_margin}" if each.shown_margin else ""
    return f"{name}{found}, allowable {each.allowed}{margin}{reason}"
