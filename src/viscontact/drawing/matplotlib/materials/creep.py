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
from viscontact.bodies.materials.layers import creeping_laws
from viscontact.drawing.content.compared_runs import runs_of
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.log_time import label_log_time
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.results.recorded_case import recorded_object
from viscontact.results.run_axis import law_times
from viscontact.units.formatting import readable_unit

_NAME = "creep"

#: Four decades show how the law gets to where the run begins [-]; points of a curve.
_EARLIEST, _POINTS = 1e-4, 300


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
    laws = {
        f"{name} {part}".strip(): law
        for name, run in runs.items()
        for part, law in creeping_laws(recorded_object(run, "material", _NAME)).items()
    }
    simulated = np.concatenate([law_times(run) for run in runs.values()])
    span = np.atleast_1d(np.asarray(simulated if times is None else times, float))
    positive = span[span > 0]
    if positive.size == 0 or not np.all(np.isfinite(span)):
        raise ValueError(f"{_NAME}: times must be finite with one above 0 s, got {times!r}")
    return _curves(laws, curve_times(float(positive.max()), float(positive.min())), width)


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
    return _curves({"": law} if isinstance(law, Law) else law, instants, width)


def curve_times(end: float, first: float = np.inf) -> Floats:
    """Times up to the end of a run at which its law is drawn, from the first or earlier [s]."""
    return np.geomspace(min(first, _EARLIEST * end), end, _POINTS)


def _curves(laws: Mapping[str, Law], times: Floats, width: Width | None) -> Figure:
    compliances = [(law(times), float(law(0.0))) for law in laws.values()]
    stiff_at_once = all(at_once > 0 for _, at_once in compliances)
    count = 2 if stiff_at_once else 1
    wide = page_width(width, style.TWO_COLUMNS if count == 2 else style.ONE_COLUMN)
    columns = 1 if wide <= NARROW else count
    rows = count // columns
    figure = style.new_figure(wide, 2.7 if rows == 1 else 2.4 * rows)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    _draw(panels[0], "Creep compliance Φ", "1/Pa", times, compliances)
    if stiff_at_once:
        moduli = [(law.relaxation(times), float(law.relaxation(0.0))) for law in laws.values()]
        _draw(panels[1], "Relaxation modulus G", "Pa", times, moduli)
    if len(laws) > 1:
        lines = panels[0].get_lines()[: len(laws)]
        style.add_legend_below(figure, lines, list(laws), columns=columns + 1)
    return figure


def _draw(
    axes: Axes,
    quantity: str,
    si_unit: str,
    times: Floats,
    curves: list[tuple[Floats, float]],
) -> None:
    """Draw curves, each with its value at time 0."""
    everything = [each for values, at_once in curves for each in (values, at_once)]
    unit, time_unit = readable_unit(si_unit, *everything), readable_unit("s", times)
    looks = style.run_styles(len(curves))
    for (values, _), look in zip(curves, looks, strict=True):
        axes.semilogx(time_unit(times), unit(values), **look)
    if len(curves) == 1:
        _mark_beginning(axes, *(unit(each) for each in curves[0]))
    axes.set_ylabel(unit.label(quantity))
    first, end = time_unit([times[0], times[-1]]).tolist()
    axes.set_xlim(first, end)
    axes.set_xlabel(label_log_time(axes, time_unit, first, end))
    style.dress(axes)


def _mark_beginning(axes: Axes, values: Floats, at_once: Floats) -> None:
    """Mark the value at time 0, which is not on a logarithmic axis."""
    level = float(at_once)
    axes.axhline(level, color=style.FAINT, linewidth=0.8, linestyle=(0, (4, 3)))
    rises = values[-1] > level
    axes.annotate(
        "t = 0",
        (1.0, level),
        xycoords=("axes fraction", "data"),
        xytext=(-2, 3 if rises else -3),
        textcoords="offset points",
        ha="right",
        va="bottom" if rises else "top",
        fontsize=style.TICK_SIZE,
        color=style.FAINT,
    )
