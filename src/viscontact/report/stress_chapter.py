"""Chapter of a report on the stress below the largest pressure."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.drawing.svg.html import element
from viscontact.report.still_figures import still_figures
from viscontact.results.formatting import format_with_error
from viscontact.results.fretting import is_gripping
from viscontact.results.peak_stress import (
    PeakStress,
    peak_stress,
    row_of_largest_pressure,
)
from viscontact.results.recorded_case import has_ends, is_layered
from viscontact.results.rolling import has_creepages
from viscontact.results.run_axis import run_axis
from viscontact.results.stress_source import at_largest_traction, stress_source
from viscontact.units.formatting import format_quantity

#: Most cells of a grid below which stresses are computed for a report: some seconds.
MOST_CELLS = 500_000


def stress_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the von Mises stress below the largest pressure; nothing where it cannot be shown."""
    if found := stress_below(ds):
        yield element("p", stress_text(ds, found))
        yield from still_figures(ds, "stress", times=[found.place])


def stress_below(ds: xr.Dataset) -> PeakStress | None:
    """The von Mises stress; None without it, as without contact or fields.

    Of layers that creep differently it is not searched for.
    """
    if ds.sizes.get("x", 0) * ds.sizes.get("y", 0) > MOST_CELLS:
        return None
    try:
        found = peak_stress(ds, "von_mises")
    except ValueError:
        return None
    return found if found.value > 0 else None


def stress_text(ds: xr.Dataset, found: PeakStress) -> str:
    """Describe the stress in a sentence."""
    value = format_with_error(found.value, found.error, "Pa")
    place = run_axis(ds).place(found.place)
    deep = f"{format_quantity(found.depth, 'm', 2)} deep" if found.depth else "at the surface"
    # Under friction the drawing of a round contact is along the pull.
    grips = is_gripping(ds) or has_creepages(ds)
    drawn = "" if grips else "; the drawing is across the contact"
    plane = f" on the plane along {found.plane}{drawn}"
    pulled = at_largest_traction(ds)
    if "creepage" in pulled.coords:
        place += f" and a creepage of {100 * float(pulled['creepage']):.3g} %"
    pressed = found.place == run_axis(ds).values(ds)[row_of_largest_pressure(pulled)]
    of_run = f"of the run, at {place}," if pressed else f"at {place}, under the largest pull,"
    return (
        f"On the planes along x and y through the largest pressure {of_run} "
        f"the largest von Mises stress in the {_body(ds)} is {value}, {deep}"
        f"{_in_layer(ds, found)}{plane if found.plane else ''}."
    )


def _body(ds: xr.Dataset) -> str:
    if has_ends(ds):
        return "body, which ends along x,"
    return "body of layers" if is_layered(ds) else "half-space"


def _in_layer(ds: xr.Dataset, found: PeakStress) -> str:
    """Name of the layer of the stress; nothing without layers."""
    if not found.layer:
        return ""
    count = len(stress_source(at_largest_traction(ds)).interfaces)
    return f", in layer {found.layer}" if found.layer <= count else ", in the base"
