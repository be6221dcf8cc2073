"""Mean compliance over lag intervals, in closed form where the law has one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.reference.hereditary import (
    TimeFunction,
    accumulated,
    averaged,
    evaluate,
)

LagMean: TypeAlias = Callable[[Floats, Floats], Floats]
"""Mean of J over lags between two arrays of equal shape [s]; J itself where they are equal."""


def lag_mean(creep_compliance: TimeFunction) -> LagMean:
    """Mean of J(t) over lags [1/Pa]: its method ``mean(start, end)``, else quadrature in log t."""
    own = getattr(creep_compliance, "mean", None)
    if own is not None:
        return lambda start, end: np.asarray(own(start, end), dtype=np.float64)

    def mean(start: Floats, end: Floats) -> Floats:
        length = end - start
        means = np.empty_like(length)
        # Near lag 0 the function may behave as any power of the lag; further away the
        # difference of two integrals from 0 would lose accuracy.
        late = (start >= length) & (start > 0) | (length == 0)
        means[late] = averaged(creep_compliance, start[late], end[late])
        early = ~late
        if early.any():
            both = accumulated(creep_compliance, np.stack([end[early], start[early]]))
            means[early] = (both[0] - both[1]) / length[early]
        return means

    return mean


def instant_compliance(creep_compliance: TimeFunction) -> float:
    """Instant compliance J(0), checked to be finite and >= 0 [1/Pa]."""
    instant = float(evaluate(creep_compliance, 0.0))
    if not 0 <= instant < np.inf:
        raise ValueError(
            f"creep_compliance: wanted J(0) >= 0 and finite, got {instant!r} 1/Pa; "
            "give a creep compliance, not a modulus"
        )
    return instant
