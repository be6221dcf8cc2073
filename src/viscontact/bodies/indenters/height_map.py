"""Height map: a measured or generated surface on a rectangular mesh."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.position_checks import positions
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array

#: Largest height, whose square is still a finite number [m].
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
    holes : bool, optional
        True if points may be missing (NaN): they are holes, which never touch.

    Raises
    ------
    ValueError
        If the arrays do not fit together, a coordinate does not increase, or a value is
        infinite, or missing where no holes are meant.

    Notes
    -----
    The gap is max(height) - height, bilinear between the mesh points, and +inf outside the map
    and within a mesh step of holes. Only the values at the requested positions are used: on a
    grid coarser than the map, details between the grid points are missed, not averaged. The
    arrays are copied and made read-only.

    Examples
    --------
    >>> ridge = HeightMap(x=[-1.0, 0.0, 1.0], y=[0.0, 1.0], height=[[0, 0], [2, 2], [0, 0]])
    >>> ridge.gap([0.0, 0.5, 2.0], 0.25).tolist()
    [0.0, 1.0, inf]
    """

    x: Floats = field(metadata={"unit": "m"})
    y: Floats = field(metadata={"unit": "m"})
    height: Floats = field(metadata={"unit": "m"})
    holes: bool

    def __init__(self, x: ArrayLike, y: ArrayLike, height: ArrayLike, holes: bool = False) -> None:
        # Written out, so that lists are accepted and arrays are stored.
        object.__setattr__(self, "x", _mesh_lines("x", x))
        object.__setattr__(self, "y", _mesh_lines("y", y))
        shape = (self.x.size, self.y.size)
        object.__setattr__(self, "holes", bool(holes))
        object.__setattr__(self, "height", _heights(height, shape, self.holes))

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return max(height) - height at x, y, +inf outside the map; see `Indenter.gap`."""
        x, y = positions(x, y)
        i, along_x, within_x = _locate(self.x, x)
        j, along_y, within_y = _locate(self.y, y)
        # Depths and weights are not negative, so neither is the gap.
        near = _interpolate_between(self._depth(i, j), self._depth(i, j + 1), along_y)
        far = _interpolate_between(self._depth(i + 1, j), self._depth(i + 1, j + 1), along_y)
        gap = _interpolate_between(near, far, along_x)
        return np.where(within_x & within_y & ~np.isnan(gap), gap, np.inf)

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """Smallest steps between the mesh lines along x and y [m]."""
        return float(np.diff(self.x).min()), float(np.diff(self.y).min())

    @property
    def sample_points(self) -> tuple[Floats, Floats]:
        """Points of the mesh, row by row [m]."""
        x, y = np.meshgrid(self.x, self.y, indexing="ij")
        return x.ravel(), y.ravel()

    @cached_property
    def _highest(self) -> float:
        return float(np.nanmax(self.height))

    def _depth(self, i: Integers, j: Integers) -> Floats:
        """Depth of mesh points below the highest point [m]."""
        return self._highest - self.height[i, j]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, HeightMap):
            return NotImplemented
        pairs = ((self.x, other.x), (self.y, other.y), (self.height, other.height))
        return all(np.array_equal(mine, theirs, equal_nan=True) for mine, theirs in pairs)

    def __hash__(self) -> int:
        return hash((self.height.shape, self._highest))


def _interpolate_between(near: Floats, far: Floats, along: Floats) -> Floats:
    """Linear interpolation; a missing (NaN) value counts only where its weight is positive."""
    value = near * (1 - along) + far * along
    return np.where(along == 0, near, np.where(along == 1, far, value))


def _locate(lines: Floats, positions: Floats) -> tuple[Integers, Floats, Bools]:
    """Interval of each position, its fraction (0 to 1), and whether the map covers it."""
    # The grid's rim may coincide with the map's up to the rounding of a converted unit.
    slack = 1e-9 * (lines[-1] - lines[0])
    within = (positions >= lines[0] - slack) & (positions <= lines[-1] + slack)
    covered = np.clip(positions, lines[0], lines[-1])
    interval = np.clip(np.searchsorted(lines, covered, side="right") - 1, 0, lines.size - 2)
    start = lines[interval]
    return interval, (covered - start) / (lines[interval + 1] - start), within


def _mesh_lines(name: str, values: ArrayLike) -> Floats:
    lines = _read_only(name, values)
    if lines.ndim != 1 or lines.size < 2:
        raise ValueError(
            f"HeightMap: {name} must be one-dimensional with at least 2 coordinates, "
            f"got shape {lines.shape}"
        )
    _require_finite(name, lines)
    for i in np.flatnonzero(np.diff(lines) <= 0)[:1]:
        raise ValueError(
            f"HeightMap: {name} must increase strictly, got {format_quantity(lines[i], 'm', 9)} "
            f"followed by {format_quantity(lines[i + 1], 'm', 9)} at index {i + 1}; sort the "
            "coordinates, and height with them"
        )
    return lines


def _heights(values: ArrayLike, shape: tuple[int, int], holes: bool) -> Floats:
    height = _read_only("height", values)
    if height.shape != shape:
        hint = "; transpose it, height is indexed [x, y]" if height.shape == shape[::-1] else ""
        raise ValueError(
            f"HeightMap: height must have a row for each x and a column for each y, shape "
            f"{shape}, got {height.shape}{hint}"
        )
    known = height[~np.isnan(height)] if holes else height
    if known.size == 0:
        raise ValueError("HeightMap: height must be known somewhere, all of it is missing")
    _require_finite("height", known)
    if np.abs(known).max() > _HIGHEST:
        raise ValueError(
            f"HeightMap: height must be within {format_quantity(_HIGHEST, 'm', 6)} of its "
            f"reference, got {format_quantity(known.flat[np.abs(known).argmax()], 'm', 6)}; is it "
            "in metres?"
        )
    return height


def _require_finite(name: str, values: Floats) -> None:
    missing = int(np.count_nonzero(~np.isfinite(values)))
    if missing:
        raise ValueError(
            f"HeightMap: {name} must be finite, got {missing} of {values.size} values NaN or "
            "infinite; fill missing heights, or say with holes=True that nothing touches there"
        )


def _read_only(name: str, values: ArrayLike) -> Floats:
    copy = np.array(real_array(f"HeightMap: {name}", values, "m"))
    copy.flags.writeable = False
    return copy
