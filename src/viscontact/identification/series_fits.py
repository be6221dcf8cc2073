"""Fits of series to measured functions, which this room offers beside its own."""

from viscontact.bodies.series_fits import (
    Fit,
    FoundShift,
    Misfit,
    Reason,
    fit_creep,
    fit_dynamic,
    fit_relaxation,
)

__all__ = [
    "Fit",
    "FoundShift",
    "Misfit",
    "Reason",
    "fit_creep",
    "fit_dynamic",
    "fit_relaxation",
]
