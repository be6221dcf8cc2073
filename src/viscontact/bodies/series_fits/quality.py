"""Quality of a series fit: whether it misses its data, and for which reason."""

from __future__ import annotations

import enum
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.spectrum import Observed, Spectrum, dense_spectrum

#: Relative residuals of a column beyond which a fit misses it: root mean square, and largest [-].
RMS_LIMIT, LARGEST_LIMIT = 0.10, 0.25
# A change of the fit is the reason if it removes at least half of the mean square residual.
_GREATER_PART = np.sqrt(0.5)


class Reason(enum.Enum):
    """Reason for which a series misses measured values; the value describes it."""

    TERMS = "the terms are too few"
    SOLID = "the data have an equilibrium modulus, which a fluid has not"
    DISAGREEMENT = "no series has such storage and loss together"
    SUPERPOSITION = "the sets of several temperatures do not join to one curve"
    LAW = "the law does not describe the record"
    SCATTER = "the data scatter"


@dataclass(frozen=True)
class Misfit:
    """Misfit of a series beyond 10 % (root mean square) or 25 % (largest) of a measured column.

    Attributes
    ----------
    reason : Reason
        What causes the greater part of it.
    message : str
        Size of the misfit, reason and remedy, in a sentence or two.

    Examples
    --------
    >>> import warnings
    >>> from viscontact.bodies.series_fits.prony import fit_creep
    >>> t = np.geomspace(1.0, 1e6, 25)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore")
    ...     fit = fit_creep(t, t**0.3, data="shear", terms=1)
    >>> fit.misfit.reason
    <Reason.TERMS: 'the terms are too few'>
    """

    reason: Reason
    message: str


def misfit_of(observed: Observed, found: Spectrum, names: Sequence[str]) -> Misfit | None:
    """Misfit of a spectrum to the columns with these names; None within the limits."""
    # Each possible reason is removed in turn, and the best fit with any number of terms compared.
    residuals = _by_column(observed, found, names)
    rms, largest = _rms(residuals), np.abs(residuals).max(axis=1)
    if rms.max() <= RMS_LIMIT and largest.max() <= LARGEST_LIMIT:
        return None
    # A few outlying rows are judged by the largest residual, as they hardly change the others.
    measure = _rms if rms.max() > RMS_LIMIT else _column_maxima
    enough = _GREATER_PART * measure(residuals).max()
    size = " and ".join(
        f"{name} by {_percent(r)} (root mean square, at most {_percent(most)})"
        for name, r, most in zip(names, rms, largest, strict=True)
    )
    for reason, freed, remedy in _freed_fits(observed, found, names):
        if measure(freed).max() <= enough:
            return Misfit(reason, f"the fit misses {size}: {reason.value}; {remedy}")
    column, row = divmod(int(np.argmax(np.abs(residuals))), residuals.shape[1])
    return Misfit(
        Reason.SCATTER,
        f"the fit misses {size}: {Reason.SCATTER.value}, and no number of terms fits them better; "
        f"look for rows that are wrong, such as {names[column]}, row {row}, or smooth the data",
    )


def _freed_fits(
    observed: Observed, found: Spectrum, names: Sequence[str]
) -> Iterator[tuple[Reason, Floats, str]]:
    """Best fits without one restriction each: the reason, their residuals, and the remedy."""
    dense = _by_column(observed, dense_spectrum(observed), names)
    reached = _percent(_rms(dense).max())
    count = found.times.size
    yield Reason.TERMS, dense, f"{count} are used, and more reach {reached}. Allow more terms"
    if observed.response.fluid:
        solid = replace(observed, response=replace(observed.response, fluid=False))
        freed = _by_column(solid, dense_spectrum(solid), names)
        reached = _percent(_rms(freed).max())
        yield Reason.SOLID, freed, f"a solid reaches {reached}. Leave out the option fluid"
    if len(names) > 1:
        alone = residuals_alone(observed)
        parts = ", ".join(
            f"{name} alone is met to {_percent(r)}"
            for name, r in zip(names, _rms(alone), strict=True)
        )
        yield (
            Reason.DISAGREEMENT,
            alone,
            f"they contradict the Kramers-Kronig relation ({parts}). Check units, frequencies "
            "and, of several temperatures, the superposition, or give the column that counts "
            "more weight",
        )


def residuals_alone(observed: Observed) -> Floats:
    """Relative residuals of storage and loss, each fitted alone [-], shape (2, rows)."""
    rows = observed.values.size // 2
    alone = [
        Observed(observed.response, observed.values, np.repeat(weights, rows))
        for weights in ((1.0, 0.0), (0.0, 1.0))
    ]
    return np.array(
        [
            one.residuals(dense_spectrum(one)).reshape(2, -1)[column]
            for column, one in enumerate(alone)
        ]
    )


def _by_column(observed: Observed, spectrum: Spectrum, names: Sequence[str]) -> Floats:
    return observed.residuals(spectrum).reshape(len(names), -1)


def _rms(residuals: Floats) -> Floats:
    return np.asarray(np.sqrt(np.mean(residuals**2, axis=1)))


def _column_maxima(residuals: Floats) -> Floats:
    return np.asarray(np.abs(residuals).max(axis=1))


def _percent(part: float) -> str:
    return f"{100 * part:.2g} %" if part > 1e-3 else "0.1 %"
