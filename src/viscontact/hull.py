"""Where a force can act: within the hull of what can touch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from viscontact.grid import Grid


def refuse_outside(
    solid: NDArray[np.bool_], grid: Grid, where: tuple[float | None, float | None], time: float
) -> None:
    """Refuse a force that no pressure can balance, which is never negative.

    Parameters
    ----------
    solid : ndarray of bool, shape (nx, ny)
        Cells that can touch.
    grid : Grid
        The cells.
    where : tuple of float or None
        Eccentricities of the force along x and y; None along an axis whose tilt is given [m].
    time : float
        Instant, for the message [s].

    Raises
    ------
    ValueError
        If the force acts outside the hull of those cells.

    Examples
    --------
    >>> grid = Grid((4, 4), (0.04, 0.04))
    >>> solid = np.ones((4, 4), dtype=bool)  # centres reach to 0.015 m
    >>> refuse_outside(solid, grid, (0.01, None), 0.0)
    >>> try:
    ...     refuse_outside(solid, grid, (0.02, None), 0.0)
    ... except ValueError as error:
    ...     print(str(error)[:48])
    load.eccentricity_x: the force acts at 0.02 m at
    """
    for axis, eccentricity in enumerate(where):
        if eccentricity is None:
            continue
        centres = (grid.x, grid.y)[axis][solid.any(axis=1 - axis)]
        if not centres[0] <= eccentricity <= centres[-1]:
            name = "xy"[axis]
            raise ValueError(
                f"load.eccentricity_{name}: the force acts at {eccentricity:.6g} m at "
                f"t = {time:g} s, outside what can touch ({centres[0]:.6g} m to "
                f"{centres[-1]:.6g} m along {name}): "
                "no pressure can balance it; move the force in, or enlarge the body or the grid"
            )
    x, y = where
    if x is not None and y is not None and (x or y) and not _in_hull(solid, grid, x, y):
        raise ValueError(
            f"load.eccentricity_x: the force acts at ({x:.6g} m, {y:.6g} m) at t = {time:g} s, "
            "outside the hull of what can touch: no pressure can balance it; move the force in"
        )


def _in_hull(solid: NDArray[np.bool_], grid: Grid, x: float, y: float) -> bool:
    rows = np.flatnonzero(solid.any(axis=1))
    first = solid[rows].argmax(axis=1)
    last = solid.shape[1] - 1 - solid[rows, ::-1].argmax(axis=1)
    along_x, along_y = np.tile(grid.x[rows], 2), grid.y[np.concatenate([first, last])]
    try:
        hull = ConvexHull(np.column_stack([along_x, along_y]) / np.array(grid.size))
    except QhullError:
        return True  # a line of cells: the check along each axis has been made
    offset = hull.equations[:, :2] @ (np.array([x, y]) / np.array(grid.size)) + hull.equations[:, 2]
    return bool((offset <= 1e-12).all())
