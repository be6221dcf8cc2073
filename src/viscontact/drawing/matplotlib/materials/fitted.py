"""Figures of fitted laws: measured values, fit and residuals."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.drawing.content.fit_course import (
    adhesion_course,
    adhesion_panel,
    course_of,
    course_panels,
    force_panel,
)
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.content.series_fit import fit_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys

if TYPE_CHECKING:
    from viscontact.bodies.series_fits import Fit
    from viscontact.identification import AdhesionFit, IndentationFit

#: Most records beside each other.
_MOST_ACROSS = 3
_LABELS = {"force": "Force", "approach": "Approach"}


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
    >>> import numpy as np
    >>> from viscontact.bodies.series_fits import fit_relaxation
    >>> t = np.geomspace(0.1, 100.0, 20)
    >>> figure = fitted_series(fit_relaxation(t, 1e9 + 2e9 * np.exp(-t / 5.0), data="shear"))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['Relaxation modulus G [GPa]', 'Residual [%]']
    """
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 4.0)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    drawn = fit_panels(fit)
    for axes, panel in zip((above, below), drawn, strict=True):
        draw_panel(axes, panel)
    if len(fit.measured) > 1:
        style.add_legend(above, *named_keys(drawn[0].curves), loc="best")
    return figure


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
    heading = f"{type(fit.law).__name__}, residual {100 * fit.residual:.2g} % rms"
    return _loop_and_course(force_panel(fit), course_of(fit), width, heading)


def fitted_adhesion(fit: AdhesionFit, *, width: Width | None = None) -> Figure:
    """Draw a force curve, the fitted contact that adheres, and the residuals.

    Parameters
    ----------
    fit : AdhesionFit
        From `viscontact.fit_adhesion`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Force, without the baseline, over the approach of the tip from the first touch of the
        undeformed surfaces on, near the contact; dashed lines are the jumps. Next to it, below it
        on a narrow page, the force and its residuals, relative to the largest force, over time.

    Examples
    --------
    >>> import numpy as np
    >>> import viscontact as vc
    >>> jkr = vc.reference.jkr_sphere(5e-6, compliance=1 / 2e6, work=0.02)
    >>> states = [jkr.at_radius(a) for a in np.linspace(0.3e-6, 2e-6, 200)]
    >>> held = np.array([state.force for state in states])
    >>> base = np.array([state.approach for state in states]) + held / 0.5
    >>> end = int(np.argmin(base))
    >>> way = np.linspace(base[end] - 2e-6, base[-1], 100)
    >>> position = np.concatenate([way, way[::-1]])
    >>> bent = np.interp(position, base[end:], held[end:]) / 0.5
    >>> bent[(position < 0) & (np.arange(200) < 100) | (position < base[end])] = 0.0
    >>> curve = vc.ForceCurve(np.linspace(0, 2, 200), position, bent, spring_constant=0.5)
    >>> fit = vc.fit_adhesion(curve, vc.Sphere(5e-6), poisson_ratio=0.5)
    >>> [axes.get_ylabel() for axes in fitted_adhesion(fit).axes]
    ['Force [µN]', 'Force [µN]', 'Residual [%]']
    """
    panel = adhesion_panel(fit)
    return _loop_and_course(panel, adhesion_course(fit), width, "")


def _loop_and_course(
    loop: Panel, course: tuple[Panel, Panel], width: Width | None, heading: str
) -> Figure:
    """Draw force over approach, and beside it, on a narrow page below it, values over time."""
    wide = page_width(width, style.TWO_COLUMNS)
    if wide > NARROW:
        figure = style.new_figure(wide, 3.2)
        panels = figure.subplot_mosaic([["loop", "time"], ["loop", "rest"]], height_ratios=(3, 1.2))
    else:
        figure = style.new_figure(wide, 5.8)
        panels = figure.subplot_mosaic([["loop"], ["time"], ["rest"]], height_ratios=(3, 3, 1.2))
    draw_panel(panels["loop"], loop)
    style.add_legend(panels["loop"], *named_keys(loop.curves), loc="upper left")
    _draw_course(panels["time"], panels["rest"], course)
    if heading:
        style.add_heading(panels["loop"], heading)
    figure.align_ylabels([panels["time"], panels["rest"]])
    return figure


def _draw_course(above: Axes, below: Axes, panels: tuple[Panel, Panel]) -> None:
    """Draw values over time, and their residuals below."""
    above.sharex(below)
    above.tick_params(labelbottom=False)
    for axes, panel in zip((above, below), panels, strict=True):
        draw_panel(axes, panel)


def fitted_records(curves: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw records, the values fitted by runs of a case, and the residuals.

    Parameters
    ----------
    curves : xarray.Dataset
        ``curves`` of a `viscontact.CaseFit`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        For each record the fitted quantity over time, and below it the residual, relative to the
        largest value, in the rows that count.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> times = np.arange(5.0)
    >>> columns = {"time": times, "measured": 1e-6 * times, "fitted": 1e-6 * times}
    >>> texts = {"record": 1, "name": "a.csv", "quantity": "approach", "units": "m"}
    >>> whole = columns | {"residual": 0 * times} | {k: np.full(5, v) for k, v in texts.items()}
    >>> curves = xr.Dataset({name: ("row", values) for name, values in whole.items()})
    >>> [axes.get_ylabel() for axes in fitted_records(curves).axes]
    ['Approach [µm]', 'Residual [%]']
    """
    numbers = np.unique(curves["record"].values)
    across = min(_MOST_ACROSS, numbers.size)
    wide = page_width(width, style.TWO_COLUMNS if across > 1 else style.ONE_COLUMN)
    across = 1 if wide <= NARROW else across
    down = -(-numbers.size // across)
    figure = style.new_figure(wide, 3.2 * down)
    panels = figure.subplots(2 * down, across, squeeze=False, height_ratios=[3, 1.2] * down)
    for place in range(down * across):
        pair = panels[2 * (place // across) :][:2, place % across]
        if place < numbers.size:
            _draw_record(curves.isel(row=curves["record"].values == numbers[place]), *pair)
        else:
            for axes in pair:
                axes.set_visible(False)
    figure.align_ylabels()
    return figure


def _draw_record(record: xr.Dataset, above: Axes, below: Axes) -> None:
    """Draw one record: values above, residuals below."""
    quantity, si = (str(record[name].values[0]) for name in ("quantity", "units"))
    columns = [record[name].values for name in ("time", "measured", "fitted", "residual")]
    course = course_panels(_LABELS[quantity], si, *columns)
    _draw_course(above, below, course)
    style.add_legend(above, *named_keys(course[0].curves), loc="best")
    root = 100 * np.sqrt(np.nanmean(record["residual"].values ** 2))
    style.add_heading(above, f"{record['name'].values[0]}, residual {root:.2g} % rms")
