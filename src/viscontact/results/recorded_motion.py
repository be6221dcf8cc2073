"""Motion of the body in a result: its axis, and its direction at an instant or a speed."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.results.run_axis import run_axis


def motion_axis(results: xr.Dataset) -> Literal["x", "y"] | None:
    """Axis along which the body of a result moves farther, None for a standing contact."""
    if not run_axis(results).is_history:
        return "x" if results.attrs.get("along") == "x" else "y"
    if "position_x" not in results or "time" not in results["position_x"].dims:
        return None
    along_x, along_y = (float(np.ptp(results[f"position_{axis}"].values)) for axis in "xy")
    if max(along_x, along_y) == 0:
        return None
    return "x" if along_x > along_y else "y"


def direction_at(results: xr.Dataset, time: float) -> tuple[float, float] | None:
    """Direction (x, y) in which the body arrives at an instant [s], of length 1; None at rest."""
    # At the first instant it is that in which it leaves; in steady motion that of the motion.
    axis = motion_axis(results)
    if axis is None:
        return None
    if not run_axis(results).is_history:
        return (1.0, 0.0) if axis == "x" else (0.0, 1.0)
    index = max(1, int(np.abs(results["time"].values - time).argmin()))
    ways = [float(np.diff(results[f"position_{axis}"].values)[index - 1]) for axis in "xy"]
    length = math.hypot(*ways)
    return (ways[0] / length, ways[1] / length) if length > 0 else None


def body_axis_at(results: xr.Dataset, time: float) -> tuple[float, float]:
    """Position (x, y) of the body's axis at an instant [m]; the origin of a standing contact."""
    if "position_x" not in results:
        return 0.0, 0.0
    index = int(np.abs(results["time"].values - time).argmin())
    x, y = (float(results[f"position_{axis}"][index]) for axis in "xy")
    return x, y


def contact_edges(positions: Floats, touched: Bools, way: float) -> tuple[float, float] | None:
    """Leading and trailing edge of a contact [m] on a line through it; None without.

    The sign of `way` is that of the velocity along the line; there are no edges if it is 0.
    """
    inside = np.flatnonzero(touched)
    if way == 0 or inside.size == 0:
        return None
    first, last = inside[[0, -1]]
    # The border of the grid is half a cell beyond the last centre.
    before, after = (2 * at[0] - at[1] for at in (positions[:2], positions[:-3:-1]))
    wide = np.concatenate([[before], positions, [after]])
    low, high = (float(wide[at] + wide[at + 1]) / 2 for at in (first, last + 1))
    return (high, low) if way > 0 else (low, high)
