"""Chapter of a report on friction: sliding, heat of a cycle, slip and wear."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import facts
from viscontact.report.still_figures import still_figures
from viscontact.results.formatting import format_scalar, format_with_error
from viscontact.results.fretting import (
    archard_wear,
    fretting_cycles,
    is_gripping,
    sliding_begins,
    slip_over_time,
)
from viscontact.units.formatting import format_quantity

_NAME = "report"


def slip_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield facts and figures of friction; nothing of a run without it."""
    if not is_gripping(ds):
        return
    yield element("p", sliding_text(ds))
    yield facts(slip_facts(ds))
    yield from still_figures(ds, "slip", beside_interactive=True)


def sliding_text(ds: xr.Dataset) -> str:
    """State in a sentence whether the whole contact slides."""
    begins = sliding_begins(ds)
    if begins is not None:
        return f"The whole contact slides, first at t = {format_quantity(begins, 's')}."
    most = int(np.nan_to_num(ds["slip_fraction"].values).argmax())
    if not ds["slip_fraction"].values[most] > 0:
        return "No cell of the contact slips at any instant."
    when = format_quantity(float(ds["time"][most]), "s")
    part = format_scalar(ds, "slip_fraction", most)
    return f"The contact never slides as a whole: at most {part} of it slips, at t = {when}."


def slip_facts(ds: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Yield heat of friction and of the last cycle, largest slip and wear."""
    yield "Heat of friction", format_scalar(ds, "friction_heat", -1)
    if cycles := fretting_cycles(ds, _NAME):
        heat = format_with_error(cycles[-1].heat, cycles[-1].error, "J")
        yield f"Heat of cycle {len(cycles)}, the last", heat
    slip = slip_over_time(ds)
    if slip is not None and slip.largest.size:
        at = int(slip.largest.argmax())
        when = format_quantity(float(slip.times[at]), "s")
        value = format_quantity(float(slip.largest[at]), "m", 3)
        yield "Largest slip of a cell", f"{value} at t = {when}"
    wear = archard_wear(ds, _NAME)
    if wear is not None:
        yield "Worn volume (Archard)", format_quantity(wear.volume, "m3", 3)
        if wear.depth is not None:
            yield "Worn depth, at most", format_quantity(wear.depth, "m", 3)
