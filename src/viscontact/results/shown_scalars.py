"""Scalars that are shown of a result: those that are of use for its contact and have values."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscontact.results.recorded_case import across_period, recorded_grid
from viscontact.results.variables import (
    OF_LEAKAGE,
    OF_LEAKAGE_Y,
    SCALARS,
    Place,
    is_of_period,
    per_length,
    shown_in,
)

if TYPE_CHECKING:
    from viscontact.results.stored_result import Result

#: Length of the contact over its width from which the line load is of use, as for rollers.
LONG = 3.0

#: Scalars that are shown of such contacts only.
OF_LONG_CONTACTS = ("peak_line_load",)

#: Scalars that may have no value where the approach has no datum.
WITH_DATUM = ("approach", "work", "loss_per_cycle", "dissipation", "heat")


def is_long(ds: Result) -> bool:
    """Test for a contact that is at least three widths long along x when it is largest."""
    # One that continues through the only period of a grid has no end.
    largest = int(np.nan_to_num(ds["contact_area"].values).argmax())
    length, width = (float(ds[f"contact_{name}"][largest]) for name in ("length", "width"))
    if across_period(ds) == "y" and length >= recorded_grid(ds).size[0]:
        return True
    return length >= LONG * width > 0


def is_shown(ds: Result, name: str) -> bool:
    """Test for a scalar that a result has and that is of use for it."""
    if name not in ds or is_of_period(name, ds):
        return False
    # Without a datum work has no value, and without a fluid that is driven a leak rate.
    perhaps = (*WITH_DATUM, *map(per_length, WITH_DATUM), *OF_LEAKAGE, *OF_LEAKAGE_Y)
    if name in perhaps and (values := ds[name].values).size and np.isnan(values).all():
        return False
    return name not in OF_LONG_CONTACTS or is_long(ds)


def is_line(ds: Result) -> bool:
    """Test for a line contact of one cell along its period, which is shown per unit length."""
    return per_length("force") in ds


def lacks_datum(ds: Result) -> bool:
    """Test for a line contact, whose approach has no datum."""
    approach = ds["approach"].values
    return bool(approach.size and np.isnan(approach).all())


def has_friction(ds: Result) -> bool:
    """Test for friction over speed, which has a figure of its own."""
    return "speed" in ds.dims and bool((ds["friction_coefficient"].values > 0).any())


def shown_scalars(ds: Result, place: Place) -> list[str]:
    """Names of the scalars of a result that are shown in a place, in its order."""
    return [name for name in shown_in(place, ds) if is_shown(ds, name)]


def shown_labels(ds: Result, place: Place) -> dict[str, str]:
    """Labels of the scalars of a result that are shown in a place, by their names."""
    return {name: SCALARS[name].label for name in shown_scalars(ds, place)}
