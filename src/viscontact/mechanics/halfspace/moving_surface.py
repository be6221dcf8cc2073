"""Surface of bodies under a load in steady motion: sum of compliances times frequency responses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.moving_load import MovingCompliance, joined
from viscontact.mechanics.halfspace.surface_response import (
    HALF_SPACE,
    SummedResponse,
    SurfaceResponse,
)


@dataclass(frozen=True, eq=False)
class MovingSurface:
    """Terms of the surface: each a response L(q) [-] with its compliance in motion."""

    terms: tuple[tuple[SurfaceResponse, MovingCompliance], ...]

    def scaled(self, factor: float) -> MovingSurface:
        """Surface whose compliances are multiplied by a factor."""
        return self._with_terms(lambda compliance: compliance.scaled(factor))

    def with_elastic(self, response: SurfaceResponse, added: float) -> MovingSurface:
        """Surface with an elastic compliance [1/Pa] of a response added to it."""
        if len(self.terms) == 1 and self.terms[0][0] == response:
            return self._with_terms(lambda own: replace(own, instant=own.instant + added))
        if not added:
            return self
        elastic = MovingCompliance(added, np.empty(0), np.empty(0))
        return MovingSurface((*self.terms, (response, elastic)))

    @property
    def is_supported(self) -> bool:
        """True on a rigid base, which a mean pressure does not displace without limit."""
        return all(np.isfinite(response.mean_displacement) for response, _ in self.terms)

    @property
    def short_waves(self) -> MovingCompliance:
        """Compliance of short waves, which do not feel the layers."""
        return self._weighted([response.short_waves for response, _ in self.terms])

    @property
    def instant(self) -> float:
        """Instant compliance of short waves [1/Pa]."""
        return self.short_waves.instant

    def at_length(self, wave_number: float) -> MovingCompliance:
        """Compliance of waves of one wave number [1/m], times L: that of a half-space like it."""
        waves = np.array(wave_number)
        return self._weighted([float(response.ratio(waves)) for response, _ in self.terms])

    @property
    def drift(self) -> float:
        """Slope given by old creep, of long waves; see `MovingCompliance.drift` [1/(Pa m)]."""
        return sum(response.long_waves * each.drift for response, each in self.terms)

    def relaxed_response(self, wave_number: float) -> SurfaceResponse:
        """Response of the surface at rest, over that at a wave number [1/m]."""
        if len(self.terms) == 1 and self.terms[0][0] is HALF_SPACE:
            return HALF_SPACE
        level = self.at_length(wave_number).relaxed
        weights = tuple(compliance.relaxed / level for _, compliance in self.terms)
        return SummedResponse(tuple(response for response, _ in self.terms), weights)

    def _with_terms(self, change: Callable[[MovingCompliance], MovingCompliance]) -> MovingSurface:
        return MovingSurface(tuple((response, change(each)) for response, each in self.terms))

    def _weighted(self, weights: list[float]) -> MovingCompliance:
        """Sum of the compliances times weights, without drift."""
        parts = [each.scaled(w) for (_, each), w in zip(self.terms, weights, strict=True)]
        return replace(joined(parts), drift=0.0)
