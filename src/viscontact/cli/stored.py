"""Stored runs, opened or refused."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import xarray as xr

from viscontact.cli.messages import refuse
from viscontact.dataset import SCALARS
from viscontact.results import RESULT_NAME, open_results


@contextmanager
def opened(path: Path) -> Iterator[xr.Dataset]:
    """Open the result of a run, or refuse in one line.

    Parameters
    ----------
    path : Path
        A run's directory or a ``.nc`` file.

    Yields
    ------
    xarray.Dataset
        The result.
    """
    try:
        ds = open_results(path)
    except FileNotFoundError:
        refuse(f"{path}: no result there; `viscontact run CASE.yaml -o {path}` makes one")
    except (OSError, ValueError) as error:
        refuse(_unreadable(path, error))
    with ds:
        missing = [name for name in ("time", *SCALARS) if name not in ds]
        if missing:
            refuse(f"{path}: not a result of viscontact: it has no {missing[0]}")
        strange = [name for name in ("time", *SCALARS) if ds[name].dims != ("time",)]
        if strange:
            refuse(f"{path}: not a result of viscontact: its {strange[0]} is not over time")
        if not ds.sizes["time"]:
            refuse(f"{path}: the run was stopped before its first instant was complete")
        yield ds


def early_end(ds: xr.Dataset) -> str:
    """Say that a run ended before its last instant.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.

    Returns
    -------
    str
        A sentence; empty for a run that is complete, or does not say what it was to be.
    """
    try:
        total = len(json.loads(ds.attrs["case"])["times"])
    except (KeyError, TypeError, ValueError):  # a dataset of the user's own making
        return ""
    done = ds.sizes["time"]
    return f"the run stopped at {done} of {total} instants" if done < total else ""


def _unreadable(path: Path, error: Exception) -> str:
    # The reader's own words name the file again, and an error number.
    if isinstance(error, ValueError) and path.is_file():
        return f"{path} is no run directory and no netCDF file"
    if isinstance(error, ValueError):
        return f"{path}: its {RESULT_NAME} is no netCDF file"
    return f"{path}: {error}"
