"""Trials of a design: its goal, its trade-offs, and the profiles that it compares."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.content.design import profile_panel, trade_off_panels, trial_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.drawing.matplotlib.sweeps.key_axis import label_key

#: Panels of parameters in a row, and heights of a row, a trade-off and profiles [inch].
_COLUMNS, _HEIGHT, _TRADE_OFF, _PROFILES = 2, 2.6, 3.4, 3.2
#: Width of a letter of a label [inch].
_LETTER = 0.068


def trials(table: xr.Dataset, *, scalar: str | None = None, width: Width | None = None) -> Figure:
    """Draw a scalar of a design over each of its parameters.

    Parameters
    ----------
    table : xarray.Dataset
        Trials of a design, `DesignResult.table`.
    scalar : str, optional
        Name of a goal or of the scalar of a constraint; by default the first goal, or, if that is a
        parameter, what the first constraint bounds.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each parameter, with a line at each bound of the scalar: full points with error
        bars are feasible trials on the cells of the case, pale ones those on coarse cells, crosses
        trials that are not feasible, and the square is the best one.

    Examples
    --------
    >>> data = {"force": ("trial", [3.0, 2.0]), "force_error": ("trial", [0.1, 0.1])}
    >>> data |= {"feasible": ("trial", [True, True]), "level": ("trial", ["coarse", "case"])}
    >>> coords = {"load.x": ("trial", [1.0, 2.0], {"units": "m"})}
    >>> axes = trials(xr.Dataset(data, coords, {"goal": "force", "best": 1})).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('Load x [m]', 'Force [N]')
    """
    drawn = trial_panels(table, scalar)
    columns = min(_COLUMNS, len(drawn))
    rows = -(-len(drawn) // columns)
    across = page_width(width, style.TWO_COLUMNS if columns > 1 else style.ONE_COLUMN)
    figure = style.new_figure(across, _HEIGHT * rows + 0.4)
    panels = list(figure.subplots(rows, columns, squeeze=False, sharey=True).flat)
    for unused in panels[len(drawn) :]:
        unused.remove()
    for number, (panel, axes) in enumerate(zip(drawn, panels, strict=False)):
        draw_panel(axes, panel)
        label_key(axes, panel.x, int(across / columns / _LETTER))
        if number % columns:
            axes.set_ylabel("")
    style.add_legend_below(figure, *named_keys(drawn[0].curves), columns=4)
    return figure


def trade_off(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the trials of a design with several goals: each pair of its scalars.

    Parameters
    ----------
    table : xarray.Dataset
        Trials of a design with two goals or more, `DesignResult.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each pair: full points with error bars, joined by a line if there are two
        scalars, are the trials that are not dominated, pale points the other feasible ones on the
        cells of the case, and the square is the compromise.

    Examples
    --------
    >>> data = {name: ("trial", [1.0, 2.0, 3.0]) for name in ("force_error", "approach_error")}
    >>> data |= {"force": ("trial", [3.0, 1.0, 4.0]), "approach": ("trial", [1.0, 3.0, 4.0])}
    >>> data |= {"feasible": ("trial", [True] * 3), "on_front": ("trial", [True, True, False])}
    >>> data |= {"level": ("trial", ["case"] * 3)}
    >>> axes = trade_off(xr.Dataset(data, attrs={"goal": "force approach", "best": 0})).axes[0]
    >>> axes.get_xlabel(), axes.lines[1].get_xdata().tolist()
    ('Force [N]', [1.0, 3.0])
    """
    drawn = trade_off_panels(table)
    across = page_width(width, style.TWO_COLUMNS if len(drawn) > 1 else style.ONE_COLUMN)
    figure = style.new_figure(across, _TRADE_OFF)
    panels = figure.subplots(1, len(drawn), squeeze=False)[0]
    for panel, axes in zip(drawn, panels, strict=True):
        draw_panel(axes, panel)
    style.add_legend_below(figure, *named_keys(drawn[0].curves), columns=3)
    return figure


def profiles(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the drop curves of a free profile and of the named ones.

    Parameters
    ----------
    table : xarray.Dataset
        Profiles of a design, `ProfileDesign.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Drop over the position along the roller, downwards. What drops steeply next to the ends is
        cut off.

    Examples
    --------
    >>> data = {"drop": (("profile", "x"), [[1e-6, 0.0, 1e-6]])}
    >>> table = xr.Dataset(data, {"profile": ["free"], "x": [-1e-2, 0.0, 1e-2]})
    >>> axes = profiles(table).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel(), bool(axes.yaxis_inverted())
    ('x [mm]', 'Drop [µm]', True)
    """
    figure = style.new_figure(page_width(width, style.TWO_COLUMNS), _PROFILES)
    axes = figure.subplots()
    panel = profile_panel(table)
    draw_panel(axes, panel)
    style.add_legend_below(figure, *named_keys(panel.curves), columns=4)
    return figure
