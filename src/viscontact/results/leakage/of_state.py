"""Leakage of a state of a run under way, by the settings of its case."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscontact.mechanics.state import ContactState
from viscontact.results.leakage.fluid import flow_axis, fluid_of
from viscontact.results.leakage.instant import MEMORY, MOST_UNKNOWNS, InstantLeakage
from viscontact.results.variables import OF_LEAKAGE, SCALARS, error_name

_ERRORS = tuple(name for name in map(error_name, OF_LEAKAGE) if name in SCALARS)

#: Time of both solutions for each cell [s].
_SECONDS = 1.5e-5


@dataclass(frozen=True)
class CaseLeakage:
    """Fluid of a case, which leaks along one axis at the instants whose fields are kept."""

    settings: Mapping[str, Any]  # arguments of `leakage`
    tolerance: float  # of the contact

    @property
    def is_scalar(self) -> bool:
        """True for a flow along one axis; one along both has no single leak rate."""
        return bool(self.settings.get("along", "x") != "both")

    @property
    def unknown(self) -> dict[str, Any]:
        """Scalars of a state whose fields are not kept, or of which none can be found."""
        return dict.fromkeys((*OF_LEAKAGE, *_ERRORS), np.nan)

    def values(self, state: ContactState) -> dict[str, Any]:
        """Scalars of a state with its fields."""
        found = self.unknown
        with suppress(ValueError):  # the sentences below the table of the run give the reason
            found |= self._values(state)
        return found

    def _values(self, state: ContactState) -> dict[str, float]:
        along = self.settings.get("along", "x")
        flow = flow_axis(along, self.settings.get("ends"), state.grid)
        gap = np.asarray(state.gap, dtype=np.float64)
        if np.isnan(gap).any():
            raise ValueError("leakage: the gap is not known on the whole grid")
        found = InstantLeakage(gap, state.in_contact, state.grid, flow, self.tolerance)
        fluid, extents = fluid_of(self.settings), found.extents
        transmissivity, error = np.array(found.transmissivity), np.array(found.error)
        return {
            "transmissivity": float(transmissivity),
            "transmissivity_error": float(error),
            "leak_rate": float(fluid.rate(transmissivity, *extents)),
            "leak_rate_error": float(fluid.rate(error, *extents)),
            "critical_gap": found.critical[0],
            "critical_gap_error": found.critical_error,
        }


def leakage_memory(cells: int) -> float:
    """Memory of the flow on a grid [bytes]."""
    return float(MEMORY * min(cells, MOST_UNKNOWNS))  # more are refused


def leakage_seconds(cells: int) -> float:
    """Predicted time of the flow at an instant [s]."""
    return _SECONDS * cells
