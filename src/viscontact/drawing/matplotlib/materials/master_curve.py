"""Figure of a master curve: sets at several temperatures, shift factors, reduced curve."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from viscontact.drawing.content.series_fit import master_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.units.temperatures import in_celsius

if TYPE_CHECKING:
    from viscontact.bodies.series_fits import Fit
    from viscontact.identification import MasterCurve, ShiftFit


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
    >>> figure = master_curve(build_master_curve(sets, 293.15, vertical="none"))
    >>> [axes.get_ylabel() for axes in figure.axes][:2]
    ['Creep compliance [1/GPa]', 'log₁₀ of shift factor $a_T$']
    """
    wide = page_width(width, style.TWO_COLUMNS)
    is_wide = wide > NARROW
    figure = style.new_figure(wide, 5.4 if is_wide else 7.4)
    panels = figure.subplot_mosaic("AB;CC" if is_wide else "A;B;C")
    _, shifts, master = axes = [panels[name] for name in "ABC"]
    drawn = master_panels(curve, fit, rules)
    for each, panel in zip(axes, drawn, strict=True):
        draw_panel(each, panel)
        if not is_wide and each is master:
            style.add_heading(each, panel.title.replace(", ", "\n", 1))
    if not is_wide:
        shifts.margins(y=0.5)  # room for the legend
    style.add_legend(shifts, *named_keys(drawn[1].curves), loc="best")
    celsius = in_celsius(curve.temperatures)
    norm = Normalize(celsius.min(), max(celsius.max(), celsius.min() + 1.0))
    bar = figure.colorbar(ScalarMappable(norm, style.TEMPERATURES), ax=axes, aspect=45)
    bar.set_label("Temperature [°C]", size=style.LABEL_SIZE, color=style.INK)
    bar.ax.tick_params(labelsize=style.TICK_SIZE, width=style.THIN_LINE, colors=style.INK)
    bar.outline.set_visible(False)
    return figure
