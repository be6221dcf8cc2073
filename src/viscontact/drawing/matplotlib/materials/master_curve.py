"""Figure of a master curve: sets at several temperatures, shift factors, reduced curve."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure

from viscontact.backend.arrays import Floats
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.materials.fitted import (
    LABELS,
    MARKER_SIZE,
    MARKERS,
    abscissa,
    count_of_terms,
    geometric,
    misfit_note,
    residual_note,
    spans_decades,
)
from viscontact.identification import Fit, MasterCurve, ShiftFit
from viscontact.units.formatting import ReadableUnit, readable_unit
from viscontact.units.temperatures import in_celsius


def master_curve(
    curve: MasterCurve,
    *,
    fit: Fit | None = None,
    rules: Sequence[ShiftFit] = (),
    width: Width | None = None,
) -> Figure:
    """Draw sets at several temperatures, their shift factors and the master curve.

    Parameters
    ----------
    curve : MasterCurve
        From `viscontact.build_master_curve`.
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
    # Without the palest end of the map, which is hard to see on white.
    shades = LinearSegmentedColormap.from_list("sets", colormaps["plasma"](np.linspace(0, 0.85)))
    norm = Normalize(celsius.min(), max(celsius.max(), celsius.min() + 1.0))
    unit = readable_unit(
        "1/Pa" if "compliance" in curve.measured else "Pa", *curve.measured.values()
    )
    _draw_sets(curve, panels["sets"], panels["master"], unit, shades(norm(celsius)))
    if fit is not None:
        along = geometric(curve.points)
        for values in fit.curve(along).values():
            panels["master"].plot(along, unit(values), color=style.INK, linewidth=1.0)
    _dress_sets(curve, panels["sets"], panels["master"], unit, fit)
    _draw_shifts(curve, panels["shifts"], rules)
    bar = figure.colorbar(ScalarMappable(norm, shades), ax=list(panels.values()), aspect=45)
    bar.set_label("Temperature [°C]", size=style.LABEL_SIZE, color=style.INK)
    bar.ax.tick_params(labelsize=style.TICK_SIZE, width=style.THIN_LINE, colors=style.INK)
    bar.outline.set_visible(False)
    return figure


def _draw_sets(
    curve: MasterCurve,
    sets: Axes,
    master: Axes,
    unit: ReadableUnit,
    colours: Floats,
) -> None:
    """Draw the points of each set, as measured and reduced, in its colour."""
    for isotherm, reduced, colour in zip(
        curve.isotherms, curve.reduced_points, colours, strict=True
    ):
        later = isotherm.points > 0  # time 0 is not on a logarithmic axis
        for name, values in isotherm.measured.items():
            look: dict[str, Any] = {
                "marker": MARKERS[name],
                "markersize": MARKER_SIZE - 0.6,
                "color": colour,
            }
            if name == "loss":
                look |= {"markerfacecolor": "none", "markeredgewidth": 0.7}
            shown = unit(values[later])
            sets.plot(isotherm.points[later], shown, linewidth=0.6, **look)
            master.plot(reduced[later], shown, linestyle="none", **look)


def _dress_sets(
    curve: MasterCurve, sets: Axes, master: Axes, unit: ReadableUnit, fit: Fit | None
) -> None:
    names = list(curve.measured)
    quantity = LABELS[names[0]] if len(names) == 1 else "Modulus"
    for axes in (sets, master):
        axes.set_xscale("log")
        if spans_decades(*curve.measured.values()):
            axes.set_yscale("log")
        axes.set_ylabel(unit.label(quantity))
        style.dress(axes)
    sets.set_xlabel(abscissa(curve.measured))
    master.set_xlabel("Reduced " + abscissa(curve.measured, reduced=True))
    # Markers are explained in the heading: a legend would cover the sets, which fill their panel.
    markers = ": ● storage, □ loss" if len(names) > 1 else ""
    style.add_heading(sets, f"As measured{markers}")
    at = f"{in_celsius(curve.reference_temperature):.4g} °C"
    apart = ", " if style.figure_of(master).get_figwidth() > NARROW else "\n"
    note = f"{apart}{count_of_terms(fit)}, residual {residual_note(fit)}" if fit else ""
    missed = f"\n{misfit_note(fit)}" if fit and fit.misfit else ""
    style.add_heading(master, f"Master curve at {at}{note}{missed}")


def _draw_shifts(curve: MasterCurve, axes: Axes, rules: Sequence[ShiftFit]) -> None:
    celsius = in_celsius(curve.temperatures)
    axes.plot(
        celsius,
        np.log10(curve.factors),
        marker="o",
        markersize=MARKER_SIZE,
        markerfacecolor="none",
        color=style.INK,
        linestyle="none",
    )
    handles, labels = list(axes.get_lines()), ["found" if curve.mismatches is not None else "given"]
    between = np.linspace(curve.temperatures[0], curve.temperatures[-1], 200)
    for rule, look in zip(rules, style.run_styles(len(rules)), strict=True):
        [line] = axes.plot(in_celsius(between), np.log10(rule.shift.factor(between)), **look)
        handles.append(line)
        labels.append(f"{type(rule.shift).__name__} ± {rule.residual:.2g} decades")
    axes.axhline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    axes.set(xlabel="Temperature [°C]", ylabel="log₁₀ of shift factor $a_T$")
    if style.figure_of(axes).get_figwidth() <= NARROW:
        axes.margins(y=0.5)  # room for the legend
    style.add_heading(axes, "Shift factors")
    style.add_legend(axes, handles, labels, loc="best")
    style.dress(axes)
