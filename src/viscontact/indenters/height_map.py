"""A measured or generated surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.indenters.indenter import Indenter
from viscontact.indenters.lengths import positions

#: Squares of gaps are still numbers that the solver can compare [m].
_HIGHEST = 1e30


@dataclass(frozen=True, eq=False, init=False)
class HeightMap(Indenter):
    """A surface given by heights on a rectangular mesh, peaks touching first.

    Parameters
    ----------
    x, y : array_like
        Coordinates of the mesh lines, strictly increasing, shapes (nx,) and (ny,), at least
        2 each; the steps need not be even [m].
    height : array_like
        Heights as measured with the surface facing the instrument, shape (nx, ny), from any
        reference [m].

    Raises
    ------
    ValueError
        If the arrays do not fit together, a coordinate does not increase, or a value is
        missing or infinite.

    Notes
    -----
    The gap is max(height) - height, bilinear between the mesh points and +inf outside the
    map. Only the values at the positions asked for are used: on a grid coarser than the
    map, details between the grid points are missed, not averaged. The arrays are copied and
    made read-only.

    Examples
    --------
    >>> ridge = HeightMap(x=[-1.0, 0.0, 1.0], y=[0.0, 1.0], height=[[0, 0], [2, 2], [0, 0]])
    >>> ridge.gap([0.0, 0.5, 2.0], 0.25).tolist()
    [0.0, 1.0, inf]
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    height: NDArray[np.float64]

    def __init__(self, x: ArrayLike, y: ArrayLike, height: ArrayLike) -> None:
        # Written out, so that lists are welcome and arrays are what comes back.
        object.__setattr__(self, "x", _mesh_lines("x", x))
        object.__setattr__(self, "y", _mesh_lines("y", y))
        object.__setattr__(self, "height", _heights(height, (self.x.size, self.y.size)))

    def gap(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Return max(height) - height at x, y, +inf outside the map; see `Indenter.gap`."""
        x, y = positions(x, y)
        i, along_x, within_x = _locate(self.x, x)
        j, along_y, within_y = _locate(self.y, y)
        # Depths are not negative and neither are the weights, so neither is the gap.
        depth = self.height.max() - self.height
        near = depth[i, j] * (1 - along_y) + depth[i, j + 1] * along_y
        far = depth[i + 1, j] * (1 - along_y) + depth[i + 1, j + 1] * along_y
        return np.where(within_x & within_y, near * (1 - along_x) + far * along_x, np.inf)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, HeightMap):
            return NotImplemented
        pairs = ((self.x, other.x), (self.y, other.y), (self.height, other.height))
        return all(np.array_equal(mine, theirs) for mine, theirs in pairs)

    def __hash__(self) -> int:
        return hash((self.height.shape, float(self.height.max()), float(self.height.min())))


def _locate(
    lines: NDArray[np.float64], positions: ArrayLike
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.bool_]]:
    """Interval of each position, how far along it (0 to 1), and whether the map covers it."""
    positions = np.asarray(positions, dtype=np.float64)
    within = (positions >= lines[0]) & (positions <= lines[-1])
    covered = np.clip(positions, lines[0], lines[-1])
    interval = np.clip(np.searchsorted(lines, covered, side="right") - 1, 0, lines.size - 2)
    start = lines[interval]
    return interval, (covered - start) / (lines[interval + 1] - start), within


def _mesh_lines(name: str, values: ArrayLike) -> NDArray[np.float64]:
    lines = _read_only(name, values)
    if lines.ndim != 1 or lines.size < 2:
        raise ValueError(
            f"HeightMap: {name} must be one-dimensional with at least 2 coordinates, "
            f"got shape {lines.shape}"
        )
    _require_finite(name, lines)
    falls = np.flatnonzero(np.diff(lines) <= 0)
    if falls.size:
        i = int(falls[0])
        raise ValueError(
            f"HeightMap: {name} must increase strictly, got {lines[i]} m followed by "
            f"{lines[i + 1]} m at index {i + 1}; sort the coordinates, and height with them"
        )
    return lines


def _heights(values: ArrayLike, shape: tuple[int, int]) -> NDArray[np.float64]:
    height = _read_only("height", values)
    if height.shape != shape:
        hint = "; transpose it, height is indexed [x, y]" if height.shape == shape[::-1] else ""
        raise ValueError(
            f"HeightMap: height must have a row for each x and a column for each y, shape "
            f"{shape}, got {height.shape}{hint}"
        )
    _require_finite("height", height)
    if np.abs(height).max() > _HIGHEST:
        raise ValueError(
            f"HeightMap: height must be within {_HIGHEST:g} m of its reference, got "
            f"{height.flat[np.abs(height).argmax()]:g} m; is it in metres?"
        )
    return height


def _require_finite(name: str, values: NDArray[np.float64]) -> None:
    missing = int(np.count_nonzero(~np.isfinite(values)))
    if missing:
        raise ValueError(
            f"HeightMap: {name} must be finite, got {missing} of {values.size} values NaN or "
            "infinite; missing points are not handled yet, fill them or cut the map"
        )


def _read_only(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        given = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"HeightMap: {name} must have rows of equal length") from error
    if given.dtype.kind not in "iuf":
        first = given.flat[0] if given.size else None
        raise ValueError(f"HeightMap: {name} must hold numbers in m, got {first!r} first")
    copy = given.astype(np.float64)
    copy.flags.writeable = False
    return copy
