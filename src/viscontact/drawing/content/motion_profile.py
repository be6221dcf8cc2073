"""Pressure along the motion of a body at several speeds, with leading and trailing edge."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats, Integers
from viscontact.drawing.content.panel import Axis, Curve, Ink, Mark, Panel
from viscontact.results.recorded_motion import contact_edges
from viscontact.results.run_axis import run_axis
from viscontact.results.stored_contact import cells_in_contact
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array

#: Most speeds that are drawn by default, and digits of a speed.
_MOST, _DIGITS = 5, 3


def motion_panel(results: xr.Dataset, speeds: ArrayLike | None, at: float) -> Panel:
    """Panel of the pressure on a line along the motion, which is to the right [m]."""
    if "speed" not in results.dims or "pressure" not in results:
        raise ValueError(
            "motion_profile: the figure needs a result of steady motion with fields, from steady()"
        )
    run_axis(results)  # refuses several pressures at each speed
    along = str(results.attrs["along"])
    line = {"y" if along == "x" else "x": at}
    fields = (results["pressure"], cells_in_contact(results))
    dimension = str(results["pressure"].dims[0])
    stored, touched = (each.sel(line, method="nearest").sortby(dimension) for each in fields)
    places, known = stored[along].values, stored[dimension].values
    chosen = _drawn_speeds(known, speeds)
    curves = []
    for number, place in zip(chosen, np.linspace(0.0, 1.0, chosen.size).tolist(), strict=True):
        ink, name = Ink("ordered", place), format_quantity(float(known[number]), "m/s", _DIGITS)
        curves.append(Curve(places, stored.values[number], name, ink))
        edges = contact_edges(places, touched.values[number], 1.0)
        if edges is not None:
            leading, trailing = (np.array([edge]) for edge in edges)
            curves.append(Curve(trailing, np.zeros(1), ink=ink, look="trailing", is_on_top=True))
            curves.append(Curve(leading, np.zeros(1), ink=ink, look="leading", is_on_top=True))
    return Panel(
        Axis.of(f"{along} from the axis, along the motion", "m", places),
        Axis.of("Pressure", "Pa", stored.values[chosen]),
        tuple(curves),
        marks=(Mark(0.0),),
    )


def _drawn_speeds(stored: Floats, speeds: ArrayLike | None) -> Integers:
    """Positions of the speeds to draw among the stored ones, ascending."""
    if speeds is None:
        count = min(_MOST, len(stored))
        return np.unique(np.rint(np.linspace(0, len(stored) - 1, count)).astype(int))
    wanted = np.atleast_1d(real_array("motion profile: speeds", speeds, "m/s"))
    return np.unique(np.abs(np.log(stored / wanted[:, None])).argmin(axis=1))
