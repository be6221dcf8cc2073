"""The square of the pressure, whose contours are smooth up to the rim."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.grid import Grid
from viscontact.plot.snapshots import Snapshot
from viscontact.rim import trace_rim


def squared_pressure(snapshot: Snapshot) -> NDArray[np.float64]:
    """Square the pressure and continue it below zero just outside the rim.

    Parameters
    ----------
    snapshot : Snapshot
        Pressure and gap.

    Returns
    -------
    ndarray
        Shape (nx, ny) [Pa²].

    Notes
    -----
    At a smooth rim the pressure starts as the square root of the distance to it, so its square
    is linear there: interpolated between cells it gives smooth contours where the pressure
    itself, which ends between two cells, would draw the staircase of the grid.
    """
    x, y = snapshot.x, snapshot.y
    size = (float(x[1] - x[0]) * x.size, float(y[1] - y[0]) * y.size)
    rim = trace_rim(Grid((x.size, y.size), size), snapshot.pressure > 0, snapshot.gap)
    squared = np.where(rim.contact, snapshot.pressure, 0.0) ** 2
    total, count = np.zeros_like(squared), np.zeros_like(squared)
    # The second pass works on transposed views of the same arrays.
    _continue_outward(squared, rim.contact, rim.along_x, total, count)
    _continue_outward(squared.T, rim.contact.T, rim.along_y.T, total.T, count.T)
    return np.where(rim.contact, squared, total / np.maximum(count, 1))


def _continue_outward(
    squared: NDArray[np.float64],
    contact: NDArray[np.bool_],
    crossings: NDArray[np.float64],
    total: NDArray[np.float64],
    count: NDArray[np.float64],
) -> None:
    """Add to each cell next to the rim what the line through its inner neighbour gives there."""
    i, j = np.nonzero(contact[:-1] != contact[1:])
    inner = np.where(contact[i, j], i, i + 1)
    outer = np.where(contact[i, j], i + 1, i)
    # A rim almost at the inner cell's centre would send the line to infinity.
    share = np.clip(crossings[i, j], 0.1, 1.0)
    np.add.at(total, (outer, j), squared[inner, j] * (1 - 1 / share))
    np.add.at(count, (outer, j), 1)
