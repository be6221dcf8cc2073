"""Overviews of objects: of a part of a case, or of a whole one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any
from xml.etree.ElementTree import Element

from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.laws import Law
from viscontact.bodies.loads import LoadHistory, TemperatureHistory
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.cards import Card as MaterialCard
from viscontact.bodies.materials.layers import Layered, creeping_laws
from viscontact.bodies.materials.material import Material
from viscontact.bodies.series_fits import Fit
from viscontact.bodies.surfaces import Surface
from viscontact.drawing.content.load_course import whole_load_panel
from viscontact.drawing.content.small_panels import law_panels
from viscontact.drawing.content.temperature_course import temperature_panel
from viscontact.drawing.svg.measurements import (
    curve_fits_overview,
    fit_overview,
    indentation_fit_overview,
    isotherm_overview,
    master_curve_overview,
    record_overview,
)
from viscontact.drawing.svg.overview import Overview, as_html, as_text
from viscontact.drawing.svg.panel_drawing import panel_drawing
from viscontact.drawing.svg.result_overview import result_overview
from viscontact.drawing.svg.shapes import indenter_drawings
from viscontact.drawing.svg.stack import stack_drawing
from viscontact.drawing.svg.surface_map import surface_overview
from viscontact.identification import (
    CurveFits,
    IndentationFit,
    IndentationRecord,
    Isotherm,
    MasterCurve,
)
from viscontact.results.accessor import ResultAccessor
from viscontact.results.argument_table import argument_rows, in_plain_words
from viscontact.results.descriptions import describe
from viscontact.units.display import Displayable, DisplayableGroup
from viscontact.units.formatting import format_quantity


def display_html(obj: Displayable) -> str:
    """Return the display of an object in HTML: small drawings and a table.

    Parameters
    ----------
    obj : Displayable
        Indenter, law, material, load, grid, case, surface, record, fit, master curve, material
        card, or ``ds.viscontact`` of a result.

    Returns
    -------
    str
        HTML that needs nothing from outside and takes the colours of the page around it.
    """
    return as_html(_overviews(obj))


def display_text(obj: Displayable) -> str:
    """Return the display of an object as a table for a terminal.

    Parameters
    ----------
    obj : Displayable
        Indenter, law, material, load, grid, case, surface, record, fit, master curve, material
        card, or ``ds.viscontact`` of a result.

    Examples
    --------
    >>> from viscontact.bodies.indenters import Sphere
    >>> print(display_text(Sphere(radius=0.01)))
    Sphere
      radius  10 mm
    """
    return as_text(_overviews(obj))


def _overviews(obj: Displayable) -> Iterator[Overview]:
    if isinstance(obj, ResultAccessor):
        yield result_overview(obj.result)
        return
    measured = next((make for kind, make in _MEASURED.items() if isinstance(obj, kind)), None)
    if measured is not None:
        yield measured(obj)
        yield from (_overview(part) for part in _laws_in(obj))
        return
    if not isinstance(obj, DisplayableGroup):
        yield _overview(obj)
        return
    parts = obj.display_parts()
    words = [(name, part) for name, part in parts.items() if isinstance(part, str)]
    yield Overview(obj.display_title, words)
    for name, part in parts.items():
        if isinstance(part, Displayable):
            title = f"{name}: {_name_of(part)}" if _name_of(part) not in name else name
            yield Overview(_sentence_case(title), _rows(part), _drawings(part))


def _overview(obj: Displayable) -> Overview:
    return Overview(_sentence_case(_name_of(obj)), _rows(obj), _drawings(obj))


def _material_overview(card: MaterialCard) -> Overview:
    rows = [("note", note) for note in card.notes]
    return Overview(f"Material card: {card.name}", rows)


def _laws_in(obj: Displayable) -> Iterator[Displayable]:
    """Laws, materials and shift rules in fits and material cards."""
    if isinstance(obj, Fit):
        yield obj.law
    elif isinstance(obj, IndentationFit):
        yield obj.material
    elif isinstance(obj, MaterialCard):
        yield from (part for part in (obj.material, obj.shift) if part is not None)


#: Objects with thousands of numbers, which need an overview of their own.
_MEASURED: dict[type[Displayable], Callable[[Any], Overview]] = {
    Surface: surface_overview,
    IndentationRecord: record_overview,
    Fit: fit_overview,
    IndentationFit: indentation_fit_overview,
    CurveFits: curve_fits_overview,
    Isotherm: isotherm_overview,
    MasterCurve: master_curve_overview,
    MaterialCard: _material_overview,
}


def _name_of(obj: Displayable) -> str:
    return in_plain_words(type(obj).__name__)


def _sentence_case(name: str) -> str:
    return name[:1].upper() + name[1:]


def _rows(obj: Displayable) -> list[tuple[str, ...]]:
    arguments = list(argument_rows(describe(obj)))
    own = _name_of(obj)
    rows: list[tuple[str, ...]] = [
        row for row in arguments if row not in (("shape", own), ("law", own), ("kind", own))
    ]
    known = {value for _, value in arguments}
    return [*rows, *(row for row in _derived_quantities(obj) if row[1] not in known)]


def _derived_quantities(obj: Displayable) -> Iterator[tuple[str, str]]:
    """Quantities that follow from the arguments: cell size, radii of curvature."""
    if isinstance(obj, Grid):
        yield "cell", " × ".join(format_quantity(extent, "m") for extent in obj.cell_size)
    if isinstance(obj, Indenter):
        x, y = obj.curvatures
        if x > 0 and x == y:
            yield "radius of curvature", format_quantity(1 / x, "m")
        elif x > 0 or y > 0:
            yield from (
                (f"radius of curvature along {axis}", format_quantity(1 / curvature, "m"))
                for axis, curvature in (("x", x), ("y", y))
                if curvature > 0
            )


def _drawings(obj: Displayable) -> list[Element]:
    try:
        return _draw(obj)
    except ValueError:  # a user's own object may not be defined everywhere
        return []


def _draw(obj: Displayable) -> list[Element]:
    if isinstance(obj, Indenter):
        return indenter_drawings(obj)
    if isinstance(obj, Layered):
        laws = creeping_laws(obj)
        panels = [each for name, law in laws.items() for each in law_panels(law, name)]
        return [stack_drawing(obj), *map(panel_drawing, panels)]
    if isinstance(obj, Body):
        return _draw(obj.material)
    if isinstance(obj, Law | Material):
        return [*map(panel_drawing, law_panels(obj if isinstance(obj, Law) else obj.law))]
    if isinstance(obj, TemperatureHistory):
        return [panel_drawing(temperature_panel(obj))]
    return [panel_drawing(whole_load_panel(obj))] if isinstance(obj, LoadHistory) else []
