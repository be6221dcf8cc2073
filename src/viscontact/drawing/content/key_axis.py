"""Axis of a varied key of a sweep: its unit, scale and texts."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import Axis
from viscontact.results.sweep_axes import key_label
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit
from viscontact.units.parsing import parse_any_quantity

#: Units that are printed otherwise than they are typed.
_PRINTED = {"degC": "°C", "degF": "°F", "deg": "°"}
#: Least ratio of the largest to the least value on a logarithmic axis.
_DECADE = 9.0


def key_axis(ds: xr.Dataset, key: str) -> Axis:
    """Axis of a key: numbers in a readable unit, or texts at equal distances."""
    if not is_number(ds, key):
        texts = tuple(dict.fromkeys(map(str, ds[key].values.ravel())))
        return Axis(key_label(key), ReadableUnit("", 1.0), texts=texts)
    known = np.unique(ds[key].values[np.isfinite(ds[key].values)])
    unit = _unit_of(ds, key, known)
    return Axis(key_label(key), unit, scale="log" if _suits_logarithm(known) else "linear")


def places_on(axis: Axis, values: NDArray[np.generic]) -> Floats:
    """Places of values of a key on its axis: numbers [SI], or positions of texts."""
    if not axis.texts:
        return np.asarray(values, dtype=np.float64)
    return np.array([axis.texts.index(str(value)) for value in values], dtype=np.float64)


def key_labels(ds: xr.Dataset, key: str) -> list[str]:
    """Values of a key for a legend."""
    values = ds[key].values
    if not is_number(ds, key):
        return [str(value) for value in values]
    unit = _unit_of(ds, key, values)
    return [f"{format_compact(float(value))} {unit.symbol}".strip() for value in unit(values)]


def _unit_of(ds: xr.Dataset, key: str, values: Floats) -> ReadableUnit:
    """Unit in which all values of a key were typed, otherwise the one that reads best."""
    typed, si = ds[key].attrs.get("typed_unit"), str(ds[key].attrs.get("units", "1"))
    if typed and values.size:
        with suppress(ValueError):
            (zero, own), (one, _) = (parse_any_quantity(f"{n} {typed}") for n in (0, 1))
            if own == si:
                return ReadableUnit(
                    _PRINTED.get(typed, typed.replace("um", "µm")), one - zero, zero
                )
    return readable_unit(si, values)


def _suits_logarithm(values: Floats) -> bool:
    """Test for increasing values over a decade or so whose ratios vary less than their steps."""
    if values[0] <= 0 or values[-1] < _DECADE * values[0]:
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return bool(ratios.std() / ratios.mean() < steps.std() / steps.mean())


def is_number(ds: xr.Dataset, key: str) -> bool:
    """True if the values of a key are numbers."""
    return bool(np.issubdtype(ds[key].dtype, np.number))
