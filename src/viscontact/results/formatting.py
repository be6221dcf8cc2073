"""Numbers with their errors, as they stand in sentences and tables."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.results.stated_errors import MESH_DEPENDENT, stated_error
from viscontact.results.variables import SCALARS
from viscontact.units.error_digits import in_error_digits, in_supported_digits
from viscontact.units.formatting import ReadableUnit, in_digits, in_words, readable_unit

#: Digits of a number at most, whatever its error.
_DIGITS = 7
#: Errors of so small a part are not worth a word.
NEGLIGIBLE = 1e-4


def told(value: float, error: float, units: str) -> str:
    """Write a number with its error and unit.

    Parameters
    ----------
    value, error : float
        The number and the half width of its error bar [SI]: NaN where not known, inf where the
        number depends on the mesh.
    units : str
        The SI unit.

    Returns
    -------
    str
        The number, with as many digits as its error supports.

    Examples
    --------
    >>> told(57.634e-6, 0.149e-6, "m2"), told(152.2e6, math.inf, "Pa")
    ('57.63 ± 0.15 mm²', '152.2 MPa (depends on the mesh)')
    """
    if not error > NEGLIGIBLE * abs(value) or math.isinf(error):
        number = in_words(value, units)
        return f"{number} ({MESH_DEPENDENT})" if math.isinf(error) else number
    unit = readable_unit(value, units)
    return f"{told_in(unit, value, error)} {unit.symbol}".rstrip()


def told_in(unit: ReadableUnit, value: float, error: float) -> str:
    """Write a number with its error in the unit of a table.

    Parameters
    ----------
    unit : ReadableUnit
        The unit.
    value, error : float
        As in `told` [SI].

    Returns
    -------
    str
        The number, with as many digits as its error supports, and the error unless it is
        negligible; behind ``>`` a number that depends on the mesh.

    Examples
    --------
    >>> table = readable_unit(0.08, "m")
    >>> told_in(table, 0.0576344, 0.000149), told_in(table, 0.0576344, 0.0)
    ('57.63 ± 0.15', '57.63')
    """
    number, half_width = value / unit.factor, error / unit.factor
    if math.isinf(error):
        return in_supported_digits(number, half_width)
    if not error > NEGLIGIBLE * abs(value):
        return in_digits(number)
    bar = in_error_digits(half_width).replace("±", "± ")
    return f"{in_supported_digits(number, half_width, _DIGITS)} {bar}"


def errors_of(ds: xr.Dataset, name: str) -> NDArray[np.float64]:
    """Return the errors of a scalar, NaN at all instants if the result states none.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    name : str
        The scalar.
    """
    error = stated_error(ds, name)
    return np.full(ds.sizes["time"], np.nan) if error is None else error


def told_at(ds: xr.Dataset, name: str, index: int) -> str:
    """Write a scalar of a result at an instant, with its error.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    name : str
        The scalar.
    index : int
        The instant.
    """
    return told(float(ds[name][index]), float(errors_of(ds, name)[index]), SCALARS[name].units)


def headline(ds: xr.Dataset) -> str:
    """Say in a sentence what a run found.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.

    Returns
    -------
    str
        The contact at the last instant, or when it was largest if it is lost by then.
    """
    instants, area = ds["time"].values, ds["contact_area"].values
    end = in_words(float(instants[-1]), "s")
    if not np.any(area > 0):
        return f"Until t = {end} the bodies do not touch."
    if area[-1] > 0:
        return f"After {end} {_contact(ds, -1)}."
    largest = int(area.argmax())
    lost = in_words(float(instants[int(np.flatnonzero(area > 0)[-1]) + 1]), "s")
    return (
        f"At t = {in_words(float(instants[largest]), 's')}, when it is largest, "
        f"{_contact(ds, largest)}. The bodies come apart: from t = {lost} to the end, t = {end}, "
        "they do not touch."
    )


def _contact(ds: xr.Dataset, index: int) -> str:
    force, area, approach = (
        told_at(ds, name, index) for name in ("force", "contact_area", "approach")
    )
    said = f"the contact covers {area} under {force}; "
    peak = told_at(ds, "peak_pressure", index)
    return said + f"the approach is {approach} and the peak pressure {peak}"
