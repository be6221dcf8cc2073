"""Heat balances of a rolling body: power over temperature, temperature over speed and time."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.content.heat_balance import balance_panel, heating_panel, temperature_panel
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys

#: Height over width of a figure.
_SHAPE = 0.7


def heat_balance(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the power at some speeds and the cooling over temperature; balances are where they meet.

    Parameters
    ----------
    table : xarray.Dataset
        `RollingTemperature.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A curve for each of at most five speeds where the power is known, the cooling (dashed), full
        markers at stable balances and hollow ones at unstable balances.

    Examples
    --------
    >>> figure = heat_balance(_example())
    >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    ('Temperature [°C]', 'Power [W]')
    """
    return _drawn(balance_panel(table), width)


def rolling_temperature(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the temperatures of all balances over speed, with the speed of thermal runaway.

    Parameters
    ----------
    table : xarray.Dataset
        `RollingTemperature.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Stable balances as a line with full markers, unstable ones dashed with hollow markers, the
        hottest place of the cover as crosses, and the runaway as a dotted line.

    Examples
    --------
    >>> figure = rolling_temperature(_example())
    >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    ('Speed [m/s]', 'Temperature [°C]')
    """
    return _drawn(temperature_panel(table), width)


def rolling_heating(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the temperature over time from the start of the motion, at some speeds.

    Parameters
    ----------
    table : xarray.Dataset
        `RollingTemperature.table` with heat capacity and density.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The mean temperature of at most five speeds, and the hottest place of the cover (dotted); a
        curve ends where the power is not known.

    Raises
    ------
    ValueError
        If the table has no heating over time, or none is known.

    Examples
    --------
    >>> rolling_heating(_example()).axes[0].get_xlabel()
    'Time [s]'
    """
    if "time" not in table.dims:
        raise ValueError(
            "rolling_heating: the table has no heating over time; give heat_capacity= and "
            "density= to rolling_temperature"
        )
    return _drawn(heating_panel(table), width)


def _drawn(panel: Panel, width: Width | None) -> Figure:
    wide = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(wide, _SHAPE * wide)
    axes = figure.subplots()
    draw_panel(axes, panel)
    axes.tick_params(which="both", labelsize=style.TICK_SIZE, colors=style.INK)
    handles, labels = named_keys(panel.curves)
    if labels:
        style.add_legend_below(figure, handles, labels)
    return figure


def _example() -> xr.Dataset:
    """Table with two balances."""
    data = {
        "temperature": (("speed", "root"), [[300.0], [310.0]]),
        "stable": (("speed", "root"), [[True], [True]]),
        "power": (("speed", "root"), [[10.0], [20.0]]),
        "power_at": (("speed", "at_temperature"), [[10.0, 10.0], [20.0, 20.0]]),
        "cooling_at": ("at_temperature", [0.0, 20.0]),
        "speed_at": ("at_temperature", [1.0, 2.0]),
        "stable_at": ("at_temperature", [True, True]),
        "heating_temperature": (("speed", "time"), [[290.0, 300.0], [290.0, 310.0]]),
    }
    coords = {"speed": [1.0, 2.0], "at_temperature": [290.0, 310.0], "time": [0.0, 9.0]}
    return xr.Dataset(data, coords, {"idle_temperature": 290.0, "runaway_speed": float("nan")})
