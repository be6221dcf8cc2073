"""Curves of laws: compliance and modulus over time (the paper's Fig. 5) and frequency."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import Law
from viscontact.bodies.materials.library import Points
from viscontact.drawing.content.compared_runs import runs_of
from viscontact.drawing.content.law_curves import (
    TIME,
    creep_panels,
    material_panels,
    recorded_laws,
    run_times,
    time_of_laws,
)
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.units.numbers import real_array

_NAME = "creep"


def creep(
    results: xr.Dataset | Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the creep compliance and relaxation modulus of the half-space of a run.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`; several results by the names to
        print.
    times : array_like, optional
        Draw the span between the least and the largest of these instants [s]; by default
        the time simulated.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The curves, as drawn by `creep_curve`: of a run at a constant temperature those of the law
        there, of one at a temperature that varies, or with ageing, over the reduced time.

    Raises
    ------
    ValueError
        If the result carries no case, or the span is empty.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> [axes.get_ylabel() for axes in creep(ds).axes]
    ['Creep compliance Φ [1/GPa]', 'Relaxation modulus G [MPa]']
    """
    runs = runs_of(results, _NAME)
    along = time_of_laws(runs.values())
    return draw_laws(recorded_laws(runs), run_times(runs, times), along, width)


def compare_creep(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay the creep compliances and relaxation moduli of the half-spaces of several runs.

    Of a body of layers there is a curve for each part that creeps.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print.
    times : array_like, optional
        Draw the span between the least and the largest of these instants [s]; by default
        that of the times simulated.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        As `creep_curve` draws it, one line per run. The modulus is left out if one of the laws has
        no instant compliance.

    Raises
    ------
    ValueError
        If there are no runs, one carries no case, or the span is empty.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ball = vc.Sphere(0.01)
    >>> one, two = (
    ...     vc.simulate(ball, rubber, vc.step(force), grid, [0.0, 1.0], errors=False)
    ...     for force in (0.1, 0.2)
    ... )
    >>> runs = {"0.1 N": one, "0.2 N": two}
    >>> figure = compare_creep(runs)
    >>> figure.axes[0].get_ylabel()
    'Creep compliance Φ [1/GPa]'
    """
    return creep(runs, times=times, width=width)


def creep_curve(
    law: Law | Mapping[str, Law], times: ArrayLike, *, width: Width | None = None
) -> Figure:
    """Draw creep compliance and relaxation modulus of a law against time.

    Parameters
    ----------
    law : Law or mapping of str to Law
        A creep law, or several by the names to print.
    times : array_like
        Instants to evaluate the law at, above 0 and increasing [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Phi(t) and G(t) over logarithmic time, side by side; of a single law a dashed line marks
        the value at time 0. The modulus is left out for a law without instant compliance, whose
        G(t) starts with an impulse.

    Raises
    ------
    ValueError
        If the times are not positive and increasing.

    Examples
    --------
    >>> from viscontact.bodies.laws import Maxwell
    >>> figure = creep_curve(Maxwell(1e9, 1e11), [1.0, 10.0, 100.0])
    >>> compliance, modulus = figure.axes
    >>> compliance.lines[0].get_ydata().round(3).tolist()  # Phi in 1/GPa
    [0.505, 0.55, 1.0]
    """
    instants = np.atleast_1d(real_array(f"{_NAME}: times", times, "s"))
    if instants.size < 2 or not (instants[0] > 0 and np.all(np.diff(instants) > 0)):
        raise ValueError(
            f"{_NAME}: times must be at least two, above 0 s and increasing, got {times!r}"
        )
    return draw_laws({"": law} if isinstance(law, Law) else law, instants, width=width)


def draw_laws(
    laws: Mapping[str, Law], times: Floats, along: str = TIME, width: Width | None = None
) -> Figure:
    """Draw laws over times above 0 [s], those of a run or of a clock, by the name of the axis."""
    drawn = creep_panels(laws, times, along)
    wide = page_width(width, style.TWO_COLUMNS if len(drawn) == 2 else style.ONE_COLUMN)
    columns = 1 if wide <= NARROW else len(drawn)
    rows = len(drawn) // columns
    figure = style.new_figure(wide, 2.7 if rows == 1 else 2.4 * rows)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for axes, panel in zip(panels, drawn, strict=True):
        draw_panel(axes, panel)
    if len(laws) > 1:
        style.add_legend_below(figure, *named_keys(drawn[0].curves), columns=columns + 1)
    return figure


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
    style.add_legend(panels[-1], *named_keys(drawn[-1].curves), loc="best")
    if title:
        figure.suptitle(style.literal(title), fontsize=style.LABEL_SIZE, color=style.INK)
    return figure


def _place_ticks(axes: Axes) -> None:
    """Place more ticks than at powers of ten on a logarithmic axis of few decades."""
    low, high = axes.get_ylim()
    if high < 120 * low:
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
