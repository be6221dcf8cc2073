"""Interactive figures of a run, for the page."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import xarray as xr
from plotly.graph_objects import Figure

from viscontact.drawing.content.along_run import along_run
from viscontact.drawing.content.friction import has_friction
from viscontact.drawing.content.look import DARK, LIGHT, Look
from viscontact.drawing.content.map import maps_if_any
from viscontact.drawing.plotly.friction import friction
from viscontact.drawing.plotly.histories import LINEAR, LOGARITHMIC, history, panel_names
from viscontact.drawing.plotly.loops import loops
from viscontact.drawing.plotly.parts import plain
from viscontact.drawing.plotly.pressure_map import map_remarks, pressure_map
from viscontact.drawing.plotly.sections import sections
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
    maps, others = maps_if_any(ds), None if other is None else maps_if_any(other)
    surface: list[Figure] = []
    if maps is not None:
        surface = [pressure_map(maps, look, others), *sections(ds, maps, look, others)]
    return {
        "surface": list(map(plain, surface)),
        "start": 0 if maps is None else maps.start,
        "remarks": "" if maps is None else map_remarks(maps.beside(others)),
        "friction": plain(friction(ds, look, other)) if _has_curve(ds) else None,
        "histories": [plain(each) for each in _histories(ds, look, other)],
        "scale": _scale(ds, look, other),
        "loops": [plain(each) for each in loops(ds, look, other)],
    }


def _has_curve(ds: xr.Dataset) -> bool:
    """Tell whether a result has a curve of friction over speed."""
    return has_friction(ds) and ds.sizes["speed"] > 1


def _histories(ds: xr.Dataset, look: Look, reference: xr.Dataset | None) -> list[Figure]:
    """Histories without what has a figure of its own; none over a single speed."""
    if not run_axis(ds).is_history and ds.sizes["speed"] < 2:
        return []
    load, response = panel_names(ds)
    left_out = "friction_coefficient" if _has_curve(ds) else ""
    names = [name for name in (*load, *response) if name != left_out]
    return [history(ds, name, look, reference) for name in names]


def _scale(ds: xr.Dataset, look: Look, reference: xr.Dataset | None) -> str | None:
    """Frame of the histories that is shown first; None if they have no other."""
    axis = along_run([ds] if reference is None else [ds, reference], look.unit)
    if not axis.has_choice:
        return None
    return LINEAR if axis.scale == "linear" else LOGARITHMIC
