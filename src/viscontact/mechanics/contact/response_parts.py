"""Operators of a surface whose response is a sum of parts, the weights of which change."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.ended_convolution import EndedConvolution, WeightedOperators
from viscontact.mechanics.halfspace.ended_response import has_ends
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.mechanics.halfspace.spectral import PeriodicConvolution
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse

#: Maps pressure to unit displacement on cells.
Operator = Convolution | PeriodicConvolution | EndedConvolution | WeightedOperators


class PartOperators:
    """Operators of each part over one block of cells, of which those of a sum are made."""

    # In each step the layers' terms have other weights. The symbol of their sum is that of the
    # parts' symbols, which need no new transform.

    def __init__(
        self,
        operator_of: Callable[[SurfaceResponse, bool], Operator],
        preconditioner: Callable[[], Preconditioner],
    ) -> None:
        """Take the makers of an operator, in single precision or not, and of a preconditioner."""
        self._operator_of, self._make_preconditioner = operator_of, preconditioner
        self._operators: dict[SurfaceResponse, Any] = {}
        self._with_ends: dict[tuple[SurfaceResponse, bool], Any] = {}
        self._single: Any = None
        self._preconditioner: Preconditioner | None = None
        self._ratios: dict[SurfaceResponse, Floats] = {}

    def operator(self, part: SurfaceResponse) -> Operator:
        """Operator of one part, in double precision."""
        if part not in self._operators:
            self._operators[part] = self._operator_of(part, False)
        found: Operator = self._operators[part]
        return found

    def sum_of(self, weights: Mapping[SurfaceResponse, float], *, single: bool) -> Operator:
        """Operator of the weighted sum of parts."""
        if any(map(has_ends, weights)):
            return self._sum_with_ends(weights, single=single)
        parts: list[Any] = [self.operator(part) for part in weights]
        like: Any = parts[0]
        if single:
            if self._single is None:
                self._single = self._operator_of(next(iter(weights)), True)
            like = self._single
        found: Operator = like.sum_of(parts, list(weights.values()))
        return found

    def _sum_with_ends(
        self, weights: Mapping[SurfaceResponse, float], *, single: bool
    ) -> WeightedOperators:
        """Operator of a sum in which a half-space ends: parts have no symbols to be added."""
        for part in weights:
            if (part, single) not in self._with_ends:
                self._with_ends[part, single] = self._operator_of(part, single)
        operators = [self._with_ends[part, single] for part in weights]
        return WeightedOperators(operators, list(weights.values()))

    def preconditioner(self, weights: Mapping[SurfaceResponse, float]) -> Preconditioner:
        """Approximate inverse of that operator."""
        if self._preconditioner is None:
            self._preconditioner = self._make_preconditioner()
        waves = self._preconditioner.waves
        for part in weights:
            if part not in self._ratios:
                self._ratios[part] = part.ratio(waves)
        ratios = [weight * self._ratios[part] for part, weight in weights.items()]
        return self._preconditioner.with_ratios(np.sum(ratios, axis=0))
