"""What the stresses of a result follow from: a body, and the pressures on its surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from viscontact.grid import Grid
from viscontact.halfspace.layered_stress import LayeredStress
from viscontact.halfspace.stack_waves import interface_depths
from viscontact.halfspace.stress import Stress, stress_on_plane, stress_on_section
from viscontact.halfspace.stress_response import HalfSpaceStress, StressResponse
from viscontact.materials.layers import Layered
from viscontact.problem.surface import as_elastic
from viscontact.results.recorded_case import (
    is_layered,
    recorded_grid,
    recorded_object,
    recorded_poisson_ratio,
)

Array = NDArray[np.float64]

#: The bodies of a result, by the names of the arguments of `simulate`.
Body = Literal["material", "indenter_material"]

#: Depths of a section through a half-space, and the fewest in each layer.
DEPTHS, PER_LAYER = 61, 13

#: Relative distance below an interface at which the part beneath it is evaluated.
BENEATH = 2e-9


@dataclass(frozen=True, eq=False)
class StressSource:
    """Body of a result, and its stored pressures."""

    results: xr.Dataset
    response: StressResponse
    interfaces: tuple[float, ...]  # depths of the lower sides of the layers [m]
    ends: bool  # True if there is a rigid base below the last interface

    @cached_property
    def grid(self) -> Grid:
        """Cells of the pressure."""
        return recorded_grid(self.results)

    @property
    def stored(self) -> Array:
        """Instants [s] or speeds [m/s] of the pressures, as stored."""
        pressure = self.results["pressure"]
        return np.asarray(pressure[pressure.dims[0]].values, dtype=np.float64)

    def places(self, times: Sequence[float] | None) -> list[int]:
        """Indices of the stored instants nearest to some times, of all if None."""
        if times is None:
            return list(range(self.stored.size))
        return [int(np.abs(self.stored - time).argmin()) for time in times]

    def time(self, places: Sequence[int]) -> Any:
        """Coordinate of some stored instants, with its attributes."""
        pressure = self.results["pressure"]
        return ("time", self.stored[list(places)], self.results[pressure.dims[0]].attrs)

    def on_section(
        self, places: Sequence[int], depths: ArrayLike, x: float | None, y: float | None
    ) -> Stress:
        """Stresses on a vertical plane at stored instants by index; (instants, nz, nx or ny)."""
        fields = self._pressure(places)
        if isinstance(self.response, HalfSpaceStress):
            # One by one, each with its own loaded cells: a long run loads few of them at first.
            each = [
                stress_on_section(field, self.grid, depths, self.response, x=x, y=y).components
                for field in fields
            ]
            return Stress(np.stack(each, axis=1))
        return stress_on_section(fields, self.grid, depths, self.response, x=x, y=y)

    def on_plane(self, places: Sequence[int], depth: float) -> Stress:
        """Stresses on a plane parallel to the surface; (instants, nx, ny)."""
        return stress_on_plane(self._pressure(places), self.grid, depth, self.response)

    def depths(self, deepest: float) -> Array:
        """Usual depths of a section [m], on both sides of interfaces, to a rigid base at most."""
        if not self.interfaces:
            return np.linspace(0.0, deepest, DEPTHS)
        if self.ends:
            deepest = min(deepest, self.interfaces[-1])
        inside = [depth for depth in self.interfaces if depth < deepest]
        found = []
        for top, bottom in zip([0.0, *inside], [*inside, deepest], strict=True):
            count = max(PER_LAYER, int(np.ceil(DEPTHS * (bottom - top) / deepest)))
            found.append(np.linspace(top * (1 + BENEATH), bottom, count))
        return np.concatenate(found)

    def _pressure(self, places: Sequence[int]) -> Array:
        return np.asarray(self.results["pressure"].values[list(places)], dtype=np.float64)


def stress_source(
    results: xr.Dataset, body: Body = "material", poisson_ratio: float | None = None
) -> StressSource:
    """Source of the stresses in a body, of a given Poisson's ratio if it is a half-space.

    ValueError if there is no such body, no stored pressure, or the pressure does not suffice.
    """
    if body not in ("material", "indenter_material"):
        raise ValueError(f"body must be 'material' or 'indenter_material', got {body!r}")
    if "pressure" not in results:
        raise ValueError(
            "stresses need stored pressure; run again with fields stored ('output: fields: all' "
            "or a list of instants in the case file, fields= in Python)"
        )
    if not is_layered(results, body):
        ratio = recorded_poisson_ratio(results, body) if poisson_ratio is None else poisson_ratio
        return StressSource(results, HalfSpaceStress(ratio), (), False)
    if poisson_ratio is not None:
        raise ValueError("poisson_ratio is for half-spaces; layers have their own, leave it out")
    layered = recorded_object(results, body, "stresses")
    assert isinstance(layered, Layered)
    stack = as_elastic(layered)
    if stack is None:
        raise ValueError(
            "stresses: where layers creep differently, or Poisson's ratio varies in time, they "
            "depend on the history of the pressure, which is not available yet; they are known "
            "for layers that do not creep, of one creep law, or single ones on a rigid base"
        )
    depths = tuple(interface_depths(stack))
    return StressSource(results, LayeredStress(stack), depths, stack.base is None)
