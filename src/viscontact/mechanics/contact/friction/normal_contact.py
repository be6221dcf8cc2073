"""Normal contact that tractions act in: its pressure, gap, and cells in contact."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Pressure over the largest that is rounding.
ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class NormalContact:
    """Pressure and gap at one instant, with the cells that the normal solution holds in contact."""

    pressure: Floats  # [Pa], (nx, ny)
    gap: Floats  # +inf outside the body [m], (nx, ny)
    in_contact: Bools  # the solution's own, never inferred from the pressure
    force: float = 0.0  # [N]
    displacement: float = 0.0  # largest one under the pressure [m]

    @classmethod
    def apart(cls, gap: Floats) -> NormalContact:
        """Bodies that do not touch, at a gap [m]."""
        return cls(np.zeros(gap.shape), gap, np.zeros(gap.shape, bool))

    @property
    def cells(self) -> int:
        """Number of cells in contact."""
        return int(np.count_nonzero(self.in_contact))

    @property
    def gripping(self) -> Bools:
        """Cells that carry tractions: in contact under a pressure that is not rounding."""
        # Tractions on the others could be any, but their slip would be judged like all slip: the
        # search for them does not end.
        return np.asarray(self.in_contact & (self.pressure > ROUNDING * self.pressure.max()))

    def entered_since(self, before: NormalContact) -> Bools:
        """Cells in contact that were open before."""
        return self.in_contact & ~before.in_contact & np.isfinite(before.gap)

    def on(self, embedded: Callable[[Any, Any], Any]) -> NormalContact:
        """The same contact on a larger grid, by a map of a field and its value beyond."""
        return NormalContact(
            embedded(self.pressure, 0.0),
            embedded(self.gap, np.inf),
            embedded(self.in_contact, False),
            self.force,
            self.displacement,
        )
