"""Curves of a material over time and frequency, and the points they are based on."""

from __future__ import annotations

from collections.abc import Iterable

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from viscontact.bodies.laws import Law
from viscontact.bodies.materials.library import Points
from viscontact.drawing.content.law_curves import material_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel


def material_curves(
    law: Law,
    times: tuple[float, float],
    *,
    measured: tuple[float, float] | None = None,
    points: Iterable[Points] = (),
    title: str = "",
    width: Width | None = None,
) -> Figure:
    """Draw creep, relaxation and complex modulus of a law over logarithmic axes.

    Parameters
    ----------
    law : Law
        A creep law.
    times : tuple of float
        First and last time to draw, above 0 [s]; the frequencies drawn are their reciprocals.
    measured : tuple of float, optional
        First and last time on which the law rests [s]: shaded, the curves solid within and
        dashed beyond. The first may be 0. Solid everywhere when left out.
    points : iterable of Points, optional
        Points for comparison with the law, drawn as markers.
    title : str, optional
        A line above the figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Phi(t), G(t), and G'(ω) with G''(ω), below one another on a narrow page. The relaxation
        modulus is left out for a law without instant compliance, whose G(t) starts with an
        impulse.

    Raises
    ------
    ValueError
        If the times are not positive and increasing.

    Examples
    --------
    >>> from viscontact.bodies.laws import Maxwell
    >>> figure = material_curves(Maxwell(1e9, 1e9), (0.01, 100.0), measured=(0.1, 10.0))
    >>> [axes.get_ylabel().split()[0] for axes in figure.axes]
    ['Creep', 'Relaxation', 'Modulus']
    """
    drawn = material_panels(law, times, measured, tuple(points))
    count, wide = len(drawn), page_width(width, style.TWO_COLUMNS)
    rows = count if wide <= NARROW else 1
    figure = style.new_figure(wide, 2.3 * rows if rows > 1 else 2.8)
    panels = list(figure.subplots(rows, count // rows).flat)
    for axes, panel in zip(panels, drawn, strict=True):
        draw_panel(axes, panel)
        if panel.y.scale == "log":
            _place_ticks(axes)
    style.add_legend(panels[-1], *panels[-1].get_legend_handles_labels(), loc="best")
    if title:
        figure.suptitle(title, fontsize=style.LABEL_SIZE, color=style.INK)
    return figure


def _place_ticks(axes: Axes) -> None:
    """Place more ticks than at powers of ten on a logarithmic axis of few decades."""
    low, high = axes.get_ylim()
    if high < 120 * low:
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
