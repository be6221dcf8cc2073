"""Sections through the pressure (the paper's Figs. 10, 13 and 16)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.compared_runs import Runs, runs_of
from viscontact.drawing.content.contact_curve import ContactCurve, cut_at_ends
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.drawing.matplotlib.pressure.contact_curves import draw_curves
from viscontact.results.recorded_case import across_period
from viscontact.results.recorded_motion import motion_axis
from viscontact.results.snapshots import Snapshot
from viscontact.results.variables import MESH_DEPENDENT

_NAME = "pressure-profile"


def pressure_profile(
    results: Runs,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] | None = None,
    at: float | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the pressure on a line through the contact at several instants.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several by
        the names to print.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last; of several results the first in contact and the last of the
        first one.
    along : {"x", "y"}, optional
        Direction of the line: along a roller, or across it. By default that of a motion, across the
        period of a grid that is periodic along one axis only, or else x; as for the first of
        several results.
    at : float, optional
        Position of the line on the other axis [m]; by default the middle of the grid. Between two
        rows of cells the pressure is interpolated.
    axes : matplotlib.axes.Axes, optional
        Axes to draw a single result in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One line per instant; of several results a panel per instant, and a line per run. Along a
        motion of a single one a full marker is at the leading edge of the contact, and a hollow
        one at the trailing edge.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, the line misses the
        grid, or there is no result.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> axes = pressure_profile(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('x [µm]', 'Pressure [kPa]')
    """
    first = next(iter(runs_of(results, _NAME).values()))
    along = along or motion_axis(first) or across_period(first) or "x"
    return draw_curves(results, _curve(along, at), times, axes, width)


def compare_pressure_profiles(
    runs: Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] | None = None,
    at: float | None = None,
    width: Width | None = None,
) -> Figure:
    """Overlay the pressure sections of several runs: `pressure_profile` of a mapping."""
    return pressure_profile(runs, times=times, along=along, at=at, width=width)


def _beyond_border(snapshot: Snapshot) -> Snapshot:
    """The fields, on a periodic grid continued by a cell."""
    return snapshot.with_border(1) if any(snapshot.periodic) else snapshot


def _section(
    snapshot: Snapshot, along: Literal["x", "y"], at: float | None
) -> tuple[Floats, Floats]:
    """Positions [m] and pressure [Pa], up to the ends of the body."""
    return cut_at_ends(snapshot, along, at, snapshot.section(along, at))


def _curve(along: Literal["x", "y"], at: float | None) -> ContactCurve:
    return ContactCurve(
        _NAME,
        "Pressure",
        "Pa",
        along,
        lambda snapshot: _section(_beyond_border(snapshot), along, at),
        lambda snapshot: float(snapshot.pressure.max()),
        f"peak {MESH_DEPENDENT}",
        marks_edges=True,
    )
