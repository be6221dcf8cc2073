"""Columns of a measured table that a series is fitted to, and the fit by the kind of test."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Unpack

from viscontact.backend.arrays import Floats
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.prony import FitOptions, fit_creep, fit_dynamic, fit_relaxation
from viscontact.tables import Table


def is_oscillation(table: Table) -> bool:
    """True if a table has a storage modulus, and a loss modulus or loss tangent."""
    return "storage_modulus" in table and ("loss_modulus" in table or "loss_tangent" in table)


def measured_columns(table: Table) -> tuple[Floats, dict[str, Floats]]:
    """Times [s] or angular frequencies [rad/s], and the columns by the names of a `Fit`."""
    if is_oscillation(table):
        storage = table["storage_modulus"]
        loss = table["loss_modulus"] if "loss_modulus" in table else storage * table["loss_tangent"]
        return table["angular_frequency"], {"storage": storage, "loss": loss}
    for quantity, name in (("relaxation_modulus", "modulus"), ("creep_compliance", "compliance")):
        if quantity in table:
            return table["time"], {name: table[quantity]}
    raise ValueError(
        f"{table.source.name}: needs a relaxation modulus or a creep compliance over time, or "
        "storage and loss modulus over frequency, or force and approach over time; "
        f"{table.contents}"
    )


def fit_measured(
    points: Floats,
    measured: Mapping[str, Floats],
    *,
    weights: Mapping[str, float] | None = None,
    **options: Unpack[FitOptions],
) -> Fit:
    """Fit a series by the kind of test: creep, relaxation or oscillation."""
    if "storage" in measured:
        storage, loss = measured["storage"], measured["loss"]
        return fit_dynamic(points, storage, loss, weights=weights, **options)
    [(name, values)] = measured.items()
    if weights is not None:
        raise ValueError(
            f"fit: weights go with storage and loss; of {name} alone, all rows have the same weight"
        )
    fit = fit_creep if name == "compliance" else fit_relaxation
    return fit(points, values, **options)
