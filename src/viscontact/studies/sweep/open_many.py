"""Joint result of a sweep."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, overload

import numpy as np
import xarray as xr

from viscontact.results.netcdf import open_results
from viscontact.studies.sweep.joint_layout import JointLayout, joint_layout
from viscontact.studies.sweep.lazy_fields import lazy_fields


@overload
def open_many(directory: str | Path, *, tree: Literal[False] = False) -> xr.Dataset: ...
@overload
def open_many(directory: str | Path, *, tree: Literal[True]) -> xr.DataTree: ...
def open_many(directory: str | Path, *, tree: bool = False) -> xr.Dataset | xr.DataTree:
    """Open the results of a sweep as one dataset; fields are read when used.

    Parameters
    ----------
    directory : path-like
        Directory of a sweep, which holds ``runs.jsonl``.
    tree : bool, optional
        Return a tree with the dataset at ``/sweep`` and the result of each finished run at
        ``/runs/NAME``, as `open_results` returns it: also where runs have different grids.

    Returns
    -------
    xarray.Dataset or xarray.DataTree
        Scalars of all runs with their errors, in SI units. The varied keys are dimensions if the
        runs are all combinations of their values; otherwise the dimension is ``run``, along which
        the keys are coordinates. Coordinates are numbers in SI with the attribute ``units``, or
        text. Runs with common instants share the dimension ``time``. Others have the dimension
        ``step`` and the coordinate ``time`` over both, filled up with NaN; nothing is interpolated.
        In steady motion ``speed`` takes the place of ``time``. The variables ``state`` (waiting,
        running, stopped, failed or done) and ``message`` belong to each run; scalars and fields are
        NaN unless it is done. Fields are included if all finished runs store them at the same
        instants on the same grid. If any run
        was computed with settings of its own, ``changed`` has them as text, empty for the others;
        ``verdict`` likewise has the worst verdict on the allowable values of each run, and
        ``decided_by`` the quantities with this verdict, empty if all have passed; and ``warnings``
        those of each run, one a line.

    Raises
    ------
    FileNotFoundError
        If the directory holds no manifest.
    ValueError
        If the manifest is damaged.

    Notes
    -----
    Scalars are read into memory at once, in 1 to 3 ms a run. A field opens the results of those
    runs that are selected, one at a time, when its values are used; `Dataset.chunk` divides it for
    dask.

    Examples
    --------
    >>> import tempfile
    >>> from viscontact.studies.sweep.manifest import SweepRun, write_manifest
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     common = (("load.force",), "ball.yaml", "grid")
    ...     runs = [
    ...         SweepRun(0, "force=5kN", "ball_force=5kN", {"load.force": "5 kN"}, *common),
    ...         SweepRun(1, "force=9kN", "ball_force=9kN", {"load.force": "9 kN"}, *common),
    ...     ]
    ...     path = write_manifest(Path(folder), runs)
    ...     ds = open_many(folder)
    >>> ds["load.force"].values.tolist(), ds.state.values.tolist()
    ([5000.0, 9000.0], ['waiting', 'waiting'])
    """
    layout = joint_layout(directory)
    ds = _with_scalars(layout)
    if not tree:
        return ds.merge(lazy_fields(layout), combine_attrs="override")
    runs = {f"/runs/{layout.runs[n].name}": open_results(layout.place(n)) for n in layout.done}
    return xr.DataTree.from_dict({"/sweep": ds, **runs})


def _with_scalars(layout: JointLayout) -> xr.Dataset:
    whole = {name: np.empty((len(layout.runs), layout.steps)) for name in layout.names}
    for runs, values in layout.blocks():
        for column, array in enumerate(whole.values()):
            array[runs] = values[:, column]
    scalars = {
        name: (layout.scalar_dims, array.reshape(layout.scalar_shape), layout.attributes(name))
        for name, array in whole.items()
    }
    ds = layout.frame().assign(scalars)
    return ds.set_coords(layout.over) if layout.over in ds else ds
