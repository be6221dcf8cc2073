"""Scalars over time or speed with their error bands: a figure for each."""

from __future__ import annotations

import plotly.graph_objects as go
import xarray as xr

from viscontact.drawing.content.along_run import texts_along
from viscontact.drawing.content.history import history_panel, load_names, response_names
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.plotly.panel_over_run import panel_over_run


def history(
    ds: xr.Dataset, name: str, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> go.Figure:
    """Draw a scalar over time or speed with its error band, and the same of a reference dashed."""
    panel = history_panel({"": ds}, name, look.unit, reference)
    return panel_over_run(panel, look, f"history-{name}", texts_along(ds, name, look))


def histories(
    ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> list[go.Figure]:
    """Draw what is prescribed, and what answers: a figure for each scalar that has a panel."""
    return [history(ds, name, look, reference) for name in (*load_names(ds), *response_names(ds))]
