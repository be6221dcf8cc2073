"""Pressure at the ends of a run and contact area, as the small drawings of a result show them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr

from viscontact.drawing.content.history import history_panel
from viscontact.drawing.content.panel import SECOND, Axis, Curve, Panel
from viscontact.results.run_axis import run_axis
from viscontact.results.stored_contact import cells_in_contact

#: Up to this ratio of its extents along y and x a contact counts as round.
ROUND = 1.05


def area_panel(ds: xr.Dataset) -> Panel | None:
    """Panel of the contact area over time or speed; None where it is not known or always zero."""
    area = ds["contact_area"].values
    if area.size < 2 or not np.isfinite(area).all() or area.max() <= 0:
        return None
    panel, over = history_panel({"": ds}, "contact_area"), run_axis(ds)
    x = replace(panel.x, in_clock_units=over.is_history)
    return replace(panel, x=x, y=replace(panel.y, quantity="Area"), title="contact area", note="")


def end_panel(ds: xr.Dataset) -> Panel | None:
    """Panel of the pressure along the longer extent of the contact, at both ends of the run.

    The ends are the first and the last stored row; None without fields, or without contact.
    """
    if "pressure" not in ds:
        return None
    over = str(ds["pressure"].dims[0])
    ends = [ds["pressure"].isel({over: k}).transpose("x", "y").values for k in (0, -1)]
    masks = [cells_in_contact(ds, k).transpose("x", "y").values for k in (0, -1)]
    touched = [k for k in (0, 1) if masks[k].any()]
    if not touched:
        return None
    at_last = masks[touched[-1]]
    extents = [np.ptp(ds[axis].values[at_last.any(axis=1 - k)]) for k, axis in enumerate("xy")]
    axis = int(extents[1] > ROUND * extents[0])
    along, position = "xy"[axis], ds["xy"[axis]].values
    places = [ends[k].sum(axis=axis).argmax() for k in touched]
    lines, inside = (
        [fields[k].take(place, axis=1 - axis) for k, place in zip(touched, places, strict=True)]
        for fields in (ends, masks)
    )
    half = 1.15 * max(float(np.abs(position[mask]).max(initial=0.0)) for mask in inside)
    half = min(max(half, float(position[-1]) / 50), float(position[-1]))
    curves, note = [Curve(position, lines[-1])], ""
    if len(lines) > 1 and ds.sizes[over] > 1:
        curves.insert(0, Curve(position, lines[0], ink=SECOND, look="dashed"))
        note = f"dashed: {run_axis(ds).place(ds[over].values[0])}"
    return Panel(
        Axis.between(along, "m", -half, half),
        Axis.between("Pressure", "Pa", 0.0, 1.1 * max(float(line.max()) for line in lines)),
        tuple(curves),
        title=f"along {along}",
        note=note,
    )
