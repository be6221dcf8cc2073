"""Motion of the body in a result over time: its axis, and its direction at an instant."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import xarray as xr


def motion_axis(results: xr.Dataset) -> Literal["x", "y"] | None:
    """Axis along which the body of a result moves farther, None for a standing contact.

    >>> moved = xr.Dataset({"position_x": ("time", [0.0, 0.0]), "position_y": ("time", [0.0, 1.0])})
    >>> motion_axis(moved), motion_axis(xr.Dataset())
    ('y', None)
    """
    if "position_x" not in results or "time" not in results["position_x"].dims:
        return None
    along_x, along_y = (float(np.ptp(results[f"position_{axis}"].values)) for axis in "xy")
    if max(along_x, along_y) == 0:
        return None
    return "x" if along_x > along_y else "y"


def direction_at(results: xr.Dataset, time: float) -> tuple[float, float] | None:
    """Direction (x, y) in which the body arrives at an instant [s], of length 1; None at rest.

    At the first instant it is that in which it leaves.

    >>> moved = xr.Dataset(
    ...     {"position_x": ("time", [0.0, 0.0, 0.0]), "position_y": ("time", [0.0, -2.0, -2.0])},
    ...     {"time": [0.0, 1.0, 2.0]},
    ... )
    >>> [direction_at(moved, time) for time in (0.0, 1.0, 2.0)]
    [(0.0, -1.0), (0.0, -1.0), None]
    """
    if motion_axis(results) is None:
        return None
    index = max(1, int(np.abs(results["time"].values - time).argmin()))
    ways = [float(np.diff(results[f"position_{axis}"].values)[index - 1]) for axis in "xy"]
    length = math.hypot(*ways)
    return (ways[0] / length, ways[1] / length) if length > 0 else None
