"""Report of a check: what a run needs, is expected to find, and will warn of."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import LoadHistory, MixedHistory
from viscontact.results.variables import MESH_DEPENDENT
from viscontact.runs.analysis import Analysis
from viscontact.runs.forecast import Forecast
from viscontact.runs.preparation import PreparedRun
from viscontact.simulation.checks.half_space_theory import SINGULAR_KINDS
from viscontact.simulation.checks.mesh import WARNING_CELLS
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate
from viscontact.units.formatting import format_number, format_quantity

#: Ends of the body up to this multiple of the grid are drawn as well.
FARTHEST_END = 1.3


def verdict(prepared: PreparedRun, expected: Forecast) -> str:
    """Return a line that says if the case has problems."""
    has_warnings = bool(warnings_of(prepared, expected))
    verdict = "can be read, but:" if has_warnings else "no problems found"
    return f"{prepared.case.document.path}: {verdict}"


def drawn_size(run: Analysis[Any, Any]) -> tuple[float, float]:
    """Extents of the drawn region around the origin [m]: the grid, and nearby ends of the body."""
    size = list(run.grid.size_about_origin)
    if run.grid.line_length is not None:  # the body is the same everywhere along its period
        size[0] = min(size)
    for axis in (0, 1):
        beyond = np.linspace(1.0, FARTHEST_END, 400) * size[axis] / 2
        places = np.zeros((2, 2, beyond.size))
        places[axis] = -beyond, beyond
        gap = run.contact.indenter.gap(places[0], places[1])
        if np.isinf(gap[:, -1]).any() and np.isfinite(gap[:, 0]).any():
            last = beyond[np.flatnonzero(np.isfinite(gap).any(axis=0))[-1]]
            size[axis] = 2.1 * float(last)
    return size[0], size[1]


def needs(prepared: PreparedRun, expected: Forecast) -> list[tuple[str, str]]:
    """Return grid, steps or speeds, memory and time of a run as rows of name and value."""
    run = prepared.run
    (nx, ny), (lx, ly), (dx, dy) = run.grid.shape, run.grid.size, run.grid.cell_size
    chosen = " (automatic)" if run.contact.automatic_grid is not None else ""
    growing = "; more if the grid has to grow" if run.grows else ""
    period = _period(run.grid)
    free = f"of {_bytes(expected.available)} free"
    cells = [
        (
            "grid",
            f"{nx} x {ny} cells on {format_quantity(lx, 'm')} x "
            f"{format_quantity(ly, 'm')}{_place_text(run.grid)}{chosen}{period}",
        ),
        ("cell", f"{format_quantity(dx, 'm', 3)} x {format_quantity(dy, 'm', 3)}"),
    ]
    if run.grid.line_length is not None:
        width, cell = max((lx, dx), (ly, dy), key=lambda each: each[0] / each[1])
        row = f"{nx * ny} cells across {format_quantity(width, 'm')}{_place_text(run.grid)}"
        cells = [
            ("grid", f"{row}{chosen}, line along {'xy'[run.grid.periodic.index(True)]}"),
            ("cell", f"{format_quantity(cell, 'm', 3)} wide"),
        ]
    return [
        *cells,
        *run.course(),
        *_events(run.contact.load),
        ("fields kept", _fields_text(run)),
        ("memory", f"about {_bytes(expected.memory)} {free}{growing}"),
        ("run time", f"{_duration(expected.seconds)} on this machine"),
    ]


def _events(load: LoadHistory) -> Iterator[tuple[str, str]]:
    """Events that end the segments of a load program, and their times, by a march on few cells."""
    if isinstance(load, MixedHistory) and load.events:
        about = [
            f"{event.condition} at about {format_quantity(event.time, 's', 3)}"
            for event in load.events
        ]
        yield "events", ",\n".join(about)


def _period(grid: Grid) -> str:
    """Periodicity of a grid, in words."""
    if all(grid.periodic):
        return ", periodic"
    return f", periodic along {'xy'[grid.periodic.index(True)]}" if any(grid.periodic) else ""


def _place_text(grid: Grid) -> str:
    """Middle of a grid that is not centred on the origin, in words."""
    if not any(grid.centre):
        return ""
    x, y = (format_quantity(each, "m", 4) for each in grid.centre)
    return f" around x = {x}, y = {y}"


def _fields_text(run: Analysis[Any, Any]) -> str:
    fields = run.fields
    if fields.requested == "none":
        return "none"
    some = f"{len(fields.places)} {run.axis.rows}"
    when = f"every {run.axis.row}" if fields.requested == "all" else some
    return f"pressure, gap and displacement at {when}"


def expectations(prepared: PreparedRun, expected: Forecast) -> tuple[str, list[tuple[str, str]]]:
    """Return title and rows of the expected contact; no rows without a load."""
    found, load = expected.estimate, prepared.run.contact.load
    control: str = load.control
    if control == "mixed":
        point = prepared.run.contact.largest_load[1]
        control = "approach" if point.force is None else "force"
    without = "" if prepared.run.contact.adhesion is None else " without adhesion"
    title = f"What to expect{without}, by a quick elastic solve on few cells:"
    if found is None:
        return title, []
    # In steady motion load and temperature are constant, and the law need not say when creep ends.
    time = prepared.run.contact.largest_load[0] if prepared.run.axis.is_history else 0.0
    grown = prepared.run.contact.thickening_at(time)
    # Of force and approach, the one that is not prescribed; a line contact has no approach.
    follows = [
        ("approach", format_quantity(found.approach - grown, "m", 3))
        if control == "force"
        else ("force", format_quantity(found.force, "N", 3))
    ]
    return title, [
        ("estimate for", f"largest {control}, {expected.compliance}"),
        *_expected_extent(expected, found),
        ("peak pressure", _peak_pressure(expected, found)),
        *(follows if prepared.run.contact.has_datum(found.grid) else []),
    ]


def _expected_extent(expected: Forecast, found: ContactEstimate) -> list[tuple[str, str]]:
    """Rows of the extents of the expected contact and the cells in it; of a line, across it."""
    extents = [format_quantity(each, "m", 3) for each in (found.length, found.width)]
    cells = [f"{each:.0f}" for each in (expected.cells_along, expected.cells_across)]
    if found.grid.line_length is not None:
        axis = 1 - found.grid.periodic.index(True)
        return [("contact", f"{extents[axis]} wide"), ("cells in it", f"{cells[axis]} across")]
    return [
        ("contact", "{} long, {} wide".format(*extents)),
        ("cells in it", "{} along, {} across".format(*cells)),
    ]


def _peak_pressure(expected: Forecast, found: ContactEstimate) -> str:
    peak = format_quantity(found.peak_pressure, "Pa", 3)
    is_sharp = not SINGULAR_KINDS.isdisjoint(expected.warnings)
    return f">{peak} on a coarse mesh ({MESH_DEPENDENT})" if is_sharp else peak


def warnings_of(prepared: PreparedRun, expected: Forecast) -> list[str]:
    """Return the accuracy warnings that the coarse solve predicts for a run."""
    grid = prepared.run.grid
    if expected.estimate is None:
        return list(expected.warnings.values())
    warnings = []
    if not expected.fits:
        reach = " and ".join(
            format_quantity(far, "m", 3) for far in expected.estimate.reach_from(grid.centre)
        )
        ends = " and ".join(format_quantity(extent / 2, "m", 3) for extent in grid.size)
        warnings.append(
            f"the contact will probably overrun the grid: it reaches {reach} from the middle "
            f"along x and y, and the grid {ends}; enlarge grid.size"
        )
    across = (expected.cells_along, expected.cells_across)
    # A contact that continues from period to period has no extent along that axis.
    periods = zip(across, grid.shape, grid.periodic, strict=True)
    ended = [n for n, k, repeats in periods if not repeats or n < k]
    if min(ended, default=math.inf) < WARNING_CELLS:
        warnings.append(
            f"fewer than {WARNING_CELLS} cells across the contact; use more cells or a smaller "
            "grid.size"
        )
    return warnings + list(expected.warnings.values())


def _duration(seconds: float) -> str:
    return f"about {format_quantity(seconds, 's', 1)}" if seconds > 1 else "about a second"


def _bytes(count: float) -> str:
    megabytes = count / 1e6
    return f"{format_number(megabytes / 1e3, 3)} GB" if megabytes > 1e3 else f"{megabytes:.0f} MB"
