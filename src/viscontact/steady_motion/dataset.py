"""From contacts at several speeds to a labelled xarray dataset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr

from viscontact.problem.kept_fields import ALL_FIELDS, NO_FIELDS
from viscontact.results.dataset import to_dataset
from viscontact.state import ContactState
from viscontact.steady_motion.preparation import SteadySetup
from viscontact.steady_motion.record import errors_by_name, on_grid, steady_attributes
from viscontact.steady_motion.region import common_grid


def steady_dataset(
    run: SteadySetup,
    states: Sequence[ContactState],
    bars: Sequence[Mapping[str, float]] | None,
    attributes: Mapping[str, Any],
) -> xr.Dataset:
    """Label the contacts at the speeds so far, with their error bars if they are known."""
    grid = common_grid([state.grid for state in states])
    fields = ALL_FIELDS if all(state.pressure.size for state in states) else NO_FIELDS
    errors = None if bars is None else errors_by_name(bars)
    found = [on_grid(state, grid) for state in states]
    return to_dataset(found, fields, steady_attributes(run, grid) | dict(attributes), errors)
