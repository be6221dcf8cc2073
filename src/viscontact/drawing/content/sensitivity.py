"""Elasticities of the outputs of a sensitivity, and their scatter over time or speed."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.drawing.content.along_run import steps_grow
from viscontact.drawing.content.panel import (
    FIRST,
    SECOND,
    TEXT,
    Axis,
    Curve,
    Mark,
    Panel,
    ShadedRange,
)
from viscontact.results.run_axis import SPEED, TIME
from viscontact.results.sweep_axes import key_label
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Most bars of a panel.
_MOST = 15
#: Ratio of the last to the first instant from which on the axis is logarithmic.
_LOGARITHMIC = 100.0


def tornado_panels(table: xr.Dataset) -> list[Panel]:
    """Panels of the elasticities of each output, the largest first, with their errors."""
    return [_bars(table.sel(output=name), str(name)) for name in table["output"].values]


def _bars(table: xr.Dataset, output: str) -> Panel:
    sizes = np.abs(table["elasticity"].values)
    order = [n for n in np.argsort(-sizes, kind="stable") if np.isfinite(sizes[n])][:_MOST]
    one = table.isel(input=order)
    values, errors = one["elasticity"].values, one["elasticity_error"].values
    places, falls = np.arange(float(values.size)), values < 0
    number, names = ReadableUnit("", 1.0), tuple(key_label(str(key)) for key in one["input"].values)
    return Panel(
        Axis("Elasticity: % per %", number),
        Axis("", number, texts=names or ("",), is_reversed=True),  # no number if there is no bar
        tuple(
            Curve(values[of], places[of], ink=ink, look="bars", error_x=errors[of])
            for of, ink in ((falls, SECOND), (~falls, FIRST))
            if of.any()
        ),
        marks=(Mark(0.0, ink=TEXT),),
        title=SCALARS[output].label,
    )


def scatter_panels(table: xr.Dataset) -> list[Panel]:
    """Panels of the scatter of each output: band, median and the value of the case."""
    if "band" not in table:
        raise ValueError("scatter_bands: the table has no scatter over time")
    over = TIME if table["band"].dims[-1] == TIME.name else SPEED
    places = table[over.name].values
    if places.size < 2:
        raise ValueError("scatter_bands: needs two instants or more")
    first, last = float(places[places > 0][0]), float(places[-1])
    is_log = last >= _LOGARITHMIC * first and steps_grow(places)
    x = Axis(
        over.name.capitalize(),
        readable_unit(over.unit, places),
        (float(places[0]), last),
        ("time" if over is TIME else "log") if is_log else "linear",
        first,
    )
    panels = []
    for name in map(str, table["output"].values):
        one = table.sel(output=name)
        low, middle, high = one["band"].values
        y = Axis.of(SCALARS[name].label, SCALARS[name].units, one["band"].values)
        case = Curve(places, one["nominal"].values, "case", TEXT, "dashed")
        curves = (Curve(places, middle, "median"), case)
        panels.append(Panel(x, y, curves, (ShadedRange(places, low, high, "5 to 95 %"),)))
    return panels
