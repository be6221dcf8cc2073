"""Anderson mixing: acceleration of a fixed-point iteration x = g(x)."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats

#: Earlier iterates that are mixed. Below a coefficient of friction of 2 they change little.
DEPTH = 6

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
        last = self._residuals[-1]
        changes = np.stack([last - each for each in self._residuals[:-1]])
        # Not as matrix products: BLAS would start threads.
        gram = np.einsum("aij,bij->ab", changes, changes)
        scale = float(np.trace(gram))
        if not scale > 0:
            return image
        ahead = np.einsum("aij,ij->a", changes, last) / scale
        weights = np.linalg.pinv(gram / scale, rcond=FLAT, hermitian=True) @ ahead
        found = image.copy()
        for weight, each in zip(weights, self._images[:-1], strict=True):
            found -= weight * (image - each)
        return found
