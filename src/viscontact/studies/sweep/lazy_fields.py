"""Fields of all runs of a sweep as arrays that read the results when they are used."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import xarray as xr
from xarray.backends import BackendArray
from xarray.core import indexing

from viscontact.results.run_files import RESULT_NAME
from viscontact.results.stored_result import StoredFile
from viscontact.results.variables import EVERY_FIELD, LINES
from viscontact.studies.sweep.joint_layout import JointLayout
from viscontact.studies.sweep.states import State


class _SweepField(BackendArray):
    """A field over the runs of a sweep, NaN without a result; a file is open while it is read."""

    def __init__(self, layout: JointLayout, name: str, sizes: tuple[int, ...]) -> None:
        self.shape = (*layout.axes.shape, *sizes)
        self.dtype = np.dtype(np.float64)
        self._layout, self._name = layout, name

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(
            key, self.shape, indexing.IndexingSupport.OUTER, self._read_values
        )

    def _read_values(self, key: tuple[Any, ...]) -> Any:
        count = len(self._layout.axes.shape)
        along = [np.atleast_1d(np.arange(n)[k]) for n, k in zip(self.shape, key, strict=True)]
        runs, inner = along[:count], along[count:]
        values = np.full([len(each) for each in along], np.nan)
        for place in product(*(range(len(each)) for each in runs)):
            index = tuple(each[at] for each, at in zip(runs, place, strict=True))
            self._fill(values[place], int(np.ravel_multi_index(index, self.shape[:count])), inner)
        squeezed = tuple(0 if isinstance(k, int | np.integer) else slice(None) for k in key)
        return values[squeezed]

    def _fill(self, values: Any, run: int, inner: list[Any]) -> None:
        """Read rows and cells of a run; its result may have fewer rows."""
        layout = self._layout
        if layout.states[run].state is not State.DONE or not values.size:
            return
        with StoredFile(layout.place(run) / RESULT_NAME, noted=False) as file:
            variable: Any = file.variables[self._name]
            kept = inner[0] < variable.shape[0]
            wanted = [inner[0][kept], *inner[1:]]
            if not wanted[0].size:
                return
            # Slices are read at once, single cells are picked from them.
            spans = tuple(slice(int(each.min()), int(each.max()) + 1) for each in wanted)
            read = variable[spans]
        values[kept] = read[np.ix_(*(each - each.min() for each in wanted))]


def lazy_fields(layout: JointLayout) -> xr.Dataset:
    """Fields that all runs store on the same grid, with their coordinates; empty without any."""
    described = layout.fields
    if described is None or not layout.done:
        return xr.Dataset()
    axis = described["axis"]
    with StoredFile(layout.place(layout.done[0]) / RESULT_NAME, noted=False) as file:
        coords = {
            name: (name, np.asarray(file.variables[name][:]), _attributes(file, name))
            for name in ("x", "y", *(() if axis in (layout.over, "step") else (axis,)))
        }
    rows = layout.steps if axis in (layout.over, "step") else len(described["instants"])
    arrays = {}
    for name in described["names"]:
        dims = (axis, "x", "y") if name in EVERY_FIELD else (axis, "x")
        sizes = (rows, *(coords[each][1].size for each in dims[1:]))
        lazy = indexing.LazilyIndexedArray(_SweepField(layout, name, sizes))
        attributes = (EVERY_FIELD | LINES)[name].attributes
        arrays[name] = (*((*layout.axes.dims, *dims),), lazy, attributes)
    return xr.Dataset(arrays, coords)


def _attributes(file: Any, name: str) -> dict[str, str]:
    return {key: file.variables[name].getncattr(key) for key in ("units", "long_name")}
