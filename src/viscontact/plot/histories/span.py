"""The part of a run that is drawn."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.units.formatting import format_quantity


def within_span(
    run: xr.Dataset, variables: Iterable[str], times: ArrayLike | None, figure: str, name: str
) -> xr.Dataset:
    """Cut variables over time to a span.

    Parameters
    ----------
    run : xarray.Dataset
        A result.
    variables : iterable of str
        What is drawn.
    times : array_like or None
        Instants whose least and largest bound the span [s]; None for all of the run.
    figure, name : str
        The figure and the run, for messages.

    Returns
    -------
    xarray.Dataset
        Two instants or more.

    Raises
    ------
    ValueError
        If fewer than two steps lie in the span, or it is no span.

    Examples
    --------
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
