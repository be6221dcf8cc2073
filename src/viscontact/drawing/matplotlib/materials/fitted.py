"""Figures of fitted laws: measured values, fit and residuals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.fit_course import course_of, force_panel
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel
from viscontact.identification import Fit, IndentationFit
from viscontact.units.formatting import ReadableUnit, readable_unit

_WIDE = 4.0  # ratio above which a column is drawn on a logarithmic axis
LABELS = {
    "compliance": "Creep compliance",
    "modulus": "Relaxation modulus",
    "storage": "Storage modulus",
    "loss": "Loss modulus",
}
MARKERS = {"compliance": "o", "modulus": "o", "storage": "o", "loss": "s"}
MARKER_SIZE = 3.2
_SECOND = "#D55E00"


def fitted_series(fit: Fit, *, width: Width | None = None) -> Figure:
    """Draw measured values, the fitted series and the relative residuals.

    Parameters
    ----------
    fit : Fit
        From `viscontact.fit_creep`, `viscontact.fit_relaxation` or `viscontact.fit_dynamic`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Values above, residuals below, over logarithmic time or frequency. Small ticks at the
        bottom of the upper panel mark the times of the terms. A heading states a misfit.

    Examples
    --------
    >>> from viscontact.identification import fit_relaxation
    >>> t = np.geomspace(0.1, 100.0, 20)
    >>> figure = fitted_series(fit_relaxation(t, 1e9 + 2e9 * np.exp(-t / 5.0), data="shear"))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['Relaxation modulus G [GPa]', 'Residual [%]']
    """
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 4.0)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    unit = _unit_of(fit)
    shown = fit.points > 0  # time 0 is not on a logarithmic axis
    along = geometric(fit.points[shown])
    curves = fit.curve(along)
    for (name, values), colour in zip(fit.measured.items(), (style.LINE, _SECOND), strict=False):
        marker: dict[str, Any] = {
            "marker": MARKERS[name],
            "markersize": MARKER_SIZE,
            "linestyle": "none",
        }
        above.plot(
            fit.points[shown],
            unit(values[shown]),
            markerfacecolor="none",
            markeredgecolor=colour,
            markeredgewidth=0.8,
            label=f"{LABELS[name]}, measured" if len(fit.measured) > 1 else "measured",
            **marker,
        )
        above.plot(along, unit(curves[name]), color=colour, linewidth=style.LINE_WIDTH)
        below.plot(fit.points[shown], 100 * fit.residuals[name][shown], color=colour, **marker)
    _dress_series(fit, above, below, unit)
    return figure


def _dress_series(fit: Fit, above: Axes, below: Axes, unit: ReadableUnit) -> None:
    above.set_xscale("log")
    if spans_decades(*fit.measured.values()):
        above.set_yscale("log")
    times = np.array(fit.series.times)
    marks = 1.0 / times if "storage" in fit.measured else times
    within = (marks >= fit.points[fit.points > 0].min()) & (marks <= fit.points.max())
    above.plot(
        marks[within],
        np.full(int(within.sum()), 0.0),
        transform=above.get_xaxis_transform(),
        marker="|",
        markersize=9,
        linestyle="none",
        color=style.INK,
        clip_on=False,
    )
    names = list(fit.measured)
    note = f"{count_of_terms(fit)} (ticks), residual {residual_note(fit)}"
    if fit.misfit is None:
        style.add_heading(above, note, aside=True)
    else:
        style.add_heading(above, f"{note}\n{misfit_note(fit)}")
    quantity = LABELS[names[0]] if len(names) == 1 else "Modulus"
    above.set_ylabel(unit.label(f"{quantity} {_symbol(fit)}"))
    if len(names) > 1:
        lines = above.get_lines()[: 2 * len(names)]
        handles = [lines[2 * i] for i in range(len(names))]
        style.add_legend(above, handles, [LABELS[name] for name in names], loc="best")
    below.axhline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    reach = 115 * fit.largest_residual or 1.0
    below.set_ylim(-reach, reach)
    below.set(xlabel=abscissa(fit.measured), ylabel="Residual [%]")
    for axes in (above, below):
        style.dress(axes)


def fitted_indentation(fit: IndentationFit, *, width: Width | None = None) -> Figure:
    """Draw an indentation record, the fitted law and its residuals.

    Parameters
    ----------
    fit : IndentationFit
        From `viscontact.fit_indentation`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Force over approach; next to it, below it on a narrow page, the fitted quantity and its
        residuals, relative to the largest value, over time.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.identification import IndentationRecord, fit_indentation
    >>> from viscontact.bodies.indenters import Sphere
    >>> depth = 1e-6 * np.concatenate([np.linspace(0, 1, 11), np.linspace(0.9, 0, 10)])
    >>> force = 16 / 3 * 2e6 * np.sqrt(5e-6) * depth**1.5
    >>> record = IndentationRecord(Sphere(5e-6), np.linspace(0, 2, 21), depth, force)
    >>> fit = fit_indentation(record, "elastic", poisson_ratio=0.5)
    >>> [axes.get_ylabel() for axes in fitted_indentation(fit).axes]
    ['Force [µN]', 'Force [µN]', 'Residual [%]']
    """
    wide = page_width(width, style.TWO_COLUMNS)
    if wide > NARROW:
        figure = style.new_figure(wide, 3.2)
        panels = figure.subplot_mosaic([["loop", "time"], ["loop", "rest"]], height_ratios=(3, 1.2))
    else:
        figure = style.new_figure(wide, 5.8)
        panels = figure.subplot_mosaic([["loop"], ["time"], ["rest"]], height_ratios=(3, 3, 1.2))
    loop, over_time, below = panels["loop"], panels["time"], panels["rest"]
    draw_panel(loop, force_panel(fit))
    style.add_legend(loop, loop.get_lines(), ["measured", "fitted"], loc="upper left")
    draw_course(over_time, below, course_of(fit))
    style.add_heading(loop, f"{type(fit.law).__name__}, residual {100 * fit.residual:.2g} % rms")
    figure.align_ylabels([over_time, below])
    return figure


def draw_course(above: Axes, below: Axes, panels: tuple[Panel, Panel]) -> None:
    """Draw values over time, and their residuals below."""
    above.sharex(below)
    above.tick_params(labelbottom=False)
    for axes, panel in zip((above, below), panels, strict=True):
        draw_panel(axes, panel)


def count_of_terms(fit: Fit) -> str:
    """Number of terms of a fit, in words."""
    return f"{fit.terms} term{'' if fit.terms == 1 else 's'}"


def residual_note(fit: Fit) -> str:
    """Residuals in words, of each column where there are two."""
    parts = {name: 100 * np.sqrt(np.mean(r**2)) for name, r in fit.residuals.items()}
    if len(parts) == 1:
        return f"{100 * fit.residual:.2g} % rms"
    return ", ".join(f"{value:.2g} % ({name})" for name, value in parts.items()) + " rms"


def misfit_note(fit: Fit) -> str:
    """Misfit and its reason in words; empty for a fit that meets the data."""
    return f"Misses the data: {fit.misfit.reason.value}" if fit.misfit else ""


def _unit_of(fit: Fit) -> ReadableUnit:
    si_unit = "1/Pa" if "compliance" in fit.measured else "Pa"
    return readable_unit(si_unit, *fit.measured.values())


def _symbol(fit: Fit) -> str:
    """Symbol of the fitted quantity, by the convention of the data."""
    if "compliance" in fit.measured:
        return {"deviatoric": "Φ", "shear": "J", "uniaxial": "D"}[fit.data]
    letter = "E" if fit.data == "uniaxial" else "G"
    return letter if "modulus" in fit.measured else f"{letter}′, {letter}″"


def abscissa(measured: Mapping[str, Floats], *, reduced: bool = False) -> str:
    """Label of the axis of time or frequency, reduced by the shift factors or not."""
    oscillates = "storage" in measured
    label = "Angular frequency" if oscillates else "Time"
    unit = "rad/s" if oscillates else "s"
    if reduced:
        symbol = "$\\omega a_T$" if oscillates else "$t/a_T$"
        return f"{label.lower()} {symbol} [{unit}]"
    return f"{label} [{unit}]"


def geometric(points: ArrayLike) -> Floats:
    """Points for a curve over the range of measured ones, even on a logarithmic axis."""
    positive = np.asarray(points, dtype=np.float64)
    return np.geomspace(positive.min(), positive.max(), 400)


def spans_decades(*columns: Floats) -> bool:
    """True if columns need a logarithmic axis."""
    values = np.concatenate(columns)
    return bool(values.max() > _WIDE * values.min())
