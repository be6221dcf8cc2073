"""Anderson mixing: acceleration of a fixed-point iteration x = g(x)."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats

#: Earlier iterates that are mixed.
DEPTH = 3

#: Singular values of the changes of the residual, over the largest, that count as none.
FLAT = 1e-6


class AndersonMixing:
    """Next iterate from the last ones by least squares (D. Anderson, J. ACM 12 (1965) 547)."""

    def __init__(self, depth: int = DEPTH) -> None:
        self._depth = depth
        self._images: list[Floats] = []
        self._residuals: list[Floats] = []

    def next(self, given: Floats, image: Floats) -> Floats:
        """Iterate that follows x, with its image g(x)."""
        self._images = [*self._images[-self._depth :], image]
        self._residuals = [*self._residuals[-self._depth :], image - given]
        if len(self._images) == 1:
            return image
        changes = np.stack([(self._residuals[-1] - each).ravel() for each in self._residuals[:-1]])
        gram = changes @ changes.T
        scale = float(np.trace(gram))
        if not scale > 0:
            return image
        weights = np.linalg.pinv(gram / scale, rcond=FLAT, hermitian=True) @ (
            changes @ self._residuals[-1].ravel() / scale
        )
        found = image.copy()
        for weight, each in zip(weights, self._images[:-1], strict=True):
            found -= weight * (image - each)
        return found
