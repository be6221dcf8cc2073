"""Digests of a result file, by which its readers notice damage."""

# A digest is the CRC-32 of values, begun with that of the name, axes, type and attributes of their
# variable. A variable along one axis has one digest; any other has one for each block of its last
# axes, so that a block of a large field is checked when it is read. They are in a group of the
# file: xarray opens the variables outside of groups only, so that a dataset which a user changes
# and saves with `to_netcdf` has no digests instead of old ones.
#
# HDF5's own checksums (fletcher32) are of single chunks. They notice neither changed attributes or
# fill values, nor chunks that are lost or exchanged.

from __future__ import annotations

import json
import math
import zlib
from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any, Self

import netCDF4
import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.damage import DamagedFileError

#: Group of a file with its digests: an attribute for the attributes of the file, an attribute for
#: all variables along one axis, and a variable for each of the others.
GROUP, _ATTRIBUTES, _COLUMNS = "digests", "attributes", "columns"
#: Memory for blocks that are read at once [bytes].
_AT_ONCE = 2**23
#: Digests that HDF5 stores together.
_CHUNK = 128
_ABOUT = "CRC-32 of the values as stored, begun with that of the description of their variable"


def digest_of(values: Any, start: int = 0) -> int:
    """Return the digest of values, which continues that of earlier ones."""
    array = np.asarray(values)
    if array.dtype.kind in "OU":
        return zlib.crc32(json.dumps(array.tolist(), default=repr).encode(), start)
    stored = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
    return zlib.crc32(stored.reshape(-1).view(np.uint8).data, start) if stored.size else start


def block_axes(count: int) -> int:
    """Return how many of the last axes of a variable a block with a digest has."""
    return count if count <= 1 else min(2, count - 1)


def begin(variable: Any) -> int:
    """Return the digest of a variable before its first value."""
    kind = "str" if variable.dtype is str else np.dtype(variable.dtype).newbyteorder("<").str
    about = json.dumps([variable.name, list(variable.dimensions), kind])
    return _attributes_digest(variable, zlib.crc32(about.encode()))


def _attributes_digest(place: Any, start: int = 0) -> int:
    """Return the digest of the attributes of a file or a variable, in the order of their names."""
    digest = start
    for name in sorted(place.ncattrs()):
        value = np.asarray(place.getncattr(name))
        digest = digest_of(value, zlib.crc32(f"{name} {value.dtype.kind}".encode(), digest))
    return digest


class RunningDigests:
    """Digests of a file to which rows are added; they are of what was written into it.

    A block with a digest of its own is one row, or one at each creepage of a row.
    """

    def __init__(self, file: netCDF4.Dataset) -> None:
        self._begin = {name: begin(variable) for name, variable in file.variables.items()}
        self._columns = {
            name: self._begin[name] for name, each in file.variables.items() if each.ndim <= 1
        }
        create_group(file)

    def add(self, name: str, values: Any) -> None:
        """Continue the digest of a variable along one axis."""
        self._columns[name] = digest_of(values, self._columns[name])

    def replace(self, name: str, values: Any) -> None:
        """Begin the digest of a variable along one axis again."""
        self._columns[name] = digest_of(values, self._begin[name])

    def put(self, file: netCDF4.Dataset, name: str, row: int, rows: Any) -> None:
        """Store the digests of consecutive rows of a variable along several axes."""
        stored, start = file[GROUP].variables[name], self._begin[name]
        leading = np.shape(rows)[: stored.ndim]
        found = [digest_of(rows[place], start) for place in np.ndindex(leading)]
        stored[row : row + len(rows)] = np.array(found, np.uint32).reshape(leading)

    def store(self, file: netCDF4.Dataset) -> None:
        """Store the digests of the attributes and of the variables along one axis."""
        _store(file, self._columns)


def create_group(file: netCDF4.Dataset) -> netCDF4.Group:
    """Create the group of a file for the digests of its variables."""
    group = file.createGroup(GROUP)
    group.setncattr("long_name", _ABOUT)
    for name, variable in file.variables.items():
        axes = variable.dimensions[: variable.ndim - block_axes(variable.ndim)]
        if not axes:
            continue
        sizes = [min(_CHUNK, max(1, len(file.dimensions[axis]) or _CHUNK)) for axis in axes]
        stored = group.createVariable(name, "u4", axes, chunksizes=sizes, fill_value=False)
        stored.setncatts({"units": "1", "long_name": f"digest of {name}"})
    return group


def _store(file: netCDF4.Dataset, columns: Mapping[str, int]) -> None:
    # Of one length, so that a later text takes its place in the file.
    text = json.dumps({name: f"{digest:08x}" for name, digest in columns.items()})
    file[GROUP].setncatts({_ATTRIBUTES: f"{_attributes_digest(file):08x}", _COLUMNS: text})


def store_digests(file: netCDF4.Dataset) -> None:
    """Store the digests of all that a file holds, which is open for appending without masks."""
    group = file.groups.get(GROUP) or create_group(file)
    columns = {}
    for name, variable in file.variables.items():
        start = begin(variable)
        if variable.ndim <= 1:
            columns[name] = digest_of(_read(variable, ...), start)
            continue
        last = group.variables[name].ndim - 1
        for place, rows in _spans(variable, [range(size) for size in variable.shape[: last + 1]]):
            found = [digest_of(values, start) for values in _read(variable, (*place, rows))]
            group.variables[name][(*place, rows)] = np.array(found, np.uint32)
    _store(file, columns)


def _read(variable: Any, key: Any) -> Any:
    return np.asarray(variable[key], dtype=object if variable.dtype is str else variable.dtype)


def _spans(variable: Any, along: list[Any]) -> Iterator[tuple[tuple[int, ...], slice]]:
    """Yield places of blocks: indices along their axes, of which the last are consecutive."""
    *others, last = (np.atleast_1d(each) for each in along)
    size = 8 if variable.dtype is str else np.dtype(variable.dtype).itemsize
    cells = math.prod(variable.shape[len(along) :])
    most = max(1, _AT_ONCE // max(1, size * cells))
    ends = np.flatnonzero(np.diff(last) != 1) + 1
    for place in product(*(map(int, each) for each in others)):
        for run in np.split(last, ends):
            for first in range(0, run.size, most):
                part = run[first : first + most]
                yield place, slice(int(part[0]), int(part[-1]) + 1)


@dataclass(frozen=True, eq=False)
class StoredDigests:
    """Digests of a file, read from it."""

    path: str
    attributes: str
    columns: Mapping[str, str]  # by the names of the variables along one axis
    rows: Mapping[str, Any]  # variables with the digests of the others

    @classmethod
    def of(cls, file: netCDF4.Dataset) -> Self | None:
        """Read the digests of a file; None if it was written without them."""
        if GROUP not in file.groups:
            return None
        group, path = file.groups[GROUP], file.filepath()
        try:
            columns = json.loads(group.getncattr(_COLUMNS))
            found = cls(path, str(group.getncattr(_ATTRIBUTES)), columns, group.variables)
            complete = {*columns, *group.variables} == set(file.variables)
        except (AttributeError, ValueError, TypeError, RuntimeError) as error:
            raise DamagedFileError(path, "its digests") from error
        if not complete:
            raise DamagedFileError(path, "its variables")
        return found

    def check_file(self, file: netCDF4.Dataset) -> None:
        """Raise DamagedFileError unless attributes and coordinates are as they were written."""
        if f"{_attributes_digest(file):08x}" != self.attributes:
            raise DamagedFileError(self.path, "its attributes")
        for name in file.dimensions:
            if name in file.variables:
                self.read(file.variables[name], ...)

    def read(self, variable: Any, key: Any) -> Any:
        """Read values of a variable of the file and check those that share their digests.

        The indices of `key` are independent of each other, as those of netCDF4 are.
        """
        if variable.ndim <= 1:
            values = _read(variable, ...)
            if f"{digest_of(values, begin(variable)):08x}" != self.columns.get(variable.name):
                raise DamagedFileError(self.path, f"the values of {variable.name}")
            return values[key]
        return self._blocks(variable, _whole_key(key, variable.ndim))

    def _blocks(self, variable: Any, key: tuple[Any, ...]) -> Any:
        stored, start = self.rows[variable.name], begin(variable)
        along = [np.arange(n)[k] for n, k in zip(variable.shape, key, strict=True)]
        blocks, inner = along[: stored.ndim], [np.atleast_1d(each) for each in along[stored.ndim :]]
        sizes = [np.size(each) for each in along]
        values = np.empty(sizes, object if variable.dtype is str else variable.dtype)
        flat = values.reshape(math.prod(sizes[: stored.ndim]), *sizes[stored.ndim :])
        done = 0
        for place, rows in _spans(variable, blocks) if flat.size else ():
            read, written = _read(variable, (*place, rows)), np.asarray(stored[(*place, rows)])
            for block, digest in zip(read, written, strict=True):
                if digest_of(block, start) != int(digest):
                    raise DamagedFileError(self.path, f"the values of {variable.name}")
            flat[done : done + len(read)] = read[np.ix_(np.arange(len(read)), *inner)]
            done += len(read)
        return values[tuple(0 if np.ndim(each) == 0 else slice(None) for each in along)]


def _whole_key(key: Any, axes: int) -> tuple[Any, ...]:
    """Return an index for each axis."""
    given = key if isinstance(key, tuple) else (key,)
    at = next((n for n, each in enumerate(given) if each is Ellipsis), len(given))
    missing = axes - sum(each is not Ellipsis for each in given)
    return (*given[:at], *[slice(None)] * missing, *given[at + 1 :])
