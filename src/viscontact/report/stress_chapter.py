"""Chapter of a report on the stress below the largest pressure."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.drawing.svg.html import element
from viscontact.report.still_figures import still_figures
from viscontact.results.formatting import format_with_error
from viscontact.results.peak_stress import PeakStress, peak_stress
from viscontact.results.recorded_case import has_ends, is_layered
from viscontact.results.run_axis import run_axis
from viscontact.results.stress_source import at_largest_traction
from viscontact.units.formatting import format_quantity

#: Most cells of a grid below which stresses are computed for a report: some seconds.
MOST_CELLS = 500_000


def stress_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the von Mises stress below the largest pressure; nothing where it cannot be shown."""
    if found := stress_below(ds):
        yield element("p", stress_text(ds, found))
        yield from still_figures(ds, "stress", times=[found.place])


def stress_below(ds: xr.Dataset) -> PeakStress | None:
    """The von Mises stress; None without it, as without contact, fields or a half-space."""
    if is_layered(ds) or ds.sizes.get("x", 0) * ds.sizes.get("y", 0) > MOST_CELLS:
        return None
    try:
        found = peak_stress(ds, "von_mises")
    except ValueError:
        return None
    return found if found.value > 0 else None


def stress_text(ds: xr.Dataset, found: PeakStress) -> str:
    """Describe the stress in a sentence."""
    value = format_with_error(found.value, found.error, "Pa")
    place, depth = run_axis(ds).place(found.place), format_quantity(found.depth, "m", 2)
    plane = f" on the plane along {found.plane}; the drawing is across the contact"
    body = "body, which ends along x," if has_ends(ds) else "half-space"
    pulled = at_largest_traction(ds)
    if "creepage" in pulled.coords:
        place += f" and a creepage of {100 * float(pulled['creepage']):.3g} %"
    return (
        f"On the planes along x and y through the largest pressure of the run, at {place}, "
        f"the largest von Mises stress in the {body} is {value}, {depth} deep"
        f"{plane if found.plane else ''}."
    )
