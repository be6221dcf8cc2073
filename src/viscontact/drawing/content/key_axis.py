"""Axis of a varied key of a sweep: its unit, scale and texts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.backend.arrays import Floats
from viscontact.results.sweep_axes import key_label
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit

#: Least ratio of the largest to the least value on a logarithmic axis.
_DECADE = 9.0


@dataclass(frozen=True)
class KeyAxis:
    """Axis of a key: numbers in a readable unit, or texts at equal distances."""

    name: str
    unit: ReadableUnit
    texts: tuple[str, ...]  # empty for numbers
    span: float = 1.0  # ratio of the largest to the least value of a logarithmic axis, else 1

    @classmethod
    def of(cls, ds: xr.Dataset, key: str) -> KeyAxis:
        """Return the axis of a key of a sweep."""
        values = ds[key].values
        if not is_number(ds, key):
            texts = tuple(dict.fromkeys(map(str, values.ravel())))
            return cls(key_label(key), ReadableUnit("", 1.0), texts)
        known = np.unique(values[np.isfinite(values)])
        unit = readable_unit(ds[key].attrs.get("units", "1"), known)
        span = float(known[-1] / known[0]) if _suits_logarithm(known) else 1.0
        return cls(key_label(key), unit, (), span)

    @property
    def is_log(self) -> bool:
        """True for a logarithmic axis."""
        return self.span > 1.0

    def at(self, values: NDArray[np.generic]) -> Floats:
        """Places of values on the axis."""
        if self.texts:
            return np.array([self.texts.index(str(value)) for value in values], dtype=np.float64)
        return self.unit(values)


def key_labels(ds: xr.Dataset, key: str) -> list[str]:
    """Values of a key for a legend."""
    values = ds[key].values
    if not is_number(ds, key):
        return [str(value) for value in values]
    unit = readable_unit(ds[key].attrs.get("units", "1"), values)
    return [f"{format_compact(float(value))} {unit.symbol}".strip() for value in unit(values)]


def _suits_logarithm(values: Floats) -> bool:
    """Test for increasing values over a decade or so whose ratios vary less than their steps."""
    if values[0] <= 0 or values[-1] < _DECADE * values[0]:
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return bool(ratios.std() / ratios.mean() < steps.std() / steps.mean())


def is_number(ds: xr.Dataset, key: str) -> bool:
    """True if the values of a key are numbers."""
    return bool(np.issubdtype(ds[key].dtype, np.number))
