"""Conventions of measured data: deviatoric, shear or uniaxial, and the bulk behaviour."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from viscontact.bodies.laws import CreepSeries, RelaxationSeries

Series = TypeVar("Series", CreepSeries, RelaxationSeries)

#: Constructors of a law in shear from a creep series, by the convention of the data.
CREEP: dict[str, Callable[..., CreepSeries]] = {
    "deviatoric": CreepSeries,
    "shear": CreepSeries.from_shear,
    "uniaxial": CreepSeries.from_uniaxial,
}
#: The same for a relaxation series.
MODULI: dict[str, Callable[..., RelaxationSeries]] = {
    "shear": RelaxationSeries,
    "uniaxial": RelaxationSeries.from_uniaxial,
}


def shear_law(
    owner: str, conventions: dict[str, Callable[..., Series]], data: str
) -> Callable[..., Series]:
    """Constructor of the law in shear from a series in the convention of the data."""
    if data not in conventions:
        raise ValueError(f"{owner}: data must be one of {', '.join(conventions)}, got {data!r}")
    return conventions[data]


def bulk_arguments(
    owner: str, data: str, poisson_ratio: float | None, bulk_modulus: float | None
) -> dict[str, float | None]:
    """Bulk arguments of uniaxial data [-, Pa], by name; other data take none."""
    if data == "uniaxial":
        return {"poisson_ratio": poisson_ratio, "bulk_modulus": bulk_modulus}
    if poisson_ratio is not None or bulk_modulus is not None:
        raise ValueError(
            f"{owner}: poisson_ratio and bulk_modulus go with uniaxial data only, got "
            f"data={data!r}; leave them out, the Material takes them"
        )
    return {}
