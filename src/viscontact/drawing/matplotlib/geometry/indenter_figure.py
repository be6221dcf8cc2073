"""Figure of the indenter of a run: sections and plan, with the computed contact."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.matplotlib.geometry.indenter_drawing import draw_indenter
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.results.recorded_case import recorded_ends, recorded_grid
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.snapshots import labels_of, take_snapshots
from viscontact.units.numbers import finite_array

_NAME = "indenter"


def indenter(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the indenter of a run: sections along x and y, and its plan.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`.
    times : array_like, optional
        An instant [s], the contact at which is shaded, if fields are stored; by default the last
        that is stored in contact.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        As `draw_indenter` draws it, on the part of the surface that the grid covers: the gap
        before contact.

    Raises
    ------
    ValueError
        If the result carries no case, or the indenter is a measured map, which is not kept with
        it; or `times` are no finite numbers.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> [axes.get_xlabel() for axes in indenter(ds).axes]
    ['x [mm]', 'y [mm]', 'x [mm]', '']
    """
    body = recorded_object(results, "indenter", _NAME)
    if times is not None:
        finite_array(f"{_NAME}: times", times, "s")
    contact, shaded = None, ""
    if "pressure" in results and bool((results["contact_area"] > 0).any()):
        snapshot = take_snapshots(results, times, _NAME)[-1]
        x_low, x_high, y_low, y_high = snapshot.extent()
        middle = ((x_low + x_high) / 2, (y_low + y_high) / 2)
        contact = (*middle, x_high - x_low, y_high - y_low)
        shaded = f"contact at {labels_of([snapshot])[0]}"
    size = recorded_grid(results).size_about_origin
    ends = [end.place for end in recorded_ends(results)]
    return draw_indenter(body, size, contact=contact, shaded=shaded, ends=ends, width=width)
