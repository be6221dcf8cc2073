"""What was identified: measured values, the fitted law and what it misses; a master curve."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from viscontact.identification import Fit, IndentationFit, MasterCurve, ShiftFit
from viscontact.laws import Shift
from viscontact.plot.layout import style
from viscontact.plot.layout.page import NARROW, Width, page_width
from viscontact.units.formatting import ReadableUnit, readable_unit
from viscontact.units.temperatures import in_celsius

Array = NDArray[np.float64]

_WIDE = 4.0  # a column that spans more than this factor is drawn on a logarithmic axis
_LABELS = {
    "compliance": "Creep compliance",
    "modulus": "Relaxation modulus",
    "storage": "Storage modulus",
    "loss": "Loss modulus",
}
_MARKERS = {"compliance": "o", "modulus": "o", "storage": "o", "loss": "s"}
_DOT = 3.2
_SECOND = "#D55E00"


def fitted_series(fit: Fit, *, width: Width | None = None) -> Figure:
    """Draw measured values, the series fitted to them and the relative residuals.

    Parameters
    ----------
    fit : Fit
        What `viscontact.fit_creep`, `viscontact.fit_relaxation` or
        `viscontact.fit_dynamic` returned.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Values above, residuals below, over logarithmic time or frequency. Small ticks along the
        foot of the upper panel mark the times of the terms.

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
    shown = fit.points > 0  # the instant itself is not on a logarithmic axis
    along = _geometric(fit.points[shown])
    curves = fit.curve(along)
    for (name, values), colour in zip(fit.measured.items(), (style.LINE, _SECOND), strict=False):
        marker: dict[str, Any] = {"marker": _MARKERS[name], "markersize": _DOT, "linestyle": "none"}
        above.plot(
            fit.points[shown],
            unit(values[shown]),
            markerfacecolor="none",
            markeredgecolor=colour,
            markeredgewidth=0.8,
            label=f"{_LABELS[name]}, measured" if len(fit.measured) > 1 else "measured",
            **marker,
        )
        above.plot(along, unit(curves[name]), color=colour, linewidth=style.LINE_WIDTH)
        below.plot(fit.points[shown], 100 * fit.residuals[name][shown], color=colour, **marker)
    _dress_series(fit, above, below, unit)
    return figure


def _dress_series(fit: Fit, above: Axes, below: Axes, unit: ReadableUnit) -> None:
    above.set_xscale("log")
    if _is_wide(*fit.measured.values()):
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
    style.add_heading(above, f"{_count(fit)} (ticks), residual {_rms(fit)}", aside=True)
    quantity = _LABELS[names[0]] if len(names) == 1 else "Modulus"
    above.set_ylabel(unit.label(f"{quantity} {_symbol(fit)}"))
    if len(names) > 1:
        lines = above.get_lines()[: 2 * len(names)]
        handles = [lines[2 * i] for i in range(len(names))]
        style.add_legend(above, handles, [_LABELS[name] for name in names], loc="best")
    below.axhline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    reach = 115 * fit.largest_residual or 1.0
    below.set_ylim(-reach, reach)
    below.set(xlabel=_abscissa(fit.measured), ylabel="Residual [%]")
    for axes in (above, below):
        style.dress(axes)


def fitted_indentation(fit: IndentationFit, *, width: Width | None = None) -> Figure:
    """Draw an indentation record, the law fitted to it and what it misses.

    Parameters
    ----------
    fit : IndentationFit
        What `viscontact.fit_indentation` returned.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Force over approach; beside it, below it on a narrow page, what was fitted, and the
        residuals relative to its largest value, over time.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.identification import IndentationRecord, fit_indentation
    >>> from viscontact.indenters import Sphere
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
    record = fit.record
    d, F, t = (
        readable_unit("m", record.approach),
        readable_unit("N", record.force),
        readable_unit("s", record.times),
    )
    force, approach = (
        (fit.fitted, record.approach) if fit.given == "approach" else (record.force, fit.fitted)
    )
    dots: dict[str, Any] = {
        "marker": "o",
        "markersize": _DOT,
        "linestyle": "none",
        "markerfacecolor": "none",
        "markeredgecolor": style.LINE,
        "markeredgewidth": 0.7,
    }
    line: dict[str, Any] = {"color": _SECOND, "linewidth": style.LINE_WIDTH}
    counted = np.isfinite(fit.residuals)
    loop.plot(d(record.approach), F(record.force), **dots, label="measured")
    loop.plot(d(approach[counted]), F(force[counted]), **line, label="fitted")
    loop.set(xlabel=d.label("Approach"), ylabel=F.label("Force"))
    style.add_legend(loop, loop.get_lines(), ["measured", "fitted"], loc="upper left")
    unit, quantity = (F, "Force") if fit.given == "approach" else (d, "Approach")
    over_time.plot(t(record.times), unit(fit.measured), **dots)
    over_time.plot(t(record.times[counted]), unit(fit.fitted[counted]), **line)
    over_time.set_ylabel(unit.label(quantity))
    over_time.sharex(below)
    over_time.tick_params(labelbottom=False)
    below.axhline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    below.plot(t(record.times), 100 * fit.residuals, **dots)
    below.set(xlabel=t.label("Time"), ylabel="Residual [%]")
    style.add_heading(loop, f"{type(fit.law).__name__}, residual {100 * fit.residual:.2g} % rms")
    for axes in panels.values():
        style.dress(axes)
    figure.align_ylabels([over_time, below])
    return figure


def master_curve(
    curve: MasterCurve,
    *,
    fit: Fit | None = None,
    rules: Sequence[ShiftFit] = (),
    width: Width | None = None,
) -> Figure:
    """Draw the sets of several temperatures, their shift factors and the curve they make.

    Parameters
    ----------
    curve : MasterCurve
        What `viscontact.build_master_curve` returned.
    fit : Fit, optional
        The series fitted to it.
    rules : sequence of ShiftFit, optional
        Rules to draw through the shift factors.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The sets as measured and their shift factors above, the master curve below; colours go
        from cold (dark) to warm (light). Of an oscillation, storage has circles and loss squares.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.identification import Isotherm, build_master_curve
    >>> times = np.geomspace(1.0, 100.0, 9)
    >>> sets = [
    ...     Isotherm(283.15 + 10 * k, times, {"compliance": 1e-9 * (10**k * times) ** 0.2})
    ...     for k in (1, 2, 3)
    ... ]
    >>> figure = master_curve(build_master_curve(sets, 293.15))
    >>> [axes.get_ylabel() for axes in figure.axes][:2]
    ['Creep compliance [1/GPa]', 'log₁₀ of shift factor $a_T$']
    """
    wide = page_width(width, style.TWO_COLUMNS)
    figure = style.new_figure(wide, 5.4 if wide > NARROW else 7.4)
    panels = (
        figure.subplot_mosaic([["sets", "shifts"], ["master", "master"]])
        if wide > NARROW
        else figure.subplot_mosaic([["sets"], ["shifts"], ["master"]])
    )
    celsius = in_celsius(curve.temperatures)
    # The palest end of the map fades on white.
    shades = LinearSegmentedColormap.from_list("sets", colormaps["plasma"](np.linspace(0, 0.85)))
    norm = Normalize(celsius.min(), max(celsius.max(), celsius.min() + 1.0))
    unit = readable_unit(
        "1/Pa" if "compliance" in curve.measured else "Pa", *curve.measured.values()
    )
    reduced = curve.reduced_points
    for i, isotherm in enumerate(curve.isotherms):
        colour = shades(norm(celsius[i]))
        for name, values in isotherm.measured.items():
            look: dict[str, Any] = {
                "marker": _MARKERS[name],
                "markersize": _DOT - 0.6,
                "color": colour,
            }
            if name == "loss":
                look |= {"markerfacecolor": "none", "markeredgewidth": 0.7}
            later = isotherm.points > 0  # the instant itself is not on a logarithmic axis
            shown = unit(values[later])
            panels["sets"].plot(isotherm.points[later], shown, linewidth=0.6, **look)
            panels["master"].plot(reduced[i][later], shown, linestyle="none", **look)
    if fit is not None:
        along = _geometric(curve.points)
        for values in fit.curve(along).values():
            panels["master"].plot(along, unit(values), color=style.INK, linewidth=1.0)
    _dress_sets(curve, panels["sets"], panels["master"], unit, fit)
    _draw_shifts(curve, panels["shifts"], rules)
    bar = figure.colorbar(ScalarMappable(norm, shades), ax=list(panels.values()), aspect=45)
    bar.set_label("Temperature [°C]", size=style.LABEL_SIZE, color=style.INK)
    bar.ax.tick_params(labelsize=style.TICK_SIZE, width=style.THIN_LINE, colors=style.INK)
    bar.outline.set_visible(False)
    return figure


def _dress_sets(
    curve: MasterCurve, sets: Axes, master: Axes, unit: ReadableUnit, fit: Fit | None
) -> None:
    names = list(curve.measured)
    quantity = _LABELS[names[0]] if len(names) == 1 else "Modulus"
    for axes in (sets, master):
        axes.set_xscale("log")
        if _is_wide(*curve.measured.values()):
            axes.set_yscale("log")
        axes.set_ylabel(unit.label(quantity))
        style.dress(axes)
    sets.set_xlabel(_abscissa(curve.measured))
    master.set_xlabel("Reduced " + _abscissa(curve.measured, reduced=True))
    # Markers are told in the heading: a legend would lie on the sets, which fill their panel.
    markers = ": ● storage, □ loss" if len(names) > 1 else ""
    style.add_heading(sets, f"As measured{markers}")
    at = f"{in_celsius(curve.reference_temperature):.4g} °C"
    apart = ", " if style.figure_of(master).get_figwidth() > NARROW else "\n"
    said = f"{apart}{_count(fit)}, residual {_rms(fit)}" if fit else ""
    style.add_heading(master, f"Master curve at {at}{said}")


def _draw_shifts(curve: MasterCurve, axes: Axes, rules: Sequence[ShiftFit]) -> None:
    celsius = in_celsius(curve.temperatures)
    axes.plot(
        celsius,
        np.log10(curve.factors),
        marker="o",
        markersize=_DOT,
        markerfacecolor="none",
        color=style.INK,
        linestyle="none",
    )
    handles, labels = list(axes.get_lines()), ["found" if curve.mismatches is not None else "given"]
    between = np.linspace(curve.temperatures[0], curve.temperatures[-1], 200)
    for rule, look in zip(rules, style.run_styles(len(rules)), strict=True):
        [line] = axes.plot(in_celsius(between), _decades(rule.shift, between), **look)
        handles.append(line)
        labels.append(f"{type(rule.shift).__name__} ± {rule.residual:.2g} decades")
    axes.axhline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    axes.set(xlabel="Temperature [°C]", ylabel="log₁₀ of shift factor $a_T$")
    if style.figure_of(axes).get_figwidth() <= NARROW:
        axes.margins(y=0.5)  # room for the legend
    style.add_heading(axes, "Shift factors")
    style.add_legend(axes, handles, labels, loc="best")
    style.dress(axes)


def _decades(shift: Shift, temperatures: Array) -> Array:
    return np.log10(shift.factor(temperatures))


def _count(fit: Fit) -> str:
    return f"{fit.terms} term{'' if fit.terms == 1 else 's'}"


def _rms(fit: Fit) -> str:
    """Say how large the residuals are, of each column where there are two."""
    parts = {name: 100 * np.sqrt(np.mean(r**2)) for name, r in fit.residuals.items()}
    if len(parts) == 1:
        return f"{100 * fit.residual:.2g} % rms"
    return ", ".join(f"{value:.2g} % ({name})" for name, value in parts.items()) + " rms"


def _unit_of(fit: Fit) -> ReadableUnit:
    si_unit = "1/Pa" if "compliance" in fit.measured else "Pa"
    return readable_unit(si_unit, *fit.measured.values())


def _symbol(fit: Fit) -> str:
    """Return how the fitted quantity is written, by what the data are."""
    if "compliance" in fit.measured:
        return {"deviatoric": "Φ", "shear": "J", "uniaxial": "D"}[fit.data]
    letter = "E" if fit.data == "uniaxial" else "G"
    return letter if "modulus" in fit.measured else f"{letter}′, {letter}″"


def _abscissa(measured: Mapping[str, Array], *, reduced: bool = False) -> str:
    oscillates = "storage" in measured
    label = "Angular frequency" if oscillates else "Time"
    unit = "rad/s" if oscillates else "s"
    if reduced:
        symbol = "$\\omega a_T$" if oscillates else "$t/a_T$"
        return f"{label.lower()} {symbol} [{unit}]"
    return f"{label} [{unit}]"


def _geometric(points: ArrayLike) -> Array:
    positive = np.asarray(points, dtype=np.float64)
    return np.geomspace(positive.min(), positive.max(), 400)


def _is_wide(*columns: Array) -> bool:
    values = np.concatenate(columns)
    return bool(values.max() > _WIDE * values.min())
