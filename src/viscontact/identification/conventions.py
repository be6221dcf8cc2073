"""What measured values stand for: in which terms the data are, and what is known of the volume."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from viscontact.laws import CreepSeries, RelaxationSeries

Series = TypeVar("Series", CreepSeries, RelaxationSeries)

#: How a law in shear is made of a creep series in the terms of the data.
CREEP: dict[str, Callable[..., CreepSeries]] = {
    "deviatoric": CreepSeries,
    "shear": CreepSeries.from_shear,
    "uniaxial": CreepSeries.from_uniaxial,
}
#: Likewise of a relaxation series.
MODULI: dict[str, Callable[..., RelaxationSeries]] = {
    "shear": RelaxationSeries,
    "uniaxial": RelaxationSeries.from_uniaxial,
}


def in_shear(
    owner: str, conventions: dict[str, Callable[..., Series]], data: str
) -> Callable[..., Series]:
    """Return what makes a law in shear of a series in the terms of the data.

    Parameters
    ----------
    owner : str
        Who asks, for the message.
    conventions : dict of str to callable
        `CREEP` or `MODULI`.
    data : str
        The terms.

    Raises
    ------
    ValueError
        If such data have no such terms.
    """
    if data not in conventions:
        raise ValueError(f"{owner}: data must be one of {', '.join(conventions)}, got {data!r}")
    return conventions[data]


def in_volume(
    owner: str, data: str, poisson_ratio: float | None, bulk_modulus: float | None
) -> dict[str, float | None]:
    """Return what uniaxial data need besides, by name; other data need nothing.

    Parameters
    ----------
    owner : str
        Who asks, for the message.
    data : str
        The terms of the data.
    poisson_ratio, bulk_modulus : float or None
        As given [-, Pa].

    Raises
    ------
    ValueError
        If one of them is given with data in shear.

    Examples
    --------
    >>> in_volume("fit_creep", "uniaxial", 0.4, None)
    {'poisson_ratio': 0.4, 'bulk_modulus': None}
    """
    if data == "uniaxial":
        return {"poisson_ratio": poisson_ratio, "bulk_modulus": bulk_modulus}
    if poisson_ratio is not None or bulk_modulus is not None:
        raise ValueError(
            f"{owner}: poisson_ratio and bulk_modulus go with uniaxial data only, got "
            f"data={data!r}; leave them out, the Material takes them"
        )
    return {}
