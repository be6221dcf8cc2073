"""Columns of a measured table that a series is fitted to, and the fit by the kind of test."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Unpack

from viscontact.backend.arrays import Floats
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.prony import FitOptions, fit_creep, fit_dynamic, fit_relaxation
from viscontact.tables import Table


def is_oscillation(table: Table) -> bool:
    """True if a table has a storage modulus over frequency, with or without a loss modulus."""
    has_loss = "loss_modulus" in table or "loss_tangent" in table
    return "storage_modulus" in table and (has_loss or "angular_frequency" in table)


def measured_columns(table: Table) -> tuple[Floats, dict[str, Floats]]:
    """Times [s] or angular frequencies [rad/s], and the columns by the names of a `Fit`."""
    if is_oscillation(table):
        columns = {"storage": table["storage_modulus"]}
        if "loss_modulus" in table:
            columns["loss"] = table["loss_modulus"]
        elif "loss_tangent" in table:
            columns["loss"] = columns["storage"] * table["loss_tangent"]
        return table["angular_frequency"], columns
    for quantity, name in (("relaxation_modulus", "modulus"), ("creep_compliance", "compliance")):
        if quantity in table:
            return table["time"], {name: table[quantity]}
    raise ValueError(
        f"{table.source.name}: needs a relaxation modulus or a creep compliance over time, or "
        "storage (and loss) modulus over frequency, or force and approach, or position and "
        "deflection, over time; "
        f"{table.contents}"
    )


def loss_note(measured: Mapping[str, Floats]) -> str | None:
    """Sentence on losses that were not measured; None where they were, or do not occur."""
    if "storage" not in measured or "loss" in measured:
        return None
    return (
        "there is no loss modulus: the losses of the law follow from the storage modulus alone, "
        "and only roughly at the ends of the frequencies"
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
        storage, loss = measured["storage"], measured.get("loss")
        return fit_dynamic(points, storage, loss, weights=weights, **options)
    [(name, values)] = measured.items()
    if weights is not None:
        raise ValueError(
            f"fit: weights go with storage and loss; of {name} alone, all rows have the same weight"
        )
    fit = fit_creep if name == "compliance" else fit_relaxation
    return fit(points, values, **options)
