"""Pressure that is given, and the displacement under it, along a line of the surface."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.drawing.content.panel import Axis, Curve, Ink, Panel
from viscontact.results.shown_rows import shown_rows
from viscontact.units.formatting import format_quantity, readable_unit, time_labels
from viscontact.units.numbers import finite_array

#: Instants that are shown by default.
_MOST = 5


def pressure_panels(
    results: xr.Dataset, times: ArrayLike | None, along: str, figure: str
) -> tuple[Panel, Panel]:
    """Panels of pressure and displacement through the largest pressure, at some instants."""
    if along not in ("x", "y"):
        raise ValueError(f"{figure}: along must be 'x' or 'y', got {along!r}")
    missing = [name for name in ("pressure", "displacement") if name not in results]
    if missing or "time" not in results["pressure"].dims:
        raise ValueError(
            f"{figure}: needs pressure and displacement over time; give a result of "
            "vc.under_pressure"
        )
    stored = results["time"].values
    chosen = shown_rows(stored.size, _MOST)
    if times is not None:
        wanted = finite_array(f"{figure}: times", times, "s").ravel()
        chosen = np.unique([int(np.abs(stored - each).argmin()) for each in wanted])
    across = "x" if along == "y" else "y"
    largest = np.unravel_index(
        int(np.abs(results["pressure"].values[chosen]).argmax()),
        (chosen.size, *results["pressure"].shape[1:]),
    )
    at = int(largest[1 if across == "x" else 2])
    line = results.isel({across: at})
    inks = [Ink("ordered", place) for place in np.linspace(0.0, 1.0, chosen.size).tolist()]
    labels = time_labels(stored[chosen].tolist(), "s")
    places = line[along].values
    found = []
    for name, quantity, si in (
        ("pressure", "Pressure", "Pa"),
        ("displacement", "Displacement", "m"),
    ):
        values = line[name].values[chosen]
        curves = tuple(
            Curve(places, each, label, ink)
            for each, label, ink in zip(values, labels, inks, strict=True)
        )
        unit = readable_unit(si, values)
        y = Axis(quantity, unit, is_reversed=name == "displacement")
        where = f"at {across} = {format_quantity(float(line[across]), 'm', 3)}"
        title = where if name == "pressure" else ""
        x = Axis(along, readable_unit("m", places))
        found.append(Panel(x, y, curves, title=title, name=name))
    return found[0], found[1]
