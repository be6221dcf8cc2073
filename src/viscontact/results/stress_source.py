"""Source of the stresses of a result: a body, and the loads on its surface."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.layers import Layered
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.ended_load import EndedLoad
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.layered_shear_stress import LayeredShearStress
from viscontact.mechanics.halfspace.layered_stress import LayeredStress
from viscontact.mechanics.halfspace.stack_waves import interface_depths
from viscontact.mechanics.halfspace.stress import Stress, stress_on_plane, stress_on_section
from viscontact.mechanics.halfspace.stress_lines import Progress, part_of
from viscontact.mechanics.halfspace.stress_response import (
    HalfSpaceShearStress,
    HalfSpaceStress,
    StressResponse,
)
from viscontact.mechanics.problem.series_body import ANY_TIMES, span_of
from viscontact.mechanics.problem.stress_history import StressHistory, stress_history
from viscontact.mechanics.problem.surface import as_elastic
from viscontact.results.recorded_case import is_layered, recorded_grid, recorded_poisson_ratio
from viscontact.results.recorded_objects import (
    recorded_clock,
    recorded_end_response,
    recorded_object,
)
from viscontact.results.run_axis import run_axis
from viscontact.units.numbers import real_array

#: The bodies of a result, by the names of the arguments of `simulate`.
Body = Literal["material", "indenter_material"]

#: Depths of a section through a half-space, and the fewest in each layer.
DEPTHS, PER_LAYER = 61, 13

#: Relative distance below an interface at which the part beneath it is evaluated.
BENEATH = 2e-9

#: Fields of the loads on the surface, that of the pressure first.
LOADS = ("pressure", "traction_x", "traction_y")


@dataclass(frozen=True, eq=False)
class StressSource:
    """Body of a result, and the stored loads on its surface."""

    results: xr.Dataset
    responses: tuple[StressResponse, ...]  # the stresses are the sum of theirs
    stack: ElasticStack | None = None  # layers of a body, one of the stacks of `history`
    history: StressHistory | None = None  # weights of the load of each response
    clock: Clock = TIME  # of the creep of the body
    signs: tuple[float, ...] = (1.0,)  # of the fields `LOADS` that act on the responses
    ended: EndedResponse | None = None  # a body that ends along x, under pressure alone

    @property
    def splitting_error(self) -> float:
        """Bound of the relative error of the sum [-]; 0 if exact."""
        return 0.0 if self.history is None else self.history.error

    @property
    def errors_of_ends(self) -> dict[str, float]:
        """What the result states on the ends of a body: their operator, and stress that is left."""
        if self.ended is None:
            return {}
        names = ("ends_error", "end_stress_left")
        given = {name: self.results.attrs.get(name) for name in names}
        return {name: float(value) for name, value in given.items() if value is not None}

    @property
    def interfaces(self) -> tuple[float, ...]:
        """Depths of the lower sides of the layers [m]."""
        return () if self.stack is None else tuple(interface_depths(self.stack))

    @property
    def on_rigid_base(self) -> bool:
        """True for layers that lie on a rigid base."""
        return self.stack is not None and self.stack.base is None

    @property
    def follows_history(self) -> bool:
        """True if the stresses follow from the loads of all instants before."""
        return self.history is not None and bool(self.history.times.size)

    @cached_property
    def grid(self) -> Grid:
        """Cells of the pressure."""
        return recorded_grid(self.results)

    @property
    def stored(self) -> Floats:
        """Instants [s] or speeds [m/s] of the pressures, as stored."""
        pressure = self.results["pressure"]
        return np.asarray(pressure[pressure.dims[0]].values, dtype=np.float64)

    def places(self, times: Sequence[float] | None) -> list[int]:
        """Indices of the stored instants nearest to some times, of all if None."""
        if times is None:
            return list(range(self.stored.size))
        wanted = np.atleast_1d(real_array("times", times, run_axis(self.results).unit))
        return [int(np.abs(self.stored - time).argmin()) for time in wanted]

    def time(self, places: Sequence[int]) -> Any:
        """Coordinate of some stored instants, with its attributes."""
        pressure = self.results["pressure"]
        return ("time", self.stored[list(places)], self.results[pressure.dims[0]].attrs)

    @cached_property
    def largest_pulls(self) -> tuple[float, float]:
        """Largest forces of friction along x and y in the run [N]; 0 without friction."""
        forces = [f"tangential_force_{axis}" for axis in "xy"]
        if len(self.signs) == 1 or any(name not in self.results for name in forces):
            return 0.0, 0.0
        along_x, along_y = (float(np.abs(self.results[name].values).max()) for name in forces)
        return along_x, along_y

    def on_section(
        self,
        places: Sequence[int],
        depths: ArrayLike,
        x: float | None,
        y: float | None,
        progress: Progress | None = None,
    ) -> Stress:
        """Stresses on a vertical plane at stored instants by index; (instants, nz, nx or ny).

        NaN beyond the ends of a body.
        """
        bodies = len(self.responses)
        if self.ended is not None:
            load = EndedLoad(self.ended, self._loads(places)[0], self.grid)
            below = np.atleast_1d(np.asarray(depths, dtype=np.float64))
            return halfspace.ended_stress.ended_stress_on_section(
                load, below, x=x, y=y, progress=progress
            )
        return self._sum(
            stress_on_section(
                *(fields, self.grid, depths, body),
                x=x,
                y=y,
                progress=part_of(progress, index, bodies),
            )
            for index, (fields, body) in enumerate(
                zip(self._loads(places), self.responses, strict=True)
            )
        )

    def on_plane(self, places: Sequence[int], depth: float) -> Stress:
        """Stresses on a plane parallel to the surface; (instants, nx, ny)."""
        if self.ended is not None:
            load = EndedLoad(self.ended, self._loads(places)[0], self.grid)
            return halfspace.ended_stress.ended_stress_on_plane(load, depth)
        return self._sum(
            stress_on_plane(fields, self.grid, depth, body)
            for fields, body in zip(self._loads(places), self.responses, strict=True)
        )

    def _sum(self, parts: Iterable[Stress]) -> Stress:
        return Stress(sum((part.components for part in parts), start=np.zeros(())))

    def depths(self, deepest: float) -> Floats:
        """Usual depths of a section [m], on both sides of interfaces, to a rigid base at most."""
        if not self.interfaces:
            return np.linspace(0.0, deepest, DEPTHS)
        if self.on_rigid_base:
            deepest = min(deepest, self.interfaces[-1])
        inside = [depth for depth in self.interfaces if depth < deepest]
        found = []
        for top, bottom in zip([0.0, *inside], [*inside, deepest], strict=True):
            count = max(PER_LAYER, int(np.ceil(DEPTHS * (bottom - top) / deepest)))
            found.append(np.linspace(top * (1 + BENEATH), bottom, count))
        return np.concatenate(found)

    def _loads(self, places: Sequence[int]) -> Floats:
        """Loads of the responses at stored instants by index; (responses, instants, nx, ny)."""
        stored = self.results["pressure"]
        if not self.follows_history:
            fields = [
                sign * np.asarray(self.results[name].values[list(places)], dtype=np.float64)
                for name, sign in zip(LOADS, self.signs, strict=False)
            ]
            return np.stack(fields)
        if not run_axis(self.results).is_history:
            raise ValueError(
                "stresses: in these layers, which creep differently, they depend on the history of "
                "the pressure, and are not available in steady motion; move the body in time "
                "('motion: kind: travel' in a case file, motion=Travel(...) in Python)"
            )
        if stored.dims[0] != "time" or self.stored[0] > 0:
            raise ValueError(
                "stresses: in these layers, which creep differently, they depend on the history of "
                "the pressure; run again with the fields of all instants stored, from time 0 on "
                "('output: fields: all' in the case file, fields='all' in Python)"
            )
        return self._of_history[:, list(places)]

    @cached_property
    def _of_history(self) -> Floats:
        """Loads of the responses at all stored instants."""
        assert self.history is not None  # used for creeping layers only
        pressed = self._jumps("load")
        # Tractions jump with the pressure, too.
        pulled = np.unique(np.concatenate([pressed, self._jumps("tangential")]))
        # All at once, so that a jump at a stored instant is at it on the clock, too.
        marks = np.unique(np.concatenate([self.stored, pulled]))
        reduced = self.clock.reduced(marks)

        def on_clock(times: Floats) -> Floats:
            return np.asarray(reduced[np.searchsorted(marks, times)])

        found = []
        for name, sign in zip(LOADS, self.signs, strict=False):
            load = sign * np.asarray(self.results[name].values, dtype=np.float64)
            jumps = on_clock(pressed if name == LOADS[0] else pulled)
            found.append(self.history.loads(on_clock(self.stored), load, jumps))
        return np.concatenate(found)

    def _jumps(self, name: str) -> Floats:
        """Instants at which a recorded load jumps; none where it is not recorded [s]."""
        load = recorded_object(self.results, name, "stresses")
        return np.zeros(0) if load is None else np.asarray(load.jumps, dtype=np.float64)


def stress_source(
    results: xr.Dataset, body: Body = "material", poisson_ratio: float | None = None
) -> StressSource:
    """Source of the stresses in a body, of a given Poisson's ratio if it is a half-space.

    ValueError if there is no such body, no stored pressure, or the pressure does not suffice, or if
    the tractions are over several creepages.
    """
    if body not in ("material", "indenter_material"):
        raise ValueError(f"body must be 'material' or 'indenter_material', got {body!r}")
    if "pressure" not in results:
        raise ValueError(
            "stresses need stored pressure; run again with fields stored ('output: fields: all' "
            "or a list of instants in the case file, fields= in Python)"
        )
    if results.sizes.get("creepage", 1) > 1:
        raise ValueError(
            "stresses: the tractions are over several creepages; choose one, as in "
            "results.isel(creepage=-1)"
        )
    if "creepage" in results.dims:
        results = results.isel(creepage=0)
    ended = recorded_end_response(results, body, "stresses")
    if ended is not None:
        return _ended_source(results, ended, poisson_ratio)
    if not is_layered(results, body):
        ratio = recorded_poisson_ratio(results, body) if poisson_ratio is None else poisson_ratio
        signs = _signs(results, body)
        sheared = [HalfSpaceShearStress(ratio, axis) for axis in range(len(signs) - 1)]
        return StressSource(results, (HalfSpaceStress(ratio), *sheared), signs=signs)
    if poisson_ratio is not None:
        raise ValueError("poisson_ratio is for half-spaces; layers have their own, leave it out")
    layered = recorded_object(results, body, "stresses")
    assert isinstance(layered, Layered)
    stack, signs = as_elastic(layered), _signs(results, body)
    if stack is not None:
        return StressSource(results, _of_stacks([stack], signs), stack, signs=signs)
    clock, span = recorded_clock(results, body, "stresses"), ANY_TIMES
    if "time" in results.dims:
        span = span_of(clock.reduced(results["time"].values))
    history = stress_history(layered, span, sheared=len(signs) > 1)
    responses = _of_stacks(history.stacks, signs)
    return StressSource(results, responses, history.stacks[0], history, clock, signs)


def _ended_source(
    results: xr.Dataset, ended: EndedResponse, poisson_ratio: float | None
) -> StressSource:
    """Source of the stresses in a body that ends along x."""
    if any(recorded_grid(results).periodic):
        raise ValueError(
            "stresses: not available in a body that ends along x, under a contact that repeats "
            "along y; see its pressure, or compute a contact of finite width"
        )
    ratio = ended.poisson_ratio if poisson_ratio is None else poisson_ratio
    ended = replace(ended, poisson_ratio=ratio)
    own = halfspace.ended_stress.response_of(ended)
    return StressSource(results, (own,), getattr(ended, "stack", None), ended=ended)


def at_largest_traction(results: xr.Dataset) -> xr.Dataset:
    """Results at the creepage of the largest force along the surface; others unchanged."""
    if "creepage" not in results.dims:
        return results
    along_x, along_y = (results[f"tangential_force_{axis}"].fillna(0.0) for axis in "xy")
    squares = along_x**2 + along_y**2
    largest = squares.max([dim for dim in squares.dims if dim != "creepage"])
    return results.isel(creepage=int(largest.values.argmax()))


def _signs(results: xr.Dataset, body: Body) -> tuple[float, ...]:
    """Signs of the fields `LOADS` that a result has."""
    if not all(name in results for name in LOADS):
        return (1.0,)
    # What one body exerts on the other acts on itself in the opposite direction.
    sign = 1.0 if body == "material" else -1.0
    return 1.0, sign, sign


def _of_stacks(
    stacks: Sequence[ElasticStack], signs: tuple[float, ...]
) -> tuple[StressResponse, ...]:
    """Responses of stacks to each of the loads."""
    found: list[StressResponse] = [LayeredStress(stack) for stack in stacks]
    for axis in range(len(signs) - 1):
        found += [LayeredShearStress(stack, axis) for stack in stacks]
    return tuple(found)
