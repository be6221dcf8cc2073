"""Cubics of several functions on one axis, through polynomials on panels of its logarithm."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.log_panels import LogPanels, interpolation, slopes


@dataclass(frozen=True, eq=False)
class CubicCurves:
    """Cubics on intervals of one length, of the logarithm, with values and slopes at their ends."""

    first: float
    step: float
    coefficients: Floats  # of powers 0 to 3 of the distance from a knot; (4, intervals, curves)

    @classmethod
    def on_panels(cls, panels: LogPanels, values: Floats, parts: int) -> CubicCurves:
        """Cubics on parts of panels, of values at their nodes, shape (nodes, curves)."""
        count, length = len(panels.edges) - 1, float(panels.edges[1] - panels.edges[0])
        step, ends = length / parts, np.linspace(-1.0, 1.0, parts + 1)
        nodes = values.reshape(count, -1, values.shape[1])
        known, slope = interpolation(ends) @ nodes, slopes(ends) * (2 / length) @ nodes
        rise = np.diff(known, axis=1) / step
        begin, end = slope[:, :-1], slope[:, 1:]
        # Of an interval from its values and slopes at both ends.
        bend = (begin + end - 2 * rise) / step
        powers = np.stack([known[:, :-1], begin, (rise - begin) / step - bend, bend / step])
        flat = powers.reshape(4, count * parts, -1)
        return cls(float(panels.edges[0]), step, flat)

    def __call__(self, logarithms: Floats) -> Floats:
        """Values at places, the outermost cubics beyond the panels; shape (..., curves)."""
        position = (logarithms - self.first) / self.step
        interval = np.clip(position.astype(int), 0, self.coefficients.shape[1] - 1)
        beyond = ((position - interval) * self.step)[..., None]
        constant, slope, second, third = self.coefficients
        found = third[interval]
        for lower in (second, slope, constant):
            found *= beyond
            found += lower[interval]
        return np.asarray(found)
