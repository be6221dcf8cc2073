"""Largest von Mises stress below the contact, and its depth, over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.compared_runs import require_runs
from viscontact.drawing.content.stress_planes import stress_sections
from viscontact.halfspace.stress_lines import Progress, part_of
from viscontact.plot.histories.time_axis import scale_time
from viscontact.plot.layout import style
from viscontact.plot.layout.error_band import peak_note
from viscontact.plot.layout.ordered_names import styles_of
from viscontact.plot.layout.page import Width, page_width
from viscontact.results.run_axis import require_time
from viscontact.results.snapshots import field_times, take_snapshots
from viscontact.results.stress_source import stress_source
from viscontact.units.formatting import readable_unit

_NAME = "von-mises"
#: Largest number of separate markers.
_MARKED = 40


def von_mises_history(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    progress: Progress | None = None,
) -> Figure:
    """Draw the largest von Mises stress and its depth over time.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s]; by default all that are stored.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    progress : callable, optional
        Called as ``progress(done, total)`` after each depth of the sections.

    Returns
    -------
    matplotlib.figure.Figure
        The largest stress on planes across the contact through its largest pressure, above its
        depth. Time is logarithmic where it is in the run's history.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch, or Poisson's ratio is not known.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> [axes.get_ylabel() for axes in von_mises_history(ds).axes]
    ['Von Mises stress [kPa]', 'Depth [µm]']
    """
    return compare_von_mises({"": results}, times=times, width=width, progress=progress)


def compare_von_mises(
    runs: Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    progress: Progress | None = None,
) -> Figure:
    """Overlay the largest von Mises stresses of several runs, and their depths.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print, with fields stored.
    times : array_like, optional
        Instants [s]; by default all that are stored.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    progress : callable, optional
        Called as ``progress(done, total)`` after each depth of the sections.

    Returns
    -------
    matplotlib.figure.Figure
        As `von_mises_history`, one line per run.

    Raises
    ------
    ValueError
        If there are no runs, or as `von_mises_history` does.

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
    >>> [axes.get_ylabel() for axes in compare_von_mises(runs).axes]
    ['Von Mises stress [kPa]', 'Depth [µm]']
    """
    require_runs(runs, _NAME)
    stresses = [
        _curve(run, times, part_of(progress, index, len(runs)))
        for index, run in enumerate(runs.values())
    ]
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 3.6)
    panels = list(figure.subplots(2, 1, sharex=True))
    time = readable_unit("s", *(history.instants for history in stresses))
    looks = styles_of(list(runs))
    for axes, (part, si_unit, name) in zip(panels, _DRAWN, strict=True):
        curves = [getattr(history, part) for history in stresses]
        unit = readable_unit(si_unit, *curves)
        for history, curve, look in zip(stresses, curves, looks, strict=True):
            dots = {"marker": "o", "markersize": 3.5} if curve.size <= _MARKED else {}
            axes.plot(time(history.instants), unit(curve), clip_on=False, zorder=3, **look, **dots)
        axes.set_ylabel(unit.label(name))
        axes.set_ylim(0.0, 1.1 * max(float(unit(curve.max())) for curve in curves) or 1.0)
        style.dress(axes)
    panels[-1].tick_params(labelbottom=True)
    scale_time(panels, runs, time, [history.instants for history in stresses])
    style.add_heading(panels[0], "largest below the contact")
    style.add_heading(panels[1], "where it is the largest")
    shown = np.concatenate([history.instants for history in stresses])
    style.add_heading(panels[0], peak_note(runs.values(), shown), aside=True)
    if len(runs) > 1:
        style.add_legend_below(figure, panels[0].get_lines(), list(runs), columns=2)
    figure.draw_without_rendering()
    style.arrange_headings(figure)
    return figure


@dataclass(frozen=True, eq=False)
class _StressHistory:
    """Largest stress [Pa] and its depth [m] over time [s]."""

    instants: Floats
    stress: Floats
    depth: Floats


_DRAWN = (("stress", "Pa", "Von Mises stress"), ("depth", "m", "Depth"))


def _curve(
    results: xr.Dataset, times: ArrayLike | None, progress: Progress | None
) -> _StressHistory:
    require_time(results, _NAME)
    chosen = field_times(results, _NAME) if times is None else times
    snapshots = take_snapshots(results, chosen, _NAME)
    sections = stress_sections(stress_source(results), snapshots, progress)
    stress, depth, _ = np.array([section.largest for section in sections]).T
    return _StressHistory(np.array([section.time for section in sections]), stress, depth)
