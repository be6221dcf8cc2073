"""Curves of a material over time and frequency, and the points they are based on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.laws import Law
from viscontact.bodies.materials.library import Points
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.units.formatting import ReadableUnit, readable_unit

_NAME = "material_curves"
_SAMPLES = 241
_SHADE = "#eef2f6"
_DEPTH = 1e-6


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
    first, last = times
    if not (0 < first < last < np.inf):
        raise ValueError(f"{_NAME}: times must be two, above 0 s and increasing, got {times!r} s")
    given = tuple(points)
    stiff_at_once = float(law(0.0)) > 0
    count, wide = 3 if stiff_at_once else 2, page_width(width, style.TWO_COLUMNS)
    rows = count if wide <= NARROW else 1
    figure = style.new_figure(wide, 2.3 * rows if rows > 1 else 2.8)
    panels = list(figure.subplots(rows, count // rows).flat)
    instants = np.geomspace(first, last, _SAMPLES)
    solid = (instants[0], instants[-1]) if measured is None else measured
    _draw_time(panels[0], "creep_compliance", instants, law(instants), solid, given)
    if stiff_at_once:
        modulus = law.relaxation(instants)
        _draw_time(panels[1], "relaxation_modulus", instants, modulus, solid, given)
    _draw_oscillation(panels[-1], law, instants, solid, given)
    for axes in panels:
        if measured is not None:
            _shade(axes, solid, frequency=axes is panels[-1])
        style.dress(axes)
    if title:
        figure.suptitle(title, fontsize=style.LABEL_SIZE, color=style.INK)
    return figure


_LABELS = {
    "creep_compliance": ("Creep compliance Φ", "1/Pa"),
    "relaxation_modulus": ("Relaxation modulus G", "Pa"),
}


def _draw_time(
    axes: Axes,
    quantity: str,
    times: Floats,
    values: Floats,
    solid: tuple[float, float],
    points: tuple[Points, ...],
) -> None:
    label, si_unit = _LABELS[quantity]
    unit = _middle_unit(si_unit, values)
    _line(axes, times, unit(values), solid, color=style.LINE)
    _markers(axes, points, quantity, unit, color=style.LINE)
    axes.set(xlabel="Time [s]", ylabel=unit.label(label))
    _log_axes(axes, times)


def _draw_oscillation(
    axes: Axes,
    law: Law,
    times: Floats,
    solid: tuple[float, float],
    points: tuple[Points, ...],
) -> None:
    omega = 1.0 / times[::-1]
    modulus = law.complex_modulus(omega)
    within = (1.0 / solid[1], 1.0 / solid[0] if solid[0] else np.inf)
    unit = _middle_unit("Pa", modulus.real)
    handles = []
    for part, quantity, colour in (
        (modulus.real, "storage_modulus", style.LINE),
        (modulus.imag, "loss_modulus", "#D55E00"),
    ):
        handles.append(_line(axes, omega, unit(part), within, color=colour))
        _markers(axes, points, quantity, unit, color=colour)
    style.add_legend(axes, handles, ["storage G′", "loss G″"], loc="best")
    axes.set(xlabel="Angular frequency [rad/s]", ylabel=unit.label("Modulus"))
    _log_axes(axes, omega)


def _line(
    axes: Axes,
    at: Floats,
    values: Floats,
    solid: tuple[float, float],
    **how: Any,
) -> Any:
    """Draw a curve dashed, and solid within its range; return the solid line."""
    inside = (at >= solid[0] * (1 - 1e-9)) & (at <= solid[1] * (1 + 1e-9))
    shown = np.where(_continuation(_worth_showing(values), inside), values, np.nan)
    axes.plot(at, shown, linewidth=style.LINE_WIDTH, linestyle=(0, (3, 2)), alpha=0.7, **how)
    return axes.plot(at[inside], shown[inside], linewidth=style.LINE_WIDTH, **how)[0]


def _markers(
    axes: Axes, points: tuple[Points, ...], quantity: str, unit: ReadableUnit, *, color: str
) -> None:
    for number, each in enumerate(p for p in points if p.quantity == quantity):
        axes.plot(
            each.at,
            unit(each.values),
            linestyle="none",
            marker=style.MARKERS[number],
            markersize=3.6,
            markerfacecolor="white",
            markeredgecolor=color,
            markeredgewidth=0.9,
        )


def _worth_showing(values: Floats) -> Bools:
    # What a liquid has left after ten of its longest times, or an elastic body as its loss, is
    # nothing: it must not press the rest of the curve together.
    return np.asarray(values > _DEPTH * values.max(initial=0.0))


def _continuation(shown: Bools, inside: Bools) -> Bools:
    """Mask of the curve beyond its range, up to its first zero."""
    within = np.flatnonzero(inside)
    if not within.size:
        return shown
    first, last = int(within[0]), int(within[-1])
    shown = shown.copy()
    shown[first::-1] = np.logical_and.accumulate(shown[first::-1])
    shown[last:] = np.logical_and.accumulate(shown[last:])
    return shown


def _shade(axes: Axes, measured: tuple[float, float], *, frequency: bool) -> None:
    low, high = axes.get_xlim()
    first, last = measured
    if frequency:
        first, last = 1.0 / last, 1.0 / first if first else high
    axes.axvspan(max(first, low), min(last, high), color=_SHADE, zorder=0, linewidth=0)
    if frequency:  # once is enough
        style.add_heading(axes, "shaded: what the constants rest on", aside=True)


def _log_axes(axes: Axes, at: Floats) -> None:
    axes.set(xscale="log", yscale="log", xlim=(at[0], at[-1]))
    low, high = axes.get_ylim()
    # Within one decade a logarithmic axis has hardly a tick to read, within two few.
    if high < 8 * low:
        axes.set_yscale("linear")
    elif high < 120 * low:
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    if axes.get_yscale() == "log":
        axes.yaxis.set_minor_formatter(NullFormatter())


def _middle_unit(si_unit: str, values: Floats) -> ReadableUnit:
    """Unit in which the middle of a logarithmic axis is readable."""
    good = values[_worth_showing(values)]
    return readable_unit(si_unit, float(np.exp(np.log(good).mean())) if good.size else 0.0)
