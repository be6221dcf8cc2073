"""Chapter of a report on the spots of a rough contact."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.drawing.matplotlib import contact_spots
from viscontact.drawing.svg.html import element
from viscontact.report.drawings import drawn
from viscontact.results.contact_spots import last_spots


def spots_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield number and sizes of the contact spots; nothing for a contact of one spot."""
    if found := last_spots(ds):
        yield element("p", f"{found.text[0].upper()}{found.text[1:]}.")
        yield element("figure", drawn(partial(contact_spots, ds), "Contact spots"), class_="single")
