"""OutputScalars: scalars of all runs of a sensitivity, at an instant or at their worst."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats, Integers
from viscontact.results.run_axis import RUN_AXES, RunAxis
from viscontact.results.sweep_axes import over_of
from viscontact.results.variables import error_name
from viscontact.studies.case_values import At, known_scalar


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
        if scalar not in self.joint:
            raise ValueError(f"of: {scalar}: the results do not have it")
        return np.asarray(self.joint[scalar].values, dtype=np.float64)

    @property
    def shared_axis(self) -> RunAxis | None:
        """Time or speed, if all runs have the same instants or speeds."""
        axis = RUN_AXES[over_of(self.joint)]
        return axis if self.joint[axis.name].ndim == 1 else None

    def values(self, scalar: str) -> Floats:
        """Magnitudes of a scalar in all runs, NaN without a result."""
        sizes = np.abs(self.over(scalar))
        return np.take_along_axis(sizes, self._rows(sizes)[:, None], axis=1)[:, 0]

    def nominal_error(self, scalar: str) -> float:
        """Error of the scalar in the run of the case: NaN if unknown, inf if mesh-dependent."""
        if error_name(scalar) not in self.joint:
            return np.nan
        row = self._rows(np.abs(self.over(scalar)))[0]
        return float(self.joint[error_name(scalar)].values[0, row])

    def _rows(self, sizes: Floats) -> Integers:
        """Row of the instant in each run."""
        known = np.isfinite(sizes)
        if self.at == "worst":
            return np.asarray(np.where(known, sizes, -1.0).argmax(axis=1))
        if self.at == "end":
            return np.asarray(sizes.shape[1] - 1 - known[:, ::-1].argmax(axis=1))
        return self._rows_of(float(self.at), len(sizes))

    def _rows_of(self, wanted: float, runs: int) -> Integers:
        """Row of an instant [s] or a speed [m/s] in each run that has it, as the first one must."""
        axis = RUN_AXES[over_of(self.joint)]
        distance = np.abs(np.atleast_2d(self.joint[axis.name].values) - wanted)
        found = np.where(np.isnan(distance), np.inf, distance).argmin(axis=1)
        if not distance[0, found[0]] <= 1e-9 * abs(wanted):
            near = axis.quantity(np.atleast_2d(self.joint[axis.name].values)[0, found[0]])
            raise ValueError(
                f"at: {axis.quantity(wanted)} is no {axis.row} of the runs; the nearest is {near}"
            )
        return np.broadcast_to(found, runs)


def checked_outputs(of: Sequence[str] | str) -> tuple[str, ...]:
    """Return the names of scalars with an error bar; ValueError for any other."""
    texts = of.split(",") if isinstance(of, str) else list(of)
    found = tuple(dict.fromkeys(str(each).strip() for each in texts if str(each).strip()))
    if not found:
        raise ValueError("of: name a scalar of the result, as 'peak_pressure,approach'")
    return tuple(known_scalar("of", name) for name in found)
