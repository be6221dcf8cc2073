"""Series fitted to an oscillation test that a case names as its material."""

from __future__ import annotations

import warnings

import numpy as np

from viscontact import tables
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies import series_fits


def fit_oscillation(
    table: tables.Table, data: str, poisson_ratio: float | None, bulk_modulus: float | None
) -> series_fits.Fit:
    """Fit a series to a table of storage and loss modulus; its misfit is no Python warning here."""
    points, measured = series_fits.measured_columns(table)
    options = series_fits.FitOptions(data=data)
    if data == "uniaxial":  # other data take no volume constants
        options |= {"poisson_ratio": poisson_ratio, "bulk_modulus": bulk_modulus}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", AccuracyWarning)
            return series_fits.fit_measured(points, measured, **options)
    except ValueError as error:
        raise ValueError(f"file: {table.located(error)}") from error


def fit_note(table: tables.Table, fit: series_fits.Fit) -> str:
    """Origin of the law in words: terms, residuals and range of the fit."""
    rms = " and ".join(
        f"{100 * np.sqrt(np.mean(each**2)):.2g} % of {name}" for name, each in fit.residuals.items()
    )
    weights = ", ".join(f"{name} {value:.3g}" for name, value in fit.weights.items())
    rest = series_fits.loss_note(fit.measured)
    return (
        f"the law is a relaxation series of {fit.terms} terms, fitted to {table.source.name} at "
        f"{fit.points.min():.4g} to {fit.points.max():.4g} rad/s with residuals of {rms} (root "
        f"mean square; weights {weights})" + (f"; {rest}" if rest else "")
    )


def fit_warning(table: tables.Table, fit: series_fits.Fit) -> str | None:
    """Warning of a fit that misses the table; None where it does not."""
    if fit.misfit is None:
        return None
    return f"{table.source.name}: {table.located(fit.misfit.message)}"
