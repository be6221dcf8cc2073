"""How accurate a run is, by its own account."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import xarray as xr

from viscontact.plot.readable import display_unit
from viscontact.report.inputs import case_of, prescribes_approach
from viscontact.stated_errors import MESH_DEPENDENT, WHY_MESH_DEPENDENT, largest_error
from viscontact.units import (
    in_error_digits,
    in_percent,
    in_supported_digits,
    in_words,
    is_rounding_tilt,
)
from viscontact.variables import SCALARS

_ROWS = (
    *("force", "eccentricity_x", "eccentricity_y", "approach", "tilt_x", "tilt_y"),
    *("contact_area", "contact_length", "contact_width", "peak_pressure", "mean_pressure", "work"),
    "loss_per_cycle",
)
#: Exactly centred loads leave eccentricities of rounding size [m].
_NEGLIGIBLE = 1e-12


def error_rows(ds: xr.Dataset) -> list[tuple[str, ...]]:
    """Return the table of results and their errors.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.

    Returns
    -------
    list of tuple of str
        Name with unit, value at the end, largest value, largest error, and that as a part of the
        largest value.
    """
    return [_row(ds, name) for name in told_scalars(ds)]


def told_scalars(ds: xr.Dataset) -> list[str]:
    """Return which scalars of a result a table tells of: not those that are rounding.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    """
    return [name for name in _ROWS if name in ds and not _is_rounding(ds, name)]


def accuracy_lines(ds: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Yield what else is known of a run's accuracy, name and account.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    """
    residual = ds["residual"].values
    tolerance = float(ds.attrs.get("tolerance", math.nan))
    asked = "" if math.isnan(tolerance) else f"; asked for: {tolerance:.1e}"
    yield (
        "Residual",
        f"{float(residual.max(initial=0.0)):.1e} at most, of the largest displacement{asked}. "
        "The gap under pressure and penetration elsewhere are no larger.",
    )
    yield "Balance", _balance(ds)
    yield "Time steps", _steps(ds)
    yield "Cells", _cells(ds)
    if memory := str(ds.attrs.get("memory", "")):
        yield "Memory of the past", memory
    inversion = float(ds.attrs.get("inversion_error", 0.0))
    if inversion > 0:
        yield "Law", f"converted numerically, within {inversion:.1e} (estimated)"
    yield "Companions", _companions(ds)
    if _is_marked(ds):
        yield "Depends on the mesh", f"{WHY_MESH_DEPENDENT}."


def _row(ds: xr.Dataset, name: str) -> tuple[str, ...]:
    values = np.asarray(ds[name].values, dtype=np.float64)
    given = values[np.isfinite(values)]
    unit = display_unit(SCALARS[name].units, given)
    found = largest_error(ds, name)
    half_width = math.nan if found is None else found.half_width
    shown = [
        in_supported_digits(float(value) / unit.factor, half_width / unit.factor)
        for value in (values[-1], given[np.abs(given).argmax()])
    ]
    error, part = "not known", ""
    if math.isinf(half_width):
        error = MESH_DEPENDENT
    elif found is not None and not math.isnan(half_width):
        error, part = in_error_digits(half_width / unit.factor), in_percent(found.part)
        if found.unknown:
            part += f"; not known at {found.unknown} instants"
    return f"{name.replace('_', ' ')} [{unit.symbol}]", *shown, error, part


def _is_rounding(ds: xr.Dataset, name: str) -> bool:
    values = np.asarray(ds[name].values, dtype=np.float64)
    largest = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
    if name.startswith("tilt"):
        return is_rounding_tilt(values, ds["contact_length"].values, ds["approach"].values)
    return largest <= (_NEGLIGIBLE if name.startswith("eccentricity") else 0.0)


def _balance(ds: xr.Dataset) -> str:
    if prescribes_approach(ds):
        return "the approach is prescribed; the force is the pressure's integral"
    known = largest_error(ds, "force")
    if known is None or not math.isfinite(known.part):
        return "force and moments of the pressure are those of the load, to the tolerance asked for"
    return (
        f"the pressure's integral is the load within {in_percent(known.part)} of it; its moments "
        "are the load's to the tolerance asked for"
    )


def _steps(ds: xr.Dataset) -> str:
    largest = float(np.nanmax(ds["time_error"].values, initial=0.0))
    if largest > 0:
        return f"they cost at most {in_percent(largest)} of the pressure (estimated)"
    if _is_elastic(ds):
        return "they cost nothing: the contact at each instant follows from the load alone"
    return "what they cost is not estimated step by step; it is part of the errors above"


def _cells(ds: xr.Dataset) -> str:
    across = ds["cells_across"].values
    touching = across[ds["contact_area"].values > 0]
    x, y = ds["x"].values, ds["y"].values
    size = ""
    if x.size > 1 and y.size > 1:
        size = (
            f" of {in_words(float(x[1] - x[0]), 'm', 3)} × {in_words(float(y[1] - y[0]), 'm', 3)}"
        )
    counted = f"{x.size} × {y.size} cells{size}"
    if not touching.size:
        return counted
    return f"{counted}; {int(touching.max())} across the contact, the shorter way, when largest"


def _companions(ds: xr.Dataset) -> str:
    if not any(str(name).endswith("_error") and name != "time_error" for name in ds.data_vars):
        return "none were run: no errors of the numbers above are known"
    return (
        "two coarser runs beside this one, from which the errors are extrapolated: of 100 true "
        "errors 95 are meant to lie within the ones that are stated"
    )


def _is_elastic(ds: xr.Dataset) -> bool:
    material = case_of(ds).get("material") or {}
    return bool((material.get("law") or {}).get("type") == "Elastic")


def _is_marked(ds: xr.Dataset) -> bool:
    found = (largest_error(ds, name) for name in _ROWS if name in ds)
    return any(each is not None and math.isinf(each.half_width) for each in found)
