"""Contact spots of a result: their number and sizes, and the real over the nominal area."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_axis import RunAxis, run_axis
from viscontact.results.snapshots import Snapshot, field_times, snapshot_reader
from viscontact.units.formatting import format_number, format_quantity
from viscontact.units.numbers import real_array

_NAME = "contact-spots"


@dataclass(frozen=True, eq=False)
class ContactSpots:
    """Spots in contact at one instant or speed."""

    place: float  # [s] or [m/s]
    axis: RunAxis
    areas: Floats  # counted cells of each spot times the area of a cell, descending [m²]
    real_area: float  # contact area of the result, resolved below the cell [m²]
    nominal_area: float  # of the periods, or of the convex hull of the contact [m²]
    is_period: bool  # True if the nominal area is that of the periods

    @cached_property
    def number(self) -> int:
        """Number of spots."""
        return int(self.areas.size)

    @property
    def fraction(self) -> float:
        """Real over nominal area, NaN without contact [-]."""
        return self.real_area / self.nominal_area if self.nominal_area > 0 else math.nan

    @property
    def text(self) -> str:
        """The spots in a sentence."""
        where, mean = self.axis.place(self.place), self.real_area / max(self.number, 1)
        of = "the period" if self.is_period else "its convex hull"
        return (
            f"contact spots at {where}: {self.number}, mean area "
            f"{format_quantity(mean, 'm²', 3)}, largest {format_quantity(self.areas[0], 'm²', 3)}; "
            f"the contact is {format_number(100 * self.fraction, 3)} % of {of}"
        )


def spots_of(ds: xr.Dataset, snapshot: Snapshot) -> ContactSpots:
    """Spots of a snapshot of a result."""
    axis = run_axis(ds)
    row = int(np.argmin(np.abs(axis.values(ds) - snapshot.time)))
    real = float(ds["contact_area"].values[row])
    cell = snapshot.cell_size[0] * snapshot.cell_size[1]
    numbers = label_spots(snapshot.in_contact, snapshot.periodic)
    counts = np.sort(np.bincount(numbers[numbers > 0])[1:])[::-1]
    areas = np.asarray(cell * counts, dtype=np.float64)
    if not areas.size:
        return ContactSpots(snapshot.time, axis, areas, 0.0, 0.0, False)
    return ContactSpots(
        snapshot.time,
        axis,
        areas,
        real,
        max(_nominal_area(snapshot), real),
        any(snapshot.periodic),
    )


def last_spots(ds: xr.Dataset) -> ContactSpots | None:
    """Spots at the last stored instant in contact; None for a single spot, or without fields."""
    try:
        stored, read = field_times(ds, _NAME), snapshot_reader(ds)
    except ValueError:  # no fields, none yet, or no recorded case
        return None
    for index in reversed(range(stored.size)):
        snapshot = read(index)
        if snapshot.touching:
            is_single = label_spots(snapshot.in_contact, snapshot.periodic).max() == 1
            return None if is_single else spots_of(ds, snapshot)
    return None


def contact_spots(ds: xr.Dataset, times: ArrayLike | None = None) -> xr.Dataset:
    """Return number and sizes of the contact spots, and the real over the nominal contact area.

    Parameters
    ----------
    ds : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s], or speeds [m/s] of steady motion; the nearest stored ones are taken. All by
        default.

    Returns
    -------
    xarray.Dataset
        Over ``time`` or ``speed``: ``spots``, the number of regions of cells in contact that share
        no edge; ``mean_spot_area``, the contact area over this number, and ``largest_spot_area``,
        by counting cells [m²]; ``nominal_area`` [m²] and ``area_fraction``, the contact area over
        it. The nominal area is that of the period of a periodic grid (along one axis: period times
        contact width), otherwise that of the convex hull of the centres of the cells in contact,
        and not less than the contact area.

    Raises
    ------
    ValueError
        If no fields are stored.

    Notes
    -----
    Spots of few cells are resolved badly, and their number rises with the resolution of the map.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((32, 32), (4e-3, 4e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> contact_spots(ds).spots.values.tolist()
    [1]
    """
    stored, read, axis = field_times(ds, _NAME), snapshot_reader(ds), run_axis(ds)
    rows: Sequence[int] = range(stored.size)
    if times is not None:
        wanted = np.atleast_1d(real_array(f"{axis.name}s", times, axis.unit))
        rows = sorted({int(np.argmin(np.abs(stored - each))) for each in wanted})
    found = [spots_of(ds, read(row)) for row in rows]
    columns: dict[str, tuple[str, str, list[float]]] = {
        "mean_spot_area": ("m2", "contact area over the number of spots", []),
        "largest_spot_area": ("m2", "area of the largest spot, by counting cells", []),
        "nominal_area": ("m2", "nominal contact area", []),
        "area_fraction": ("1", "contact area over nominal contact area", []),
    }
    for each in found:
        columns["mean_spot_area"][2].append(each.real_area / each.number if each.number else 0.0)
        columns["largest_spot_area"][2].append(float(each.areas[0]) if each.number else 0.0)
        columns["nominal_area"][2].append(each.nominal_area)
        columns["area_fraction"][2].append(each.fraction)
    of_spots = {"units": "1", "long_name": "number of contact spots"}
    variables = {"spots": xr.DataArray([each.number for each in found], dims=axis.name)}
    variables["spots"].attrs |= of_spots
    for name, (units, long_name, values) in columns.items():
        attrs = {"units": units, "long_name": long_name}
        variables[name] = xr.DataArray(values, dims=axis.name, attrs=attrs)
    return xr.Dataset(variables, {axis.name: [each.place for each in found]})


def label_spots(contact: Bools, periodic: Sequence[bool]) -> Integers:
    """Number the spots from 1: regions of cells that share edges; 0 is open. Shape (nx, ny)."""
    # Along a periodic axis, spots continue at the other border.
    numbers, count = scipy.ndimage.label(contact)
    pairs = [
        np.stack([first, last])[:, (first > 0) & (last > 0)]
        for axis, repeats in enumerate(periodic)
        if repeats
        for first, last in [(np.take(numbers, 0, axis), np.take(numbers, -1, axis))]
    ]
    if not pairs or not count:
        return np.asarray(numbers, dtype=np.int_)
    one, other = np.concatenate(pairs, axis=1)
    joined = scipy.sparse.coo_array((np.ones(one.size), (one - 1, other - 1)), shape=(count, count))
    _, groups = scipy.sparse.csgraph.connected_components(joined, directed=False)
    return np.asarray(np.concatenate([[0], groups + 1])[numbers], dtype=np.int_)


def _nominal_area(snapshot: Snapshot) -> float:
    """Area of the period, or of the convex hull of the contact [m²]."""
    x_low, x_high, y_low, y_high = snapshot.extent()
    (lx, ly), (along_x, along_y) = snapshot.grid.size, snapshot.periodic
    if along_x or along_y:
        return (lx if along_x else x_high - x_low) * (ly if along_y else y_high - y_low)
    contact = snapshot.in_contact
    rows = np.flatnonzero(contact.any(axis=1))
    first = contact[rows].argmax(axis=1)
    last = contact.shape[1] - 1 - contact[rows, ::-1].argmax(axis=1)
    ends = [np.column_stack([snapshot.x[rows], snapshot.y[column]]) for column in (first, last)]
    try:
        return float(scipy.spatial.ConvexHull(np.concatenate(ends)).volume)  # in a plane, its area
    except (scipy.spatial.QhullError, ValueError):  # cells in one row
        return 0.0
