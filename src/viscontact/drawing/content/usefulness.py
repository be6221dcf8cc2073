"""Results for which the figures of reports and of the calculator page are of use."""

from __future__ import annotations

from collections.abc import Callable

import xarray as xr

from viscontact.drawing.content.force_curve import adheres
from viscontact.drawing.content.loop import loops_of
from viscontact.drawing.figures import FigureEntry
from viscontact.results.fretting import acting_directions, is_gripping
from viscontact.results.rolling import has_creepages
from viscontact.results.shown_scalars import is_line, is_long, lacks_datum


def is_of_use(entry: FigureEntry, ds: xr.Dataset) -> bool:
    """True if a figure shows something of a result."""
    test = TESTS.get(entry.reported.of_use) if entry.reported else None
    return test is None or test(ds)


def has_line_load(ds: xr.Dataset) -> bool:
    """True for a long contact with its pressure."""
    return is_long(ds) and "pressure" in ds and not is_line(ds)


def has_outline(ds: xr.Dataset) -> bool:
    """True for a contact whose outline is more than two straight lines."""
    return not is_line(ds)


def has_loops(ds: xr.Dataset) -> bool:
    """True for a run with loops of force over approach, or of resistance over position."""
    return bool(loops_of(ds))


def has_force_curve(ds: xr.Dataset) -> bool:
    """True for bodies that adhere."""
    return adheres(ds) and ds.sizes["time"] > 1


def has_slip(ds: xr.Dataset) -> bool:
    """True for a run under friction."""
    return is_gripping(ds)


def has_stored_slip(ds: xr.Dataset) -> bool:
    """True for a run under friction with its fields."""
    return is_gripping(ds) and "slip_state" in ds and bool((ds["contact_area"].values > 0).any())


def has_shift(ds: xr.Dataset) -> bool:
    """True for a run under friction whose body is loaded along a direction, and shifts."""
    return is_gripping(ds) and not lacks_datum(ds) and bool(acting_directions(ds))


#: Tests that the table of figures names.
TESTS: dict[str, Callable[[xr.Dataset], bool]] = {
    each.__name__: each
    for each in (
        *(has_line_load, has_outline, has_loops, has_force_curve),
        *(has_slip, has_stored_slip, has_shift, has_creepages),
    )
}
