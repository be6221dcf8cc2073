"""Weights of storage and loss in a fit to both."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from viscontact.bodies.series_fits.quality import residuals_alone
from viscontact.bodies.series_fits.spectrum import Observed
from viscontact.units.numbers import positive

_LARGEST_RATIO = 30.0


def given_weights(
    owner: str, weights: Mapping[str, float], names: tuple[str, ...]
) -> dict[str, float]:
    """Weights of all columns, those not given 1."""
    for name in weights:
        if name not in names:
            raise ValueError(
                f"{owner}: weights are those of {' and '.join(names)}, got one of {name!r}"
            )
    place = f"{owner}: the weight of"
    return {name: positive(f"{place} {name}", weights.get(name, 1.0)) for name in names}


def scatter_weights(
    observed: Observed, tolerance: float, names: tuple[str, ...]
) -> dict[str, float]:
    """Weights by the inverse scatter of each column about the best fit to it alone, least 1."""
    # Scatter below `tolerance` [-] is not distinguished. The scatter about a common fit would count
    # a contradiction between the columns as scatter of one of them, which then has no weight.
    scatter = np.sqrt(np.mean(residuals_alone(observed) ** 2, axis=1))
    # Limits: scatter within the tolerance is equal, and no column loses its weight.
    scatter = np.maximum(scatter, max(tolerance, scatter.max() / _LARGEST_RATIO, 1e-12))
    return dict(zip(names, (scatter.max() / scatter).tolist(), strict=True))


def weighted(observed: Observed, weights: Mapping[str, float]) -> Observed:
    """Measured values with weights of their columns, root mean square 1."""
    each = np.array(list(weights.values()))
    each = each / np.sqrt(np.mean(each**2))
    rows = observed.values.size // each.size
    return Observed(observed.response, observed.values, np.repeat(each, rows))
