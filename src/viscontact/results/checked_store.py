"""Result file read by xarray, which checks values against their digests when they are used."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import xarray as xr
from xarray.backends import NetCDF4DataStore
from xarray.backends.netCDF4_ import NetCDF4ArrayWrapper
from xarray.core import indexing

from viscontact.results.digests import StoredDigests
from viscontact.results.stored_result import (
    checked_digests,
    noticing_damage,
    require_sound,
    without_masks,
)


class _CheckedArray(NetCDF4ArrayWrapper):
    """Values of a variable, checked when they are read."""

    __slots__ = ()

    def _getitem(self, key: Any) -> Any:
        store = self.datastore
        with noticing_damage(Path(store.path)), store.lock:
            variable = self.get_array(needs_lock=False)  # type: ignore[no-untyped-call]
            # Of the file that is open now: xarray closes files and opens them again.
            digests = StoredDigests.of(variable.group())
            return variable[key] if digests is None else digests.read(variable, key)


class _CheckedStore(NetCDF4DataStore):
    """Variables of a file, checked when they are read."""

    __slots__ = ()

    @property
    def path(self) -> str:
        """Path of the file, under which xarray files it as the source of the dataset."""
        return str(self._filename)

    def open_store_variable(self, name: str, var: Any) -> xr.Variable:
        """Return a variable whose values are read when they are used."""
        found = super().open_store_variable(name, var)
        data = indexing.LazilyIndexedArray(_CheckedArray(name, self))  # type: ignore[no-untyped-call]
        return xr.Variable(found.dims, data, found.attrs, found.encoding)


def open_checked(path: Path) -> xr.Dataset:
    """Open a netCDF-4 file; DamagedFileError, also later, for what is not as it was written."""
    require_sound(path)
    store = _CheckedStore.open(str(path))  # type: ignore[no-untyped-call]
    try:
        with noticing_damage(path):
            checked_digests(without_masks(store.ds), path)
            return xr.open_dataset(store)
    except BaseException:
        store.close()
        raise
