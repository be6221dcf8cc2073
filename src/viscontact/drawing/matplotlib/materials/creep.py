"""Creep compliance and relaxation modulus of a law (the paper's Fig. 5)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import Law
from viscontact.drawing.content.compared_runs import runs_of
from viscontact.drawing.content.law_curves import creep_panels, recorded_laws, run_times
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel

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
        The curves, as drawn by `creep_curve`.

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
    return _draw_laws(recorded_laws(runs), run_times(runs, times), width)


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
    instants = np.atleast_1d(np.asarray(times, dtype=np.float64))
    if instants.size < 2 or not (instants[0] > 0 and np.all(np.diff(instants) > 0)):
        raise ValueError(
            f"{_NAME}: times must be at least two, above 0 s and increasing, got {times!r}"
        )
    return _draw_laws({"": law} if isinstance(law, Law) else law, instants, width)


def _draw_laws(laws: Mapping[str, Law], times: Floats, width: Width | None) -> Figure:
    drawn = creep_panels(laws, times)
    wide = page_width(width, style.TWO_COLUMNS if len(drawn) == 2 else style.ONE_COLUMN)
    columns = 1 if wide <= NARROW else len(drawn)
    rows = len(drawn) // columns
    figure = style.new_figure(wide, 2.7 if rows == 1 else 2.4 * rows)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for axes, panel in zip(panels, drawn, strict=True):
        draw_panel(axes, panel)
        if panel.marks:
            _explain_mark(axes, panel)
    if len(laws) > 1:
        style.add_legend_below(figure, panels[0].get_lines(), list(laws), columns=columns + 1)
    return figure


def _explain_mark(axes: Axes, panel: Panel) -> None:
    """Write what a level is, on the side of it where the curve is not."""
    (mark,), (curve,) = panel.marks, panel.curves
    axes.get_lines()[-1].set(linewidth=0.8, linestyle=(0, (4, 3)))
    rises = curve.y[-1] > mark.place
    axes.annotate(
        mark.text,
        (1.0, float(panel.y.unit(mark.place))),
        xycoords=("axes fraction", "data"),
        xytext=(-2, 3 if rises else -3),
        textcoords="offset points",
        ha="right",
        va="bottom" if rises else "top",
        fontsize=style.TICK_SIZE,
        color=style.FAINT,
    )
