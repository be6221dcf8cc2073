"""Interactive figures of a run, by the chapters of the table of figures."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, get_args

import plotly.graph_objects as go
import xarray as xr

from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.map import Maps
from viscontact.drawing.content.usefulness import is_of_use
from viscontact.drawing.figures import TABLE, Chapter
from viscontact.drawing.plotly.friction import friction
from viscontact.drawing.plotly.loops import loops
from viscontact.drawing.plotly.panel_over_run import histories
from viscontact.drawing.plotly.pressure_map import outlines, pressure_map
from viscontact.drawing.plotly.sections import line_loads, sections
from viscontact.drawing.plotly.traction_creepage import traction_creepage

#: Functions that the table names. Those of fields take maps, which may have a reference, and a
#: look, the others a result, a look and a reference.
INTERACTIVE: dict[str, Callable[..., Any]] = {
    each.__name__: each
    for each in (
        *(friction, histories, line_loads, loops, outlines, pressure_map, sections),
        traction_creepage,
    )
}


def run_figures(
    ds: xr.Dataset, maps: Maps | None, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> dict[Chapter, list[go.Figure]]:
    """Figures of a result in order and of its maps, if any, from top to bottom in each chapter."""
    found: dict[Chapter, list[go.Figure]] = {chapter: [] for chapter in get_args(Chapter)}
    for entry in TABLE:
        if not entry.reported or not entry.reported.interactive or not is_of_use(entry, ds):
            continue
        into, draw = found[entry.reported.chapter], INTERACTIVE[entry.reported.interactive]
        if not entry.at_instants:
            into += draw(ds, look, reference)
        elif maps is not None:
            drawn = draw(maps, look)
            into += [drawn] if isinstance(drawn, go.Figure) else drawn
    return found
