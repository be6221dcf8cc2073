"""Line load along x: the pressure integrated over y."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.compared_runs import Runs
from viscontact.drawing.content.contact_curve import ContactCurve
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.drawing.matplotlib.pressure.contact_curves import draw_curves
from viscontact.results.snapshots import Snapshot
from viscontact.results.variables import MESH_DEPENDENT


def line_load(
    results: Runs,
    *,
    times: ArrayLike | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the line load along the indenter at several instants.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several by
        the names to print.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last; of several results the first in contact and the last of the
        first one.
    axes : matplotlib.axes.Axes, optional
        Axes to draw a single result in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One line per instant: the pressure integrated over y, q(x) = ∫ p dy. Of several results a
        panel per instant, and a line per run.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, or there is no result.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid, body = vc.Grid((40, 24), (24e-3, 4e-3)), vc.Paraboloid(radius_x=0.2, radius_y=0.01)
    >>> ds = vc.simulate(body, rubber, vc.step(4.0), grid, [1.0], errors=False)
    >>> axes = line_load(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('x [mm]', 'Line load [N/m]')
    """
    return draw_curves(results, _CURVE, times, axes, width)


def compare_line_loads(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay the line loads of several runs: `line_load` of a mapping."""
    return line_load(runs, times=times, width=width)


def _values(snapshot: Snapshot) -> tuple[Floats, Floats]:
    x, load = snapshot.line_load()
    cell, _ = snapshot.cell_size
    if snapshot.periodic[0]:
        return np.concatenate([x[:1] - cell, x, x[-1:] + cell]), np.pad(load, 1, mode="wrap")
    touched = np.flatnonzero(snapshot.in_contact.any(axis=1))
    if not touched.size:
        return x, load
    # The contact ends within half a cell of the border of its last cells.
    rows = slice(int(touched[0]), int(touched[-1]) + 1)
    ends = x[touched[0]] - cell / 2, x[touched[-1]] + cell / 2
    return np.concatenate([ends[:1], x[rows], ends[1:]]), np.pad(load[rows], 1)


def _largest_load(snapshot: Snapshot) -> float:
    return float(snapshot.line_load()[1].max())


_CURVE = ContactCurve(
    "line-load",
    "Line load",
    "N/m",
    "x",
    _values,
    _largest_load,
    f"at a sharp end it {MESH_DEPENDENT}",
)
