"""Histories: which scalars of a run are drawn over time or speed."""

from __future__ import annotations

import xarray as xr

from viscontact.results.stated_errors import is_centred, is_rounding
from viscontact.results.variables import SCALARS


def is_idle(run: xr.Dataset, name: str) -> bool:
    """Test for rounding under a centred load, on an elastic body, or across the motion."""
    return is_rounding(run, name) if SCALARS[name].moving else is_centred(run, name)
