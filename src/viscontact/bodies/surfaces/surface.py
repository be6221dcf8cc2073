"""Measured surface: heights on an even mesh, with missing points as NaN."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.display import Displayable
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import both_lengths, real_array, store

#: Upper limit on heights above their reference [m].
_LARGEST = 1e6


@dataclass(frozen=True, eq=False, init=False)
class Surface(Displayable):
    """Heights on an even mesh, as measured with the surface facing the instrument.

    Parameters
    ----------
    heights : array_like, shape (nx, ny)
        Heights from any reference, larger towards the instrument; NaN where none was
        measured. At least one point along each axis, and one that is known [m].
    spacing : float or pair of float
        Distance of neighbouring points along x and y [m].
    name : str, optional
        Its name in messages.
    periodic : bool, optional
        True if its ends fit together, so that it continues periodically.
    notes : tuple of str, optional
        What its reader has done, such as values that mark missing points.

    Raises
    ------
    ValueError
        If the heights are no map of numbers, are all missing or infinite, or a spacing is not
        a positive finite length.

    Notes
    -----
    Each point is the centre of a cell, so that the map is `shape` times `spacing` large.
    The origin of `x` and `y` is its middle, as in `viscontact.Grid`: on a grid of the same
    shape and size the points are the cell centres.

    Examples
    --------
    >>> ramp = Surface([[0.0, 0.0], [1e-6, 1e-6], [2e-6, np.nan]], spacing=0.25)
    >>> ramp.size, ramp.x.tolist(), int(ramp.missing.sum())
    ((0.75, 0.5), [-0.25, 0.0, 0.25], 1)
    """

    heights: Floats
    spacing: tuple[float, float]
    name: str
    periodic: bool
    notes: tuple[str, ...]

    def __init__(
        self,
        heights: ArrayLike,
        spacing: float | tuple[float, float],
        *,
        name: str = "surface",
        periodic: bool = False,
        notes: tuple[str, ...] = (),
    ) -> None:
        steps = both_lengths(f"{name}: spacing", spacing)
        found = _map_of(name, heights)
        store(self, name=name, heights=found, spacing=steps, periodic=bool(periodic), notes=notes)

    @property
    def shape(self) -> tuple[int, int]:
        """Points along x and y."""
        nx, ny = self.heights.shape
        return nx, ny

    @property
    def size(self) -> tuple[float, float]:
        """Extent along x and y, a cell around each point [m]."""
        return self.shape[0] * self.spacing[0], self.shape[1] * self.spacing[1]

    @property
    def x(self) -> Floats:
        """Positions along x, shape (nx,) [m]."""
        return _centred(self.shape[0], self.spacing[0])

    @property
    def y(self) -> Floats:
        """Positions along y, shape (ny,) [m]."""
        return _centred(self.shape[1], self.spacing[1])

    @cached_property
    def missing(self) -> Bools:
        """Mask of the points without a height, shape (nx, ny)."""
        return np.isnan(self.heights)

    @property
    def missing_share(self) -> float:
        """Share of the points without a height [-]."""
        return float(self.missing.mean())

    @cached_property
    def rms_height(self) -> float:
        """Root-mean-square deviation of the known heights from their mean (Sq) [m]."""
        return float(np.nanstd(self.heights))

    @cached_property
    def mean_deviation(self) -> float:
        """Mean magnitude of the deviation of the known heights from their mean (Sa) [m]."""
        return float(np.nanmean(np.abs(self.heights - np.nanmean(self.heights))))

    @property
    def height_range(self) -> float:
        """Highest less lowest known height (Sz) [m]."""
        return float(np.nanmax(self.heights) - np.nanmin(self.heights))

    @cached_property
    def skewness(self) -> float:
        """Third moment of the known heights over the cube of their rms (Ssk); 0 of a plane [-].

        Negative where deep valleys lie below a plateau, positive where peaks rise above one.
        """
        deviation = self.heights - np.nanmean(self.heights)
        rms = self.rms_height
        return float(np.nanmean(deviation**3)) / rms**3 if rms > 0 else 0.0

    @cached_property
    def rms_slope(self) -> float:
        """Root-mean-square gradient, from differences of neighbouring points (Sdq) [-]."""
        return float(np.sqrt(sum(self._mean_square_slope(axis) for axis in (0, 1))))

    @cached_property
    def developed_ratio(self) -> float:
        """Area of the surface over that of its plan, less 1 (Sdr, ISO 25178-2) [-].

        From the triangles between neighbouring points, the mean of both diagonals of each cell;
        cells with a missing point are left out. NaN for a line scan.
        """
        heights = self.heights
        if self.periodic:
            heights = np.pad(heights, ((0, 1), (0, 1)), mode="wrap")
        if min(heights.shape) < 2:
            return math.nan
        along, across = (
            np.diff(heights, axis=axis) / step for axis, step in enumerate(self.spacing)
        )
        areas = [
            np.sqrt(1 + x**2 + y**2)
            for x in (along[:, :-1], along[:, 1:])
            for y in (across[:-1], across[1:])
        ]
        known = np.isfinite(sum(areas))
        return (
            float(np.mean([area[known].mean() for area in areas]) - 1) if known.any() else math.nan
        )

    def _mean_square_slope(self, axis: int) -> float:
        steps = np.diff(self.heights, axis=axis)
        if self.periodic:
            first, last = (np.take(self.heights, [end], axis=axis) for end in (0, -1))
            steps = np.concatenate([steps, first - last], axis=axis)
        known = steps[np.isfinite(steps)] / self.spacing[axis]
        return float(np.mean(known**2)) if known.size else 0.0

    def with_heights(self, heights: ArrayLike) -> Surface:
        """Return the same mesh with other heights [m]."""
        return Surface(
            heights, self.spacing, name=self.name, periodic=self.periodic, notes=self.notes
        )

    def __repr__(self) -> str:
        nx, ny = self.shape
        lx, ly = self.size
        return (
            f"Surface({self.name}: {nx} x {ny} points on {format_quantity(lx, 'm')} x "
            f"{format_quantity(ly, 'm')})"
        )


def _centred(points: int, spacing: float) -> Floats:
    # As the grid's cell centres, to the last bit where the sizes agree.
    offsets = (2 * np.arange(points) - (points - 1)).astype(np.float64)
    return offsets * (points * spacing / (2 * points))


def _map_of(name: str, heights: ArrayLike) -> Floats:
    if isinstance(heights, np.ma.MaskedArray):  # of a file's reader
        heights = np.ma.filled(heights.astype(np.float64), np.nan)
    given = real_array(f"{name}: heights", heights, "m", 2)
    if given.size == 0:
        raise ValueError(f"{name}: heights must be a map [x, y], got shape {given.shape}")
    if np.isnan(given).all():
        raise ValueError(f"{name}: all {given.size} heights are missing")
    # Without a copy of the heights that are known: maps are large.
    farthest = max(np.nanmin(given), np.nanmax(given), key=abs)
    if abs(farthest) > _LARGEST:
        raise ValueError(
            f"{name}: heights must be lengths in m, got "
            f"{format_quantity(farthest, 'm', 6)}; give points that were not "
            "measured as NaN"
        )
    copy = np.array(given)
    copy.flags.writeable = False
    return copy
