"""History of a sphere compared with the exact solution."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.exact_history import exact_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys


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
    drawn, wide = exact_panels(results, times), page_width(width, style.TWO_COLUMNS)
    rows = 2 if wide > NARROW else 4
    figure = style.new_figure(wide, 2.2 * rows + 0.3 if rows == 2 else 1.7 * rows + 0.5)
    panels = list(figure.subplots(rows, 4 // rows, sharex=True, squeeze=False).flat)
    for axes, panel in zip(panels, drawn, strict=True):
        draw_panel(axes, panel)
    *_, differences = drawn
    panels[-1].set_ylabel(differences.y.label.replace(" [", "\n["))
    keys = named_keys([*drawn[0].curves, *differences.curves])
    style.add_legend_below(figure, *keys, columns=4)
    return figure
