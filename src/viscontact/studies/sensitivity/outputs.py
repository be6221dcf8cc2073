"""OutputScalars: scalars of all runs of a sensitivity, at an instant or at their worst."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_axis import RUN_AXES, RunAxis
from viscontact.results.sweep_axes import over_of
from viscontact.studies.scalars import At, Value, known_scalar, magnitude, magnitudes


@dataclass(frozen=True, eq=False)
class OutputScalars:
    """Joint result of the runs, the first of which has the values of the case."""

    joint: xr.Dataset  # as of `open_many`, along `run`
    at: At

    @property
    def failures(self) -> dict[str, str]:
        """Reasons of the runs without a result, by name."""
        states, names, why = (self.joint[each].values for each in ("state", "name", "message"))
        return {str(names[n]): str(why[n]) or "no result" for n in np.flatnonzero(states != "done")}

    @cached_property
    def _places(self) -> dict[str, int]:
        return {str(name): n for n, name in enumerate(self.joint["name"].values)}

    def place(self, name: str) -> int:
        """Number of a run by its name."""
        return self._places[name]

    def over(self, scalar: str) -> Floats:
        """Values of a scalar, shape (runs, instants or speeds)."""
        return np.asarray(self.joint[scalar].values, dtype=np.float64)

    @property
    def shared_axis(self) -> RunAxis | None:
        """Time or speed, if all runs have the same instants or speeds."""
        axis = RUN_AXES[over_of(self.joint)]
        return axis if self.joint[axis.name].ndim == 1 else None

    def values(self, scalar: str) -> Floats:
        """Magnitudes of a scalar in all runs, NaN without a result."""
        return magnitudes(self.joint, scalar, self.at)[0]

    def nominal(self, scalar: str) -> Value:
        """Magnitude of a scalar in the run of the case, the only one with errors."""
        return magnitude(self.joint.isel(run=[0]), scalar, self.at)


def checked_outputs(of: Sequence[str] | str) -> tuple[str, ...]:
    """Return the names of scalars with an error bar; ValueError for any other."""
    texts = of.split(",") if isinstance(of, str) else list(of)
    found = tuple(dict.fromkeys(str(each).strip() for each in texts if str(each).strip()))
    if not found:
        raise ValueError("of: name a scalar of the result, as 'peak_pressure,approach'")
    return tuple(known_scalar("of", name) for name in found)
