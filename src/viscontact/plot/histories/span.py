"""Time span of a figure."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.units.formatting import format_quantity


def within_span(
    run: xr.Dataset, variables: Iterable[str], times: ArrayLike | None, figure: str, name: str
) -> xr.Dataset:
    """Cut variables over time to a span [s], with two instants or more; None for the whole run.

    >>> run = xr.Dataset({"force": ("time", [0.0, 1.0, 2.0])}, coords={"time": [0.0, 1.0, 2.0]})
    >>> within_span(run, ["force"], [0.0, 1.5], "history", "").force.values.tolist()
    [0.0, 1.0]
    """
    span = run["time"].values if times is None else np.atleast_1d(np.asarray(times, dtype=float))
    if span.size == 0 or not np.all(np.isfinite(span)):
        raise ValueError(f"{figure}: times must be finite numbers of seconds, got {times!r}")
    inside = (run["time"] >= span.min()) & (run["time"] <= span.max())
    shown = run[list(variables)].isel(time=np.flatnonzero(inside))
    if shown.sizes["time"] < 2:
        raise ValueError(
            f"{figure}: needs at least two steps to draw a line, got {shown.sizes['time']} between "
            f"{format_quantity(span.min(), 's')} and "
            f"{format_quantity(span.max(), 's')}{f' in {name}' if name else ''}"
        )
    return shown
