"""Misfit of an indentation fit, and its warnings: open parameters, correlated residuals, depth."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.series_fits.quality import LARGEST_LIMIT, RMS_LIMIT, Misfit, Reason
from viscontact.bodies.series_fits.residual_noise import noise_of
from viscontact.identification.indentation_fit import IndentationFit
from viscontact.reference import SphereProfile
from viscontact.units.formatting import format_quantity

_VAGUE = 10.0  # ratio of an interval's bound to its value from which on it is undetermined
WIDENED = 1.5  # factor of an interval from which on its reason is given
_SMALLER = 3.0  # times: residuals without contact that are smaller by this are not the cause
_FEWEST = 10  # rows without contact that show a cause
SMALL = 1e-3  # of the largest force: no cause is looked for in smaller residuals
_PERIODIC = 0.3  # part of the residuals' power in one period
_PERIODS = 2.5  # fewer over the rows before contact are a curved baseline
_FINER = 16  # times as many periods as the rows resolve
_LEFT_OUT = "adhesion, a thin sample on a stiff base, or a tip of another shape"
_WELL_BEFORE = 0.8  # of the rows before contact
_DEEP = 0.1  # of the thickness of a film: a deeper indentation is of large strains
_WIDE = 0.5  # contact radius over radius of a sphere from which on it is no paraboloid


def misfit_of(fit: IndentationFit) -> Misfit | None:
    """Misfit of a law beyond the limits of series; None within them."""
    residuals = fit.residuals[np.isfinite(fit.residuals)]
    rms, largest = fit.residual, float(np.abs(residuals).max(initial=0.0))
    scatters = noise_of(residuals, len(fit.parameters)).is_white
    if rms <= RMS_LIMIT and (largest <= LARGEST_LIMIT or scatters):
        return None
    reason = Reason.SCATTER if scatters else Reason.LAW
    remedy = (
        "take means over more rows"
        if scatters
        else "choose another law, end the fit before the part that it misses, or look for "
        f"{_LEFT_OUT}"
    )
    quantity = "force" if fit.given == "approach" else "approach"
    return Misfit(
        reason,
        f"the fit misses the {quantity} by {100 * rms:.2g} % (root mean square, at most "
        f"{100 * largest:.2g} %) of the largest: {reason.value}; {remedy}",
    )


def fit_warnings(fit: IndentationFit) -> Iterator[str]:
    """Warnings of a fit, one by one."""
    yield from _open_parameters(fit)
    if fit.misfit is not None:
        yield fit.misfit.message
    elif fit.widening > WIDENED and fit.residual > SMALL:
        yield (
            f"the residuals ({100 * fit.residual:.2g} % of the largest value) are not noise: "
            f"{_cause(fit)}. The intervals are up to {fit.widening:.2g} times as wide for that"
        )
    yield from _depth(fit)


def _open_parameters(fit: IndentationFit) -> Iterator[str]:
    vague = [
        f"{name} ({low:.2g} to {high:.2g}{unit and f' {unit}'})"
        for (name, (low, high)), unit in zip(fit.intervals.items(), fit.units, strict=True)
        if high > _VAGUE**2 * low
    ]
    if vague:
        yield (
            f"the record leaves open {', '.join(vague)}; take a law with fewer parameters, or a "
            "record with other rates or a hold"
        )


def _cause(fit: IndentationFit) -> str:
    """Likely cause of correlated residuals."""
    free = _free_rows(fit)
    # A law that misses the contact turns the baseline a little, too.
    rest = _without_trend(fit.residuals[free]) if free.sum() > _FEWEST else np.zeros(1)
    smaller = np.sqrt(np.mean(rest**2)) < fit.residual / _SMALLER
    if fit.contact is None or smaller or noise_of(rest, 2).is_white:
        return f"the law misses the contact; look for another law, {_LEFT_OUT}"
    period = _period(fit, free)
    if period is not None:
        return (
            f"they repeat every {format_quantity(period, 'm', 2)} of the position, as the "
            "interference of the laser does"
        )
    return "the baseline drifts or is curved without contact"


def _without_trend(values: Floats) -> Floats:
    """Values less the best line over their number."""
    line = np.polynomial.Polynomial.fit(np.arange(values.size), values, 1)
    return np.asarray(values - line(np.arange(values.size)))


def _free_rows(fit: IndentationFit) -> Bools:
    """Fitted rows well before contact, which a misfit of the contact does not reach."""
    touched = np.flatnonzero(np.nan_to_num(fit.fitted) > 0)
    free = _WELL_BEFORE * (touched[0] if touched.size else fit.fitted.size)
    return (np.arange(fit.fitted.size) < free) & np.isfinite(fit.residuals)


def _period(fit: IndentationFit, free: Bools) -> float | None:
    """Period over the position of residuals without contact [m]; None if no one stands out."""
    way, residuals = fit.record.approach[free], _without_trend(fit.residuals[free])
    if way.size < 32 or np.ptp(way) == 0:
        return None
    order = np.argsort(way)
    even = np.linspace(way.min(), way.max(), way.size)
    spaced = np.interp(even, way[order], residuals[order])
    power = np.abs(np.fft.rfft(spaced, _FINER * spaced.size)) ** 2
    least = int(_FINER * _PERIODS)
    peak = least + int(np.argmax(power[least:]))
    share = power[max(peak - _FINER, 0) : peak + _FINER + 1].sum() / power[1:].sum()
    # The rows cover as many spacings as there are rows.
    extent = float(np.ptp(way)) * spaced.size / (spaced.size - 1)
    return extent * _FINER / peak if share > _PERIODIC else None


def _depth(fit: IndentationFit) -> Iterator[str]:
    """Warnings of an indentation beyond small strains, or beyond a paraboloid for a sphere."""
    profile, deepest = fit.record.profile, fit.deepest
    if fit.thickness is not None and deepest > _DEEP * fit.thickness:
        yield (
            f"the largest depth of {format_quantity(deepest, 'm', 3)} is "
            f"{100 * deepest / fit.thickness:.2g} % of the thickness of the film: the solution "
            "holds for small strains; end the fit before with until"
        )
    if not isinstance(profile, SphereProfile) or deepest <= 0:
        return
    radius = np.sqrt(profile.radius * deepest)
    if radius > _WIDE * profile.radius:
        yield (
            f"at a depth of {format_quantity(deepest, 'm', 3)}, {deepest / profile.radius:.2g} "
            f"radii, the contact is {radius / profile.radius:.2g} radii wide from its centre: the "
            "solution holds for the paraboloid of this radius, not for a sphere, whose force is "
            f"{_excess(deepest / profile.radius)}; end the fit before, or fit through the simulator"
        )


def _excess(depth: float) -> str:
    """Words on the force on an elastic body under a sphere instead, at a depth over its radius."""
    # Sneddon (1965): F = E* R² [(a² + 1)/2 ln((1 + a)/(1 - a)) - a], depth = a/2 ln(...).
    low, high = 0.0, 1.0 - 1e-12
    for _ in range(100):
        a = (low + high) / 2
        low, high = (a, high) if a / 2 * np.log((1 + a) / (1 - a)) < depth else (low, a)
    force = (a * a + 1) / 2 * np.log((1 + a) / (1 - a)) - a
    less = 1 - force / (4 / 3 * depth**1.5)
    return f"{100 * less:.2g} % smaller" if depth <= 1 else "another one altogether"
