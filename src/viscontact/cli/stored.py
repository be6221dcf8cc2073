"""Stored runs, opened or refused."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import xarray as xr

from viscontact.cli.messages import refuse
from viscontact.dataset import SCALARS
from viscontact.results import open_results


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
        refuse(f"{path}: {error}")
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
