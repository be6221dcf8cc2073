"""Joint result of a sweep as one netCDF file, written in constant memory."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from viscontact.results.digests import store_digests
from viscontact.results.seal import seal
from viscontact.results.stored_result import appending
from viscontact.runs.directory.atomic_files import fresh_name, put_in_place
from viscontact.runs.directory.netcdf_layout import true_cause
from viscontact.studies.sweep.joint_layout import JointLayout, Progress
from viscontact.studies.sweep.lazy_fields import lazy_fields


def write_joint_result(
    layout: JointLayout, path: Path, progress: Progress, *, fields: bool = False
) -> None:
    """Write the joint result of a sweep, with shared `fields`, as CF netCDF-4, atomically."""
    fresh = fresh_name(path)
    fresh.unlink(missing_ok=True)
    try:
        frame = layout.frame()
        if fields:
            frame = frame.assign_coords(lazy_fields(layout).coords)
        with true_cause(fresh):
            frame.to_netcdf(fresh, format="NETCDF4", engine="netcdf4")
        with appending(fresh) as file:
            _write_scalars(file, layout, progress)
            if fields:
                _write_fields(file, layout, progress)
            store_digests(file)
        seal(fresh)
        put_in_place(fresh, path)
    except RuntimeError as error:  # what netCDF says where the disk is full
        raise OSError(f"{error}; is the disk full?") from error
    finally:
        with suppress(OSError):
            fresh.unlink(missing_ok=True)


def _write_scalars(file: netCDF4.Dataset, layout: JointLayout, progress: Progress) -> None:
    if layout.row_dim not in file.dimensions:
        file.createDimension(layout.row_dim, layout.steps)
    for name in layout.names:
        _create(file, name, layout.scalar_dims, layout.attributes(name), layout.beside)
    for runs, values in layout.blocks() if layout.steps else ():
        for part, place in slabs(runs.start, runs.stop, layout.axes.shape):
            sizes = [each.stop - each.start for each in place]
            rows = values[part.start - runs.start : part.stop - runs.start]
            for column, name in enumerate(layout.names):
                file.variables[name][place] = rows[:, column].reshape(*sizes, layout.steps)
        progress(runs.stop, len(layout.runs))


def _write_fields(file: netCDF4.Dataset, layout: JointLayout, progress: Progress) -> None:
    shared = lazy_fields(layout)
    for name, field in shared.data_vars.items():
        _create(file, str(name), field.dims, field.attrs, layout.beside)
    for number, run in enumerate(layout.done, start=1):
        place = tuple(map(int, np.unravel_index(run, layout.axes.shape)))
        for name, field in shared.data_vars.items():
            file.variables[str(name)][place] = field[place].values
        progress(number, len(layout.done))


def _create(
    file: netCDF4.Dataset,
    name: str,
    dims: Sequence[Any],
    attributes: Mapping[str, Any],
    beside: Sequence[str],
) -> None:
    """Create a variable of NaN, with CF's list of its coordinates that are no dimensions."""
    variable: Any = file.createVariable(name, "f8", tuple(map(str, dims)), fill_value=np.nan)
    coordinates = [each for each in beside if each != name]
    variable.setncatts({**attributes, "coordinates": " ".join(coordinates)})


def slabs(first: int, last: int, shape: Sequence[int]) -> Iterator[tuple[slice, tuple[slice, ...]]]:
    """Divide consecutive elements of an array, counted in C order, into rectangular blocks."""
    if len(shape) == 1:
        yield slice(first, last), (slice(first, last),)
        return
    inner = math.prod(shape[1:])
    while first < last:
        row, offset = divmod(first, inner)
        rows = 0 if offset else (last - first) // inner
        if rows:
            end = first + rows * inner
            yield slice(first, end), (slice(row, row + rows), *(slice(0, n) for n in shape[1:]))
        else:
            end = min(last, (row + 1) * inner)
            for part, place in slabs(offset, offset + end - first, shape[1:]):
                begun = row * inner
                yield (
                    slice(begun + part.start, begun + part.stop),
                    (slice(row, row + 1), *place),
                )
        first = end
