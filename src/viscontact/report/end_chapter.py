"""Chapter of a report on the ends of bodies, and what a half-space without ends would answer."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadPoint
from viscontact.bodies.materials.material import Material
from viscontact.drawing.matplotlib.pressure.end_line_load import end_line_load
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.report.page_elements import drawn_figure, remark, stacked_table, text_table
from viscontact.results.recorded_case import RecordedEnd, recorded_ends, recorded_grid
from viscontact.results.recorded_objects import recorded_clock, recorded_object
from viscontact.results.run_axis import run_axis
from viscontact.results.snapshots import Snapshot, take_snapshots
from viscontact.simulation.meshing.elastic_estimate import elastic_contact
from viscontact.simulation.transient.grid_enlargement import overrun
from viscontact.units.formatting import format_number, format_quantity

#: Most cells of a grid on which the contact of half-spaces is solved for a report.
MOST_CELLS = 200_000

#: Distances from an end of the rows of the table, in half widths of the contact.
DISTANCES = (0.25, 0.5, 1.0, 2.0)

PARTS = {"material": "half-space", "indenter_material": "pressed body"}


def end_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield where bodies end, the line load, and that of half-spaces beside it."""
    ends = recorded_ends(ds)
    if not ends:
        return
    yield text_table(("body", "ends at", "which is"), [_row(end) for end in ends])
    compared = compared_loads(ds)
    if compared is None:
        return
    figure = end_line_load(compared.x, compared.loads, [end.place for end in ends])
    yield drawn_figure(figure, f"Line load at {compared.place}; dotted: ends of bodies.")
    rows = list(_rows(compared, ends))
    if rows:
        yield stacked_table(("from the end", *compared.loads), rows)
    yield remark(
        "Half-space: the same load on bodies without ends, elastic with their compliance at that "
        "instant. Loads in the table are over the mean with ends."
    )


def _row(end: RecordedEnd) -> tuple[str, ...]:
    kind = "free of stress" if end.kind == "free" else "held by a wall without friction"
    return PARTS[end.part], f"x = {format_quantity(end.place, 'm', 4)}", kind


@dataclass(frozen=True, eq=False)
class ComparedLoads:
    """Line loads over x at an instant, with the ends of bodies and without."""

    place: str
    x: Floats  # [m]
    loads: dict[str, Floats]  # [N/m]
    half_width: float  # of the contact [m]


def compared_loads(ds: xr.Dataset) -> ComparedLoads | None:
    """Line loads at the stored instant of the largest force; None if they are not to be had."""
    axis = run_axis(ds)
    if not axis.is_history or ds.sizes.get("x", 0) * ds.sizes.get("y", 0) > MOST_CELLS:
        return None
    if recorded_grid(ds).periodic[1]:  # a line load is that of a period
        return None
    try:
        stored = take_snapshots(ds, None, "ends")
    except ValueError:  # no fields, or no contact
        return None
    largest = max(stored, key=lambda each: float(each.line_load()[1].sum()))
    half_space = _without_ends(ds, largest)
    if half_space is None:
        return None
    x, own = largest.line_load()
    width = float(ds["contact_width"].sel(time=largest.time, method="nearest"))
    loads = {"with ends": own, "half-space": half_space}
    return ComparedLoads(axis.place(largest.time), x, loads, width / 2)


def _without_ends(ds: xr.Dataset, snapshot: Snapshot) -> Floats | None:
    """Line load of an elastic contact of half-spaces under the same load [N/m]."""
    indenter = recorded_object(ds, "indenter", "ends")
    if not isinstance(indenter, Indenter):
        return None
    compliance = 0.0
    for part in PARTS:
        body = recorded_object(ds, part, "ends")
        if isinstance(body, Material):
            reduced = recorded_clock(ds, part, "ends").reduced(np.array(snapshot.time))
            compliance += float(body.contact_compliance()(float(reduced)))
        elif body is not None:
            return None
    state = ds.sel(time=snapshot.time, method="nearest")
    place = [float(state[name]) if name in state else 0.0 for name in ("position_x", "position_y")]
    grid = recorded_grid(ds)
    moved = indenter.shifted(*place) if any(place) else indenter
    force, *offsets = (float(state[name]) for name in ("force", "eccentricity_x", "eccentricity_y"))
    # Moments are about the origin there.
    offsets = [offset + at for offset, at in zip(offsets, place, strict=True)]
    point = LoadPoint(force, offsets[0], offsets[1], None, None)
    return _elastic_line_load(moved, compliance, point, grid)


def _elastic_line_load(
    indenter: Indenter, compliance: float, point: LoadPoint, grid: Grid
) -> Floats | None:
    """Line load of an elastic contact on the rows of a grid [N/m], wider where it needs to be."""
    wider = grid
    while wider.shape[0] * wider.shape[1] <= MOST_CELLS:
        open_gap = indenter.gap(wider.x[:, None], wider.y[None, :])
        found = elastic_contact(open_gap, compliance, point, ContactDomain(wider))
        along, across = overrun(found.in_contact)
        if found.converged and not (along or across):
            load = found.pressure.sum(axis=1) * grid.cell_size[1]
            first = (wider.shape[0] - grid.shape[0]) // 2
            return np.asarray(load[first : first + grid.shape[0]])
        nx, ny = grid.shape
        wider = wider.widened((wider.shape[0] + 2 * nx * along, wider.shape[1] + 2 * ny * across))
        if not (along or across):
            return None
    return None


def _rows(compared: ComparedLoads, ends: tuple[RecordedEnd, ...]) -> Iterator[tuple[str, ...]]:
    """Rows of line loads near the outermost free end at +x, or else at -x, over the mean."""
    free = [end.place for end in ends if end.kind == "free"]
    own = compared.loads["with ends"]
    loaded = np.flatnonzero(own)
    if not free or not loaded.size:
        return
    mean = float(own[loaded].mean())
    step = float(compared.x[1] - compared.x[0])
    borders = compared.x[loaded[[0, -1]]] + np.array([-0.5, 0.5]) * step
    # The end that the contact reaches, that at +x first, and the way from it into the body.
    reached = [
        (end, side)
        for side, border in ((-1, borders[1]), (1, borders[0]))
        for end in free
        if abs(end - border) < 2 * step
    ]
    if not reached:
        return
    end, side = reached[0]
    for distance in DISTANCES:
        at = end + side * distance * compared.half_width
        values = (float(np.interp(at, compared.x, load)) / mean for load in compared.loads.values())
        away = format_quantity(distance * compared.half_width, "m", 3)
        yield away, *(format_number(value, 3) for value in values)
