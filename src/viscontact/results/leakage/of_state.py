"""Leakage of a state of a run under way, by the settings of its case."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.state import LEAKAGE, LEAKAGE_Y, ContactState
from viscontact.results.leakage.fluid import flow_axis, fluid_of
from viscontact.results.leakage.instant import MEMORY, MOST_UNKNOWNS, InstantLeakage
from viscontact.results.variables import OF_LEAKAGE, error_name

#: Scalars of a flow, and their errors.
_SCALARS = (*OF_LEAKAGE, *map(error_name, OF_LEAKAGE))

#: Time of both solutions for each cell [s].
_SECONDS = 1.5e-5


@dataclass(frozen=True)
class CaseLeakage:
    """Fluid of a case, which leaks at the instants whose fields are kept."""

    settings: Mapping[str, Any]  # arguments of `leakage`
    tolerance: float  # of the contact

    @property
    def parts(self) -> frozenset[str]:
        """Parts of the scalars of a state."""
        return frozenset({LEAKAGE, LEAKAGE_Y} if self._along == "both" else {LEAKAGE})

    @property
    def directions(self) -> int:
        """Number of flows."""
        return len(self.parts)

    @property
    def unknown(self) -> dict[str, Any]:
        """Scalars of a state whose fields are not kept, or of which none can be found."""
        named = [self._named(name, axis) for axis in self._axes for name in _SCALARS]
        return dict.fromkeys(named, np.nan)

    @property
    def _along(self) -> str:
        return str(self.settings.get("along", "x"))

    @property
    def _axes(self) -> str:
        return "xy" if self._along == "both" else self._along

    def _named(self, name: str, axis: str) -> str:
        """Name of a scalar of the flow along an axis."""
        if self._along != "both" or axis == "x":
            return name
        of = name.removesuffix("_error")
        return f"{of}_y{name.removeprefix(of)}"

    def values(self, state: ContactState) -> dict[str, Any]:
        """Scalars of a state with its fields."""
        found = self.unknown
        with suppress(ValueError):  # the sentences below the table of the run give the reason
            for axis, flow in zip(self._axes, self._flows(state), strict=True):
                values = self._values(flow)
                found |= {self._named(name, axis): value for name, value in values.items()}
        return found

    def _flows(self, state: ContactState) -> list[InstantLeakage]:
        """Leakage of a state along each axis."""
        axes = [flow_axis(each, self.settings.get("ends"), state.grid) for each in self._axes]
        gap = np.asarray(state.gap, dtype=np.float64)
        if np.isnan(gap).any():
            raise ValueError("leakage: the gap is not known on the whole grid")
        found = InstantLeakage(gap, state.in_contact, state.grid, axes[0], self.tolerance)
        return found.along(axes)

    def _values(self, found: InstantLeakage) -> dict[str, float]:
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
