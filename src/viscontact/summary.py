"""What a run found, a row for each scalar, in readable units."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr

from viscontact.stated_errors import MESH_DEPENDENT, largest_error, stated_error
from viscontact.units import (
    in_error_digits,
    in_percent,
    in_supported_digits,
    is_rounding_tilt,
    readable_unit,
)
from viscontact.variables import SCALARS

_ROWS = (
    *("force", "eccentricity_x", "eccentricity_y", "approach", "tilt_x", "tilt_y"),
    *("contact_area", "contact_length", "contact_width", "peak_pressure", "mean_pressure", "work"),
    "loss_per_cycle",
)
# Exactly centred loads leave eccentricities of rounding size [m].
_NEGLIGIBLE = 1e-12


@dataclass(frozen=True)
class SummaryRow:
    """A scalar of a run in words, no digit more than its error supports.

    Attributes
    ----------
    name : str
        Its name in the result.
    unit : str
        The unit of the numbers.
    first, last, largest : str
        At the first and the last instant, and the largest magnitude.
    error : str
        The largest error, and as a part of the largest value.
    """

    name: str
    unit: str
    first: str
    last: str
    largest: str
    error: str

    @property
    def title(self) -> str:
        """Its name in words."""
        return self.name.replace("_", " ")


def summary_rows(ds: xr.Dataset) -> list[SummaryRow]:
    """Return what a run found.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.

    Returns
    -------
    list of SummaryRow
        One for each scalar that is more than rounding.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), vc.Grid((64, 64), (2e-3, 2e-3)))
    >>> row = next(row for row in summary_rows(ds) if row.name == "force")
    >>> row.title, row.unit, row.last
    ('force', 'mN', '100.0')
    """
    return [_row(ds, name) for name in _ROWS if not _is_rounding(ds, name)]


def _row(ds: xr.Dataset, name: str) -> SummaryRow:
    values, error = ds[name].values, stated_error(ds, name)
    largest = _largest(ds, name)
    unit = readable_unit(largest, SCALARS[name].units)
    bars = np.full(len(values), np.nan) if error is None else error
    at_largest = int(np.nanargmax(np.abs(values)))
    first, last, most = (
        in_supported_digits(float(value) / unit.factor, float(bar) / unit.factor)
        for value, bar in (
            (values[0], bars[0]),
            (values[-1], bars[-1]),
            (largest, bars[at_largest]),
        )
    )
    return SummaryRow(name, unit.symbol, first, last, most, _error_told(ds, name, unit.factor))


def _error_told(ds: xr.Dataset, name: str, factor: float) -> str:
    """The largest error, in the row's unit and as a part of the largest value."""
    found = largest_error(ds, name)
    if found is None or math.isnan(found.half_width):
        return "not known"
    if math.isinf(found.half_width):
        return MESH_DEPENDENT
    return f"{in_error_digits(found.half_width / factor)} ({in_percent(found.part)})"


def _largest(ds: xr.Dataset, name: str) -> float:
    values = ds[name].values
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


def _is_rounding(ds: xr.Dataset, name: str) -> bool:
    if name.startswith("tilt"):
        lengths, approaches = ds["contact_length"].values, ds["approach"].values
        return is_rounding_tilt(ds[name].values, lengths, approaches)
    return _largest(ds, name) <= (_NEGLIGIBLE if name.startswith("eccentricity") else 0.0)
