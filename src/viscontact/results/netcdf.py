"""Results on disk: CF netCDF-4."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from viscontact.results.accessor import ResultAccessor as ResultAccessor
from viscontact.results.checked_store import open_checked
from viscontact.results.digests import store_digests
from viscontact.results.seal import seal
from viscontact.results.stored_result import appending, open_replaceable


def save(ds: xr.Dataset, path: str | Path) -> None:
    """Save a result as CF netCDF-4, with the digests by which `open_results` notices damage.

    Parameters
    ----------
    ds : xarray.Dataset
        From `simulate`.
    path : path-like
        The file, by custom ending in ``.nc``; replaced if it is there.

    Examples
    --------
    >>> import tempfile, xarray
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(xarray.Dataset({"force": ("time", [1.0])}), Path(folder) / "run.nc")
    ...     with open_results(Path(folder) / "run.nc") as ds:
    ...         float(ds.force[0])
    1.0
    """
    ds.to_netcdf(path, format="NETCDF4", engine="netcdf4")
    written = Path(path).expanduser()
    with appending(written) as file:
        store_digests(file)
    seal(written)


def open_results(path: str | Path) -> xr.Dataset:
    """Open the result of a run; fields are read, and checked for damage, when used.

    Parameters
    ----------
    path : path-like
        A run directory or a ``.nc`` file.

    Returns
    -------
    xarray.Dataset
        As `simulate` returns it; a context manager that closes the file.

    Raises
    ------
    FileNotFoundError
        If there is no result.
    ValueError
        If the file cannot be read as netCDF, or is damaged; also when a field is read later.

    Notes
    -----
    A file without digests, such as one of ``xarray.Dataset.to_netcdf``, is opened and a line of the
    log says so.

    Examples
    --------
    >>> import tempfile
    >>> ds = xr.Dataset({"force": ("time", [1.0])}, coords={"time": [0.0]})
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(ds, Path(folder) / "run.nc")
    ...     with open_results(Path(folder) / "run.nc") as stored:
    ...         stored.force.dims
    ('time',)
    """
    return open_replaceable(path, open_checked)
