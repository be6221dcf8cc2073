"""Interactive figures of a run, for the page."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import xarray as xr

from viscontact.drawing.content.along_run import along_run
from viscontact.drawing.content.look import DARK, LIGHT, Look
from viscontact.drawing.content.map import maps_if_any
from viscontact.drawing.plotly.panel_over_run import LINEAR, LOGARITHMIC
from viscontact.drawing.plotly.parts import plain
from viscontact.drawing.plotly.pressure_map import map_remarks
from viscontact.drawing.plotly.run_figures import run_figures as interactive_figures
from viscontact.results.run_axis import in_order, run_axis
from viscontact.units.systems import SYSTEMS
from viscontact.web.workspace.problems import RequestError


def look_of(units: str, *, dark: bool) -> Look:
    """Colours and units of a page; RequestError for a system that is not known."""
    if units not in SYSTEMS:
        raise RequestError(422, f"units: wanted one of {', '.join(SYSTEMS)}; got {units[:40]!r}")
    return replace(DARK if dark else LIGHT, system=units)


def run_figures(ds: xr.Dataset, look: Look, reference: xr.Dataset | None = None) -> dict[str, Any]:
    """Figures of a run beside those of a reference, for JSON, with what is shown first."""
    ds = in_order(ds)
    other = None if reference is None else in_order(reference)
    if other is not None and run_axis(other) is not run_axis(ds):
        other = None
    others = None if other is None else maps_if_any(other)
    maps = maps_if_any(ds)
    maps = None if maps is None else maps.beside(others)
    figures = interactive_figures(ds, maps, look, other)
    drawn = {chapter: [plain(each) for each in found] for chapter, found in figures.items()}
    return {
        **{"surface": drawn["pressure"], "start": 0 if maps is None else maps.start},
        "remarks": "" if maps is None else map_remarks(maps),
        **{chapter: drawn[chapter] for chapter in ("friction", "histories", "loops")},
        "scale": _scale(ds, look, other),
    }


def _scale(ds: xr.Dataset, look: Look, reference: xr.Dataset | None) -> str | None:
    """Frame of the histories that is shown first; None if they have no other."""
    axis = along_run([ds] if reference is None else [ds, reference], look.unit)
    if not axis.has_choice:
        return None
    return LINEAR if axis.scale == "linear" else LOGARITHMIC
