"""Still drawings of a page: the geometry, and the curves of the materials."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from viscontact.bodies.indenters import HeightMap, Indenter
from viscontact.bodies.laws import Elastic
from viscontact.bodies.materials.layers import creeping_laws
from viscontact.drawing.content.law_curves import curve_times, time_of_laws
from viscontact.drawing.content.small_panels import law_panels
from viscontact.drawing.matplotlib import draw_indenter
from viscontact.drawing.matplotlib.layout.saving import as_svg
from viscontact.drawing.matplotlib.materials.law_curves import draw_laws
from viscontact.drawing.svg.html import element
from viscontact.drawing.svg.panel_drawing import panel_drawing
from viscontact.drawing.svg.shapes import indenter_drawings
from viscontact.drawing.svg.stack import stack_drawing
from viscontact.report.page_elements import remark, width_of
from viscontact.results.creep_times import law_times
from viscontact.results.recorded_case import case_of, is_layered, recorded_ends, recorded_grid
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.run_axis import run_axis
from viscontact.results.stored_contact import cells_in_contact
from viscontact.units.formatting import format_quantity

#: Bodies by the section of their material.
BODIES = {"material": "Half-space", "indenter_material": "Indenter"}


def geometry(ds: xr.Dataset) -> Element:
    """Drawing of the indenter, with the largest contact shaded."""
    wide = drawn(partial(_indenter, ds), "Sections through the indenter, and its plan")
    return _wide_or_small(wide, partial(_small_sections, ds))


def is_drawn_from_fields(ds: xr.Dataset) -> bool:
    """True if the geometry is drawn from the fields: results do not store measured maps."""
    return is_left_out(case_of(ds).get("indenter"))


def materials(ds: xr.Dataset) -> Iterator[tuple[str, Element]]:
    """Yield the layers and the curves of each creeping body: whose they are, and the drawing."""
    for part, title in BODIES.items():
        if case_of(ds).get(part) is not None or part == "material":
            about = f"Creep compliance and relaxation modulus: {title.lower()}"
            if is_layered(ds, part):
                yield f"{title}: layers", stack_drawing(recorded_object(ds, part, "section"))
            if elastic := _elastic_text(ds, part):
                yield title, element("p", elastic)
                continue
            wide = drawn(partial(_curves, ds, part), about)
            yield title, _wide_or_small(wide, partial(_small_curves, ds, part))


def _elastic_text(ds: xr.Dataset, part: str) -> str:
    """Sentence about a body that is all elastic, whose curves say nothing; empty if it creeps."""
    try:
        laws = creeping_laws(recorded_object(ds, part, "creep"))
    except (ValueError, AttributeError):  # not recorded; the drawing says why
        return ""
    moduli = [
        f"{format_quantity(law.shear_modulus, 'Pa')}{f' ({name})' if name else ''}"
        for name, law in laws.items()
        if isinstance(law, Elastic)
    ]
    together = ", ".join(moduli)
    return f"Elastic, without creep: shear modulus {together}." if len(moduli) == len(laws) else ""


def _indenter(ds: xr.Dataset) -> Figure:
    indenter, x, y = _body(ds), ds["x"].values, ds["y"].values
    # Fields are known at the cells' centres, and not beyond.
    cells = (x.size - 1, y.size - 1) if is_drawn_from_fields(ds) else (x.size, y.size)
    along, across = recorded_grid(ds).cell_size
    size = along * cells[0], across * cells[1]
    length, width = (float(ds[name].max()) for name in ("contact_length", "contact_width"))
    contact = None
    if length > 0 and width > 0:
        middle = _middle(ds)
        contact = (*middle, length, width)
    ends = [end.place for end in recorded_ends(ds)]
    return draw_indenter(indenter, size, contact=contact, shaded="largest contact", ends=ends)


def _body(ds: xr.Dataset) -> Indenter:
    if is_drawn_from_fields(ds):
        return recorded_surface(ds)
    body: Indenter = recorded_object(ds, "indenter", "geometry")
    return body


def _small_sections(ds: xr.Dataset) -> list[Element]:
    return indenter_drawings(_body(ds))


def _small_curves(ds: xr.Dataset, part: str) -> list[Element]:
    laws = creeping_laws(recorded_object(ds, part, "creep"))
    panels = [each for name, law in laws.items() for each in law_panels(law, name)]
    return [*map(panel_drawing, panels)]


def _wide_or_small(wide: Element, small: Callable[[], list[Element]]) -> Element:
    """A drawing, and the smaller ones that take its place on a phone."""
    if wide.tag == "p":  # which says why there is none
        return wide
    drawings = small()
    if not drawings:
        return wide
    wide.set("class", "scroll wide")
    return element("div", wide, element("div", *drawings, class_="narrow"))


def _middle(ds: xr.Dataset) -> tuple[float, float]:
    """Middle of the largest contact of the stored fields [m]; the origin without fields."""
    if "pressure" not in ds:
        return 0.0, 0.0
    over = ds["pressure"].dims[0]
    in_contact = cells_in_contact(ds)
    largest = int(in_contact.sum(["x", "y"]).values.argmax())
    touched = in_contact.isel({over: largest}).transpose("x", "y").values
    if not touched.any():
        return 0.0, 0.0
    x, y = ds["x"].values[touched.any(axis=1)], ds["y"].values[touched.any(axis=0)]
    return float(x[0] + x[-1]) / 2, float(y[0] + y[-1]) / 2


def _curves(ds: xr.Dataset, part: str) -> Figure:
    laws = creeping_laws(recorded_object(ds, part, "creep"))
    instants = law_times(ds, part)
    positive = instants[instants > 0]
    end = float(positive.max(initial=0.0)) or 1.0
    times = curve_times(end, float(positive.min(initial=end)))
    return draw_laws(laws, times, time_of_laws([ds], part))


def drawn(draw: Callable[[], Figure], about: str) -> Element:
    """An image that needs nothing from outside, or why there is none."""
    return framed(draw, about)[0]


def framed(draw: Callable[[], Figure], about: str) -> Element:
    """Figure of a page with an image, which stays narrow in one column, or why there is none."""
    try:
        figure = draw()
    except (ValueError, AttributeError) as error:
        return element("figure", remark(f"Not drawn: {error}."), class_="single")
    width, height = (f"{96 * inches:.0f}" for inches in figure.get_size_inches())
    source = f"data:image/svg+xml;base64,{base64.b64encode(as_svg(figure)).decode('ascii')}"
    image = element("img", src=source, alt=about, width=width, height=height)
    return element("figure", element("div", image, class_="scroll"), **width_of(figure))


def is_left_out(described: Any) -> bool:
    """Test for a described object of which a result keeps a fingerprint only: a large map."""
    return '"sha256"' in json.dumps(described)


def recorded_surface(ds: xr.Dataset) -> HeightMap:
    """Return the indenter on the grid of a run, from the fields that are stored."""
    missing = {"gap", "displacement"} - set(ds.variables)
    if missing or not ds["gap"].size:
        raise ValueError(
            "the surface is measured, results do not store it, and there are no fields to "
            "compute it from; store some (output.fields)"
        )
    # From gap = initial gap + displacement - approach - tilt_x x - tilt_y y (eq. 1), at the last
    # stored instant: the grid is the whole one by then. The level of a map does not matter, so that
    # a line contact, whose approach has no datum, counts from 0.
    over = str(ds["gap"].dims[0])
    last = ds[["gap", "displacement"]].isel({over: -1}).transpose("x", "y")
    axis = run_axis(ds).name
    nearest = int(np.abs(ds[axis].values - float(ds[over][-1])).argmin())
    motion = ds[["approach", "tilt_x", "tilt_y"]].isel({axis: nearest})
    x, y = ds["x"].values, ds["y"].values
    rigid = np.nan_to_num(motion["approach"].item()) + motion["tilt_x"].item() * x[:, None]
    gap = last["gap"].values - last["displacement"].values + rigid + motion["tilt_y"].item() * y
    known = np.where(np.isfinite(gap), gap, np.nan)
    if not np.isfinite(known).any():
        raise ValueError("the surface is a measured one, and no gap of it is stored")
    return HeightMap(x, y, -known, holes=True)
