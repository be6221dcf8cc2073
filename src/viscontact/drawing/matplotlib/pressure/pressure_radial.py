"""Pressure over distance from the axis, with the exact solution (the paper's Figs. 6, 7)."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters import Indenter, Sphere
from viscontact.drawing.content.exact_sphere import exact_sphere
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.reference import LeeRadokContact
from viscontact.results.recorded_case import recorded_object
from viscontact.results.snapshots import Snapshot, labels_of, take_snapshots
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit

_NAME = "pressure-radial"
_MARKERS_AT_MOST = 26
_EXACT_POINTS = 160


def pressure_radial(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw pressure over distance from the axis of a round contact.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored, of an
        indenter that is a body of revolution under a central load.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Markers for the computed cells next to the x axis. For a sphere or round paraboloid
        under a step or a ramp also lines for Lee and Radok's hereditary integral, and below
        the difference in percent of the exact peak at that instant, except for cells less
        than a cell from the rim, over which the pressure is far from linear.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, the indenter is
        not round, or the load acts off its axis.

    Notes
    -----
    Lee and Radok, like Hertz, take the sphere for the paraboloid of its radius R. That alone
    makes a difference of some (a/R)²/10 of the peak, 0.1 % for a contact of radius a = R/10.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> figure = pressure_radial(ds)
    >>> figure.axes[0].get_ylabel(), figure.axes[-1].get_xlabel()
    ('Pressure [kPa]', 'Distance from the axis [µm]')
    """
    snapshots = take_snapshots(results, times, _NAME)
    _require_round(results, snapshots)
    exact = exact_sphere(results, _NAME)
    figure, axes, below = _panels(
        page_width(width, style.TWO_COLUMNS * 0.8), with_difference=exact is not None
    )
    length = readable_unit("m", max(s.extent()[1] for s in snapshots if s.touching))
    pressure = readable_unit("Pa", *(snapshot.pressure for snapshot in snapshots))
    colours = style.time_colours(len(snapshots))
    for snapshot, colour, marker in zip(snapshots, colours, _markers(), strict=False):
        if exact is not None and below is not None:
            _draw_exact(axes, exact, snapshot, colour, length, pressure)
            _draw_difference(below, exact, snapshot, colour, marker, length)
        r, p = _near_x_axis(snapshot)
        if exact is None:  # something to guide the eye from marker to marker
            axes.plot(length(r), pressure(p), color=colour, linewidth=style.THIN_LINE)
        axes.plot(length(r), pressure(p), **_markers_only(colour, marker, r.size))
    lowest = axes if below is None else below
    lowest.set_xlabel(length.label("Distance from the axis"))
    axes.set(ylabel=pressure.label("Pressure"), xlim=(0.0, 1.05 * axes.dataLim.x1))
    axes.set_ylim(0.0, 1.05 * axes.dataLim.y1)
    drawn = [snapshot.time for snapshot in snapshots]
    style.add_heading(axes, peak_note([results], drawn), aside=True)
    _add_key(axes, snapshots, colours, _exact_label(results) if exact else None)
    return figure


def _require_round(results: xr.Dataset, snapshots: list[Snapshot]) -> None:
    indenter = recorded_object(results, "indenter", _NAME)
    kind = type(indenter).__name__
    if not _is_round(indenter, max(s.extent()[1] for s in snapshots if s.touching)):
        raise ValueError(
            f"{_NAME}: needs a body of revolution, got a {kind} that is not; "
            "draw pressure-profile instead"
        )
    offset = np.hypot(results["eccentricity_x"].values, results["eccentricity_y"].values)
    if np.nanmax(offset / np.maximum(results["contact_length"].values, 1e-300)) > 1e-3:
        raise ValueError(
            f"{_NAME}: needs a load on the axis, got one up to "
            f"{format_quantity(np.nanmax(offset), 'm')} off it; draw pressure-profile instead"
        )


def _is_round(indenter: Indenter, radius: float) -> bool:
    distance = radius * np.linspace(0.1, 1.0, 10)
    angle = np.linspace(0.0, np.pi, 9)[:, None]
    gaps = indenter.gap(distance * np.cos(angle), distance * np.sin(angle))
    return bool(np.allclose(gaps, gaps[0], rtol=1e-9, atol=0.0))


def _near_x_axis(snapshot: Snapshot) -> tuple[Floats, Floats]:
    """Distance and pressure of the cells in contact next to the positive x axis."""
    row = int(np.argmin(np.abs(snapshot.y)))
    chosen = (snapshot.x >= 0) & snapshot.in_contact[:, row]
    r = np.hypot(snapshot.x[chosen], snapshot.y[row])
    return r, snapshot.pressure[chosen, row]


def _panels(width: float, *, with_difference: bool) -> tuple[Figure, Axes, Axes | None]:
    figure = style.new_figure(width, 4.2 if with_difference else 3.1)
    if not with_difference:
        axes = figure.add_subplot()
        style.dress(axes)
        return figure, axes, None
    axes, below = figure.subplots(2, sharex=True, height_ratios=(3, 1))
    for panel in (axes, below):
        style.dress(panel)
    below.axhline(0.0, color=style.INK, linewidth=style.THIN_LINE)
    below.set_ylabel("Difference\n[% of peak]")
    style.add_heading(below, "cells at the edge left out", aside=True)
    return figure, axes, below


def _draw_exact(
    axes: Axes,
    exact: LeeRadokContact,
    snapshot: Snapshot,
    colour: str,
    length: ReadableUnit,
    pressure: ReadableUnit,
) -> None:
    radius = float(exact.contact_radius(snapshot.time))
    # Closer together towards the rim, where the pressure falls like a square root.
    r = radius * np.sin(np.linspace(0.0, np.pi / 2, _EXACT_POINTS))
    p = exact.pressure(r, snapshot.time)
    axes.plot(length(r), pressure(p), color=colour, linewidth=style.LINE_WIDTH)


def _draw_difference(
    axes: Axes,
    exact: LeeRadokContact,
    snapshot: Snapshot,
    colour: str,
    marker: str,
    length: ReadableUnit,
) -> None:
    r, ours = _near_x_axis(snapshot)
    inner = r < float(exact.contact_radius(snapshot.time)) - snapshot.cell_size[0]
    if not inner.any():
        return
    r, ours = r[inner], ours[inner]
    theirs = np.asarray(exact.pressure(r, snapshot.time))
    look = _markers_only(colour, marker, r.size)
    axes.plot(length(r), 100 * (ours - theirs) / theirs.max(), **look)


def _markers() -> Iterator[str]:
    return itertools.cycle(style.MARKERS)


def _markers_only(colour: str, marker: str, count: int) -> dict[str, Any]:
    return {
        "color": colour,
        "marker": marker,
        "markersize": 3.6,
        "markerfacecolor": "white",
        "markeredgewidth": 0.9,
        "linestyle": "none",
        "markevery": max(1, -(-count // _MARKERS_AT_MOST)),
    }


def _exact_label(results: xr.Dataset) -> str:
    sphere = isinstance(recorded_object(results, "indenter", _NAME), Sphere)
    return "paraboloid (Lee–Radok)" if sphere else "exact (Lee–Radok)"


def _add_key(
    axes: Axes, snapshots: list[Snapshot], colours: list[str], exact_label: str | None
) -> None:
    handles = [
        Line2D([], [], **_markers_only(colour, marker, 1))
        for colour, marker in zip(colours, _markers(), strict=False)
    ]
    labels = list(labels_of(snapshots))
    if exact_label is not None:
        handles += [
            Line2D([], [], **_markers_only(style.FAINT, "o", 1)),
            Line2D([], [], color=style.FAINT, linewidth=style.LINE_WIDTH),
        ]
        labels += ["computed", exact_label]
    figure = style.figure_of(axes)
    if figure.get_figwidth() > NARROW:
        style.add_legend(axes, handles, labels)
    else:
        style.add_legend_below(figure, handles, labels)
