"""Approach, tilt, area and pressure against time (the paper's Figs. 17, 18 and 19)."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import replace

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.along_run import within_span
from viscontact.drawing.content.compared_runs import runs_of
from viscontact.drawing.content.history import drawn_scalars, history_panel, needed_variables
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.error_band import ErrorBand, legend_entries
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, grid_of_panels
from viscontact.results.variables import MESH_DEPENDENT

_NAME = "history"

#: Letters of the note on events on an inch.
_LETTERS_AN_INCH = 17
#: Letters of a label beside a panel.
_LONGEST_LABEL = 27


def history(
    results: xr.Dataset | Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw contact area, approach, tilts and peak pressure against time.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`; several results by the names to
        print.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One panel a quantity. Force, tilts and the line load of a line contact have one only where
        they change. Time is logarithmic where the run's steps are and the load is held nearly from
        the start. Bands are the errors that the result states. A peak pressure that depends on
        the mesh has no curve; its panel says so.

    Raises
    ------
    ValueError
        If fewer than two steps lie in the span.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> [axes.get_ylabel() for axes in history(ds).axes][:2]
    ['Contact area [mm²]', 'Approach [µm]']
    """
    shown = {
        name: within_span(run, needed_variables(run), times, _NAME, name)
        for name, run in runs_of(results, _NAME).items()
    }
    return _figure(shown, drawn_scalars(shown), width)


def compare_histories(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay the histories of several runs.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One panel per quantity, one line per run, and a band around it where its error is known.
        A peak pressure that depends on the mesh has no line; its panel says so.

    Raises
    ------
    ValueError
        If there are no runs, or one has fewer than two steps in the span.

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
    >>> figure = compare_histories(runs)
    >>> figure.axes[0].get_ylabel()
    'Contact area [mm²]'
    """
    return history(runs, times=times, width=width)


def history_with_load(results: xr.Dataset) -> Figure:
    """Draw the history of a run, the force also where it is constant."""
    shown = {"": within_span(results, needed_variables(results), None, _NAME, "")}
    others = [name for name in drawn_scalars(shown) if name != "force"]
    return _figure(shown, ["force", *others], None)


def _figure(runs: Mapping[str, xr.Dataset], names: Sequence[str], width: Width | None) -> Figure:
    figure, axes = grid_of_panels(len(names), page_width(width, style.TWO_COLUMNS))
    panels = [history_panel(runs, name) for name in names]
    bands = draw_histories(axes, panels)
    _note_events(figure, panels[0])
    _add_key(figure, axes, list(runs), bands)
    return figure


def draw_histories(axes: Sequence[Axes], panels: Sequence[Panel]) -> list[ErrorBand]:
    """Draw panels of histories, and return their error bands."""
    bands: list[ErrorBand] = []
    for each, panel in zip(axes, panels, strict=True):
        # The note stands apart from the quantity that it is about.
        note = panel.note.replace(MESH_DEPENDENT, f"peak {MESH_DEPENDENT}").replace(": ", ":\n")
        bands += draw_panel(each, replace(panel, note=note))
        each.set_ylabel(_in_two_lines(panel.y.label))
    return bands


def _in_two_lines(label: str) -> str:
    """Label that is longer than the axis of a panel, divided at the space next to its middle."""
    spaces = [at for at, letter in enumerate(label) if letter == " "]
    if len(label) <= _LONGEST_LABEL or not spaces:
        return label
    at = min(spaces, key=lambda each: abs(each - len(label) / 2))
    return f"{label[:at]}\n{label[at + 1 :]}"


def _note_events(figure: Figure, panel: Panel) -> None:
    """Write the events that are marked below the panels."""
    if panel.marks:
        text = "Dotted: " + "; ".join(mark.text for mark in panel.marks)
        letters = int(_LETTERS_AN_INCH * figure.get_figwidth())
        note = "\n".join(textwrap.wrap(text, letters))
        style.add_height_of_legend(figure, note.count("\n") + 1)
        figure.supxlabel(note, fontsize=style.TICK_SIZE, color=style.FAINT)


def _add_key(figure: Figure, panels: list[Axes], names: list[str], bands: list[ErrorBand]) -> None:
    """Legend of several runs above the panels, and of error bands, below those of several runs."""
    entries = legend_entries(panels[0].get_lines(), names, bands)
    count = len(names) if len(names) > 1 else 0
    if count:
        columns = style.columns_that_fit(figure, names, 4)
        style.add_height_of_legend(figure, -(-count // columns))
        keys = zip(*style.by_rows(entries[:count], columns), strict=True)
        style.add_legend(figure, *keys, loc="outside upper center", ncols=columns, handlelength=2.4)
    if entries[count:]:
        place = "outside lower center" if count else "outside upper right"
        style.add_legend(figure, *zip(*entries[count:], strict=True), loc=place, handlelength=2.4)
