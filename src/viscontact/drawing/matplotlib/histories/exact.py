"""History of a sphere compared with the exact solution."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.loads import ApproachHistory
from viscontact.drawing.content.along_run import along_run, within_span
from viscontact.drawing.content.exact_history import (
    ExactHistory,
    exact_history,
    exact_label,
)
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import scale_along
from viscontact.results.recorded_case import recorded_object
from viscontact.results.run_axis import require_time
from viscontact.units.formatting import readable_unit

_NAME = "exact"
_MARKERS_AT_MOST = 26
# Between markers, against the diagonal of the axes.
_APART = 0.05


def exact(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the computed history of a sphere, the exact solution and their difference.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, of a sphere or round
        paraboloid under a central load of straight pieces: steps, ramps, triangles, tables.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Contact radius, approach (force, where the approach is given) and peak pressure over
        time: computed values as markers, lines for Hertz's solution on an elastic
        half-space, Lee and Radok's for a step or ramp that is held, Ting's otherwise. In a separate
        panel the difference, in percent of the largest exact value drawn.

    Raises
    ------
    ValueError
        If there is no exact solution, or fewer than two steps lie in the span.

    Notes
    -----
    The radius computed is that of a circle of the contact area. Theory takes the sphere for the
    paraboloid of its radius R, which alone makes a difference of some (a/R)²/10.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> [axes.get_ylabel() for axes in exact(ds).axes][:2]
    ['Contact radius [µm]', 'Approach [µm]']
    """
    require_time(results, _NAME)
    theory = exact_history(results, _NAME)
    names = ["force", "approach", "contact_area", "peak_pressure"]
    run = within_span(results, names, times, _NAME, "")
    within = np.isin(results["time"].values, run["time"].values)
    curves = _curves(results, run, theory, within)
    figure, panels, below = _panels(page_width(width, style.TWO_COLUMNS))
    time = along_run([run])
    instants = time.unit(run["time"].values)
    every = max(1, -(-instants.size // _MARKERS_AT_MOST))
    looks = style.run_styles(len(curves))
    markers = zip(curves, panels, looks, style.MARKERS, strict=False)
    for (label, si_unit, ours, theirs), axes, look, marker in markers:
        unit = readable_unit(si_unit, theirs)
        axes.plot(instants, unit(theirs), color=style.FAINT, linewidth=style.LINE_WIDTH)
        points: dict[str, Any] = {
            **{"color": look["color"], "marker": marker, "markersize": 3.6, "linestyle": "none"},
            **{"markerfacecolor": "white", "markeredgewidth": 0.9, "clip_on": False, "zorder": 3},
        }
        axes.plot(instants, unit(ours), markevery=_APART, **points)
        axes.set_ylabel(unit.label(label))
        part = 100 * (ours - theirs) / (np.abs(theirs).max() or 1.0)
        below.plot(instants, part, markevery=every, **points | {"linestyle": "-", "linewidth": 0.6})
    below.axhline(0.0, color=style.INK, linewidth=style.THIN_LINE)
    below.set_ylabel("Difference\n[% of the largest]")
    for axes in (*panels, below):
        scale_along(axes, time)
    _add_key(figure, panels, below, [curve[0] for curve in curves], results, theory)
    return figure


def _curves(
    results: xr.Dataset, run: xr.Dataset, theory: ExactHistory, within: Bools
) -> list[tuple[str, str, Floats, Floats]]:
    """Label, unit, computed and exact history of each quantity that was not prescribed."""
    radius = np.sqrt(run["contact_area"].values / np.pi)
    by_approach = isinstance(recorded_object(results, "load", _NAME), ApproachHistory)
    follows = (
        ("Force", "N", run["force"].values, theory.force[within])
        if by_approach
        else ("Approach", "m", run["approach"].values, theory.approach[within])
    )
    peak = run["peak_pressure"].values
    return [
        ("Contact radius", "m", radius, theory.contact_radius[within]),
        follows,
        ("Peak pressure", "Pa", peak, theory.peak_pressure[within]),
    ]


def _panels(width: float) -> tuple[Figure, list[Axes], Axes]:
    rows = 2 if width > NARROW else 4
    figure = style.new_figure(width, 2.2 * rows + 0.3 if rows == 2 else 1.7 * rows + 0.5)
    panels = list(figure.subplots(rows, 4 // rows, sharex=True, squeeze=False).flat)
    for axes in panels:
        style.dress(axes)
    return figure, panels[:3], panels[3]


def _add_key(
    figure: Figure,
    panels: list[Axes],
    below: Axes,
    names: list[str],
    results: xr.Dataset,
    theory: ExactHistory,
) -> None:
    """Legend of markers and lines, and of the three differences."""
    handles = [panels[0].get_lines()[0], *below.get_lines()[: len(names)]]
    labels = [exact_label(results, theory.solution, _NAME)]
    labels += [name.lower() for name in names]
    style.add_heading(panels[0], "markers: computed", aside=True)
    style.add_heading(below, f"computed less {labels[0]}", aside=True)
    style.add_legend_below(figure, handles, labels, columns=4)
