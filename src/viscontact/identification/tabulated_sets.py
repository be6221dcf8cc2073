"""Tests of a material in a table, at one temperature or several, and the volume of their fit."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

from viscontact.bodies.materials.material import Material
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.table_fit import measured_columns
from viscontact.identification.isotherm import Isotherm
from viscontact.tables import Table

_ROOM = 293.15  # [K]


def isotherms_of(sets: Sequence[Table]) -> list[Isotherm]:
    """Return the sets of a table, each at its temperature; ValueError names what is missing."""
    return [_isotherm(one) for one in sets]


def usual_reference(isotherms: Sequence[Isotherm]) -> float:
    """Return the temperature of the set nearest to 20 °C [K]."""
    return min((each.temperature for each in isotherms), key=lambda kelvin: abs(kelvin - _ROOM))


def with_volume(fit: Fit, poisson_ratio: float | None, bulk_modulus: float | None) -> Fit:
    """Return the fit with given volume constants, which shear data do not determine."""
    if fit.data == "uniaxial" or (poisson_ratio is None and bulk_modulus is None):
        return fit
    material = Material(fit.law, poisson_ratio, bulk_modulus=bulk_modulus)
    return dataclasses.replace(
        fit, poisson_ratio=material.poisson_ratio, bulk_modulus=material.bulk_modulus
    )


def _isotherm(one: Table) -> Isotherm:
    if one.temperature is None:
        raise ValueError(
            f"{one.source.name}: several sets need a column of temperatures to be joined"
        )
    try:
        return Isotherm(one.temperature, *measured_columns(one))
    except ValueError as error:
        raise ValueError(one.located(error)) from None
