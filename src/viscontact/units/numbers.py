"""Numbers that users give: the units of arguments, and the conversion to float."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import Field
from numbers import Real
from typing import Any


def unit_of(owner: type, argument: str, control: str = "") -> str | None:
    """Return the unit of a dataclass field, from ``field(metadata={"unit": "m"})``.

    None for names, flags and other objects, which have no unit; "1" for dimensionless numbers. A
    unit that depends on the field `control` (force or approach) is a mapping in the metadata.
    """
    of_fields: dict[str, Field[Any]] = owner.__dataclass_fields__  # type: ignore[attr-defined]
    unit: str | Mapping[str, str] | None = of_fields[argument].metadata.get("unit")
    return unit[control] if isinstance(unit, Mapping) else unit


def as_real(value: object) -> float | None:
    """Return a plain number as a float.

    Parameters
    ----------
    value : object
        What the user gave.

    Returns
    -------
    float or None
        The number, inf for a whole number beyond all floats; None for a boolean, a text, an
        array or anything else that is no plain number.

    Examples
    --------
    >>> as_real(3), as_real(True), as_real("3"), as_real(10**400)
    (3.0, None, None, inf)
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf
