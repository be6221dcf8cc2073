"""Contact problem: bodies, load, and requirements on the solution."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.cohesive_laws import LAWS
from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.cut_body import cut_at
from viscontact.bodies.laws import Law
from viscontact.bodies.loads import LoadHistory, LoadPoint
from viscontact.bodies.loads.clock import TIME, Clock, ReducedTime
from viscontact.bodies.loads.joint import JointLoad
from viscontact.bodies.loads.largest_load import largest_load
from viscontact.bodies.loads.mixed import as_history
from viscontact.bodies.loads.motion import STANDING, Motion
from viscontact.bodies.loads.rolling_shift import RollingShift
from viscontact.bodies.loads.tangential import TangentialLoad
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.bodies.materials.layers import (
    Layered,
    at_temperature,
    materials_of,
    without_ends,
)
from viscontact.bodies.materials.material import Material
from viscontact.bodies.surfaces import Surface as MeasuredSurface
from viscontact.bodies.surfaces import indenter_of
from viscontact.bodies.surfaces.topographies import is_topography
from viscontact.mechanics import problem, time_integration
from viscontact.mechanics.problem.expansion import ThickenedLoad, Thickening, thickening_of
from viscontact.mechanics.problem.kept_fields import ALL_FIELDS, KeptFields
from viscontact.mechanics.problem.series_body import Span, span_of
from viscontact.mechanics.problem.surface import (
    SurfaceTerms,
    clock_of,
    follows_span,
    on_clock,
    surface_of,
    together,
)
from viscontact.mechanics.state import (
    ADHESION,
    FRICTION,
    MOTION,
    OF_CLOCKS,
    OVER_CREEPAGE,
    ROLLING,
    STAGE,
)
from viscontact.mechanics.time_integration.fixed_steps import FixedSteps, TimeStep, plan_steps
from viscontact.mechanics.time_integration.moving_times import CellTimes, moving_times
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.mechanics.time_integration.run_times import run_instants
from viscontact.units.numbers import as_real

if TYPE_CHECKING:
    from viscontact.mechanics.problem.shear_terms import ShearTerms

#: Range of tolerances [-]: smaller ones are below rounding, larger ones give no solution.
FINEST_TOLERANCE, COARSEST_TOLERANCE = 1e-13, 1e-2

#: Relative errors of the scalars in tolerances of the solver, which bounds the gap.
SOLVER_ERROR_FACTOR = 3.0


#: Names of the materials of two bodies that both deform.
BODIES = ("half-space material", "indenter material")

#: Error of the time steps between given times of an adhesive contact [-], and the shortest one of
#: them, over the stretch of the load from kink to kink: a jump takes one.
ADHESIVE_STEP_TOLERANCE, SHORTEST_ADHESIVE_STEP = 1e-3, 1e-5

#: Way to a given time over the proposed step up to which one step takes it: steps that are somewhat
#: too long are kept, but for those of a law that ends abruptly.
STRETCHED, STRETCHED_ABRUPT = 1.4, 1.2

#: Edge of the cell of an automatic grid that is not chosen yet [m].
UNKNOWN_CELL = 1e100


def _hint(name: str, given: object) -> str:
    """Hint for an argument of a wrong type; empty without one."""
    if isinstance(given, Law):
        return "; write vc.Material(law, poisson_ratio=...)"
    if name.endswith("material") and isinstance(given, str):
        return "; write vc.shipped_material(name) for a material of the library"
    if name == "load" and as_real(given) is not None:
        return "; write vc.step(force) for a constant force"
    return ""


@dataclass(frozen=True, eq=False)
class DataTimes:
    """Times between which the law of a body rests on data, on the clock of its creep."""

    first: float  # reduced time since a load came [s]; 0 for formulas
    last: float  # reduced time [s]; inf for formulas
    clock: Clock
    whose: str

    @cached_property
    def until(self) -> float:
        """Time of a run at which the data end [s]."""
        return self.clock.time_at(self.last)

    def latest_before(self, time: float) -> float:
        """Latest time at which a load could come and be in the data at a time [s]."""
        first = self.first * (1 - 1e-9)
        if self.clock is TIME:
            return time - first
        reduced = float(self.clock.reduced(np.array(time))) - first
        return self.clock.time_at(reduced) if reduced >= 0 else -1.0


@dataclass(frozen=True, eq=False)
class Problem:
    """Contact problem in the terms of the user; derived quantities are computed once."""

    indenter: Indenter  # shape of the pressed body; a measured one becomes a `HeightMap`
    material: Material | Layered | Body  # of the half-space, or layers, or with ends
    load: LoadHistory  # a `LoadProgram` becomes a `MixedHistory` that awaits its events
    grid: Grid | AutomaticGrid | None = None
    times: ArrayLike | AdaptiveTimes | CellTimes | None = None  # of the states [s]
    indenter_material: Material | Layered | Body | None = None  # None for a rigid body
    tolerance: float = 1e-6  # relative error of gap and balances at every step [-]
    kept: KeptFields = ALL_FIELDS
    step_ratio: float = 1.0  # longest step, relative to the longest one that the load allows [-]
    motion: Motion = STANDING
    temperature: TemperatureHistory | None = None  # of all bodies; None: that of their laws
    friction: Friction | None = None
    tangential: TangentialLoad | None = None  # along the surface, under friction
    adhesion: Adhesion | None = None

    def __post_init__(self) -> None:
        if isinstance(self.indenter, MeasuredSurface) or is_topography(self.indenter):
            object.__setattr__(self, "indenter", indenter_of(self.indenter))
        object.__setattr__(self, "load", as_history(self.load))
        for name, kinds, optional in (
            ("indenter", (Indenter,), False),
            ("material", (Material, Layered, Body), False),
            ("load", (LoadHistory,), False),
            ("grid", (Grid, AutomaticGrid), True),
            ("indenter_material", (Material, Layered, Body), True),
            ("motion", (Motion,), False),
            ("temperature", (TemperatureHistory,), True),
            ("friction", (Friction,), True),
            ("tangential", (TangentialLoad,), True),
            ("adhesion", (Adhesion,), True),
        ):
            value = getattr(self, name)
            if not (isinstance(value, kinds) or (optional and value is None)):
                named = " or ".join(kind.__name__ for kind in kinds)
                raise ValueError(
                    f"{name} must be of kind {named}, got {value!r}{_hint(name, value)}"
                )
        number = as_real(self.tolerance)
        if number is None or not FINEST_TOLERANCE <= number <= COARSEST_TOLERANCE:
            raise ValueError(f"tolerance must lie between 1e-13 and 1e-2, got {self.tolerance!r}")
        object.__setattr__(self, "tolerance", number)

    @property
    def solver_error(self) -> float:
        """Bound of the relative errors of scalars caused by the tolerance of the solver [-]."""
        return SOLVER_ERROR_FACTOR * self.tolerance

    @cached_property
    def bodies(self) -> tuple[Material | Layered, ...]:
        """The bodies that deform, at a constant temperature with the laws that they have there."""
        given = tuple(map(without_ends, self._given_bodies))
        if self.temperature is None or not self.temperature.is_constant:
            return given
        try:
            return tuple(at_temperature(body, self.temperature.range[0]) for body in given)
        except ValueError as error:
            raise ValueError(f"temperature: {error}") from None

    @property
    def _given_bodies(self) -> tuple[Material | Layered | Body, ...]:
        """The bodies that deform, as they are given."""
        both = (self.material, self.indenter_material)
        return tuple(body for body in both if body is not None)

    @property
    def ends(self) -> tuple[Body | None, ...]:
        """Each body that deforms, if it ends."""
        return tuple(body if isinstance(body, Body) else None for body in self._given_bodies)

    @property
    def ended_bodies(self) -> dict[str, Body]:
        """Bodies that end, by the names of their arguments."""
        both = {"material": self.material, "indenter_material": self.indenter_material}
        return {name: body for name, body in both.items() if isinstance(body, Body)}

    @property
    def planes(self) -> tuple[float, ...]:
        """Positions x of the ends of all bodies [m]."""
        bodies = self.ended_bodies.values()
        return tuple(plane for body in bodies for plane in body.planes if plane is not None)

    @cached_property
    def cut_indenter(self) -> Indenter:
        """The indenter without what lies beyond the ends of the bodies."""
        return cut_at(self.indenter, [body.planes for body in self.ended_bodies.values()])

    @property
    def constant_temperature(self) -> float | None:
        """Temperature that does not vary [K]; None if it does, or none is given."""
        given = self.temperature
        return given.range[0] if given is not None and given.is_constant else None

    @cached_property
    def clocks(self) -> tuple[Clock, ...]:
        """Clock of the creep of each body."""
        varies = self.temperature is not None and not self.temperature.is_constant
        return tuple(clock_of(body, self.temperature if varies else None) for body in self.bodies)

    @cached_property
    def thickening(self) -> Thickening | None:
        """Growth of the thickness of layers that expand under the temperature; None without."""
        return thickening_of(self.bodies, self.temperature)

    def thickening_at(self, time: float) -> float:
        """Growth of the thickness of all layers at a time [m]."""
        return 0.0 if self.thickening is None else float(self.thickening.at(time))

    @cached_property
    def contact_load(self) -> LoadHistory:
        """The load, with an approach increased by the growth of layers that expand."""
        return self.load if self.thickening is None else ThickenedLoad(self.load, self.thickening)

    @property
    def materials(self) -> tuple[Material, ...]:
        """Materials of all bodies and of their layers."""
        return tuple(chain.from_iterable(map(materials_of, self.bodies)))

    @cached_property
    def stated_clocks(self) -> tuple[Clock, ...]:
        """Clock of each body that its states tell, also at a constant temperature."""
        is_over_time = self.motion.stands or any(self.motion.moves)
        if self.temperature is None or not self.temperature.is_constant or not is_over_time:
            return self.clocks
        given = map(without_ends, self._given_bodies)
        shifts = (next((m.shift for m in materials_of(body) if m.shift), None) for body in given)
        return tuple(
            clock if shift is None else ReducedTime(self.temperature, shift)
            for clock, shift in zip(self.clocks, shifts, strict=True)
        )

    @cached_property
    def is_coupled(self) -> bool:
        """True if pressure and tractions along the surface act on each other."""
        return self.friction is not None and self.friction.coupling and self.may_be_coupled

    @cached_property
    def may_be_coupled(self) -> bool:
        """True if pressure moves the surfaces against each other along themselves."""
        return not problem.shear_terms.is_uncoupled(self.bodies)

    @property
    def parts(self) -> frozenset[str]:
        """Parts of the scalars of its states that only some problems have."""
        moving = () if self.motion.stands else (MOTION,)
        is_steady = not (self.motion.stands or any(self.motion.moves))
        grips = (OVER_CREEPAGE,) if is_steady else (FRICTION,)
        gripping = () if self.friction is None else grips
        rolls = not (self.friction is None or self.motion.stands or is_steady)
        rolling = (ROLLING,) if rolls else ()
        adhering = () if self.adhesion is None else (ADHESION,)
        staged = () if self.load.stage_stiffness is None else (STAGE,)
        return frozenset(
            [*moving, *gripping, *rolling, *adhering, *staged, *self.clock_scalars(0.0)]
        )

    @cached_property
    def shear_load(self) -> TangentialLoad | None:
        """The tangential load: that given, or the shift of a body that rolls with a creepage."""
        if self.tangential is None and self.motion.creepage is not None:
            return RollingShift(self.motion)
        return self.tangential

    def clock_scalars(self, time: float) -> dict[str, float]:
        """Temperature [K], reduced times [s] and thickening [m], by their names in the result."""
        found = {}
        if self.temperature is not None:
            found["temperature"] = float(self.temperature.at(time))
        for name, clock in zip(OF_CLOCKS[1:], self.stated_clocks, strict=False):
            if clock is not TIME:
                found[name] = float(clock.reduced(np.array(time)))
        if self.thickening is not None:
            found["thickening"] = self.thickening_at(time)
        return found

    @cached_property
    def surface(self) -> SurfaceTerms:
        """Creep functions and frequency responses of both bodies together."""
        surface = surface_of(self.bodies, self._spans, self.clocks, self.ends)
        if self.friction is None:
            return surface
        error = max(surface.splitting_error, self.shear.splitting_error)
        return replace(surface, splitting_error=error)

    @cached_property
    def shear(self) -> ShearTerms:
        """Creep functions and responses of both bodies together to tractions along the surface."""
        return problem.shear_terms.shear_terms(self.bodies, self.clocks, self._spans)

    @cached_property
    def _spans(self) -> tuple[Span, ...]:
        """Times of interest of each body, where its terms depend on them [s]; none otherwise."""
        has_times = self.times is not None or self._steps_over_cells
        if not (has_times and any(map(follows_span, self.bodies))):
            return ()
        # The times of interest may follow from the law, and the law's series from these times.
        functions = [
            on_clock(part.contact_compliance(), clock)
            for body, clock in zip(self.bodies, self.clocks, strict=True)
            for part in materials_of(body)
        ]
        instants = self._instants(together(functions))
        return tuple(span_of(clock.reduced(instants)) for clock in self.clocks)

    @property
    def compliance(self) -> ContactCompliance:
        """J(t) of both bodies together [1/Pa]; of layers that of short waves."""
        return self.surface.compliance

    def has_datum(self, grid: Grid) -> bool:
        """True if the approach has a datum on a grid: not of a line contact on a half-space."""
        # Between two ends a body is a plate below a depth of its length, so it has none, either.
        lines = not grid.has_datum or self.ends_twice
        return not lines or self.surface.is_supported

    @property
    def ends_twice(self) -> bool:
        """True if a body ends on both sides."""
        return any(None not in body.ends for body in self.ended_bodies.values())

    @property
    def automatic_grid(self) -> AutomaticGrid | None:
        """Requirements on the grid; None for a grid that was given."""
        if isinstance(self.grid, Grid):
            return None
        return self.grid or AutomaticGrid()

    @property
    def adaptive(self) -> AdaptiveTimes | None:
        """Requirements on steps that the run chooses; None for given times."""
        return self.times if isinstance(self.times, AdaptiveTimes) else None

    @cached_property
    def history(self) -> LoadHistory:
        """The load on the contact, with the kinks of a path and of a tangential load."""
        load = self.motion.history_under(self.contact_load)
        return load if self.tangential is None else JointLoad(load, self.tangential)

    @cached_property
    def instants(self) -> Floats:
        """Times of the states [s]; of adaptive steps the prescribed ones, the end last."""
        return self._instants(self.surface.creep)

    def _instants(self, creep: ContactCompliance) -> Floats:
        """Times of the states, which may depend on the creep of all bodies [s]."""
        if isinstance(self.times, CellTimes) or self._steps_over_cells:
            if isinstance(self.grid, Grid):
                return self.times_at_cells(self.grid.cell_size)
            # Until the cells are known, those of one that is longer than any path.
            return self.times_at_cells((UNKNOWN_CELL, UNKNOWN_CELL))
        load = self.contact_load if self.tangential is None else self.history
        return run_instants(self.times, self.kept.places, load, creep)

    def times_at_cells(self, cell_size: tuple[float, float]) -> Floats:
        """Times of a moving contact at which the body has passed whole cells [s]."""
        end = self.times.end if isinstance(self.times, CellTimes) else None
        return moving_times(self.motion, self.contact_load, cell_size, end, self.kept.places)

    @property
    def awaits_cells(self) -> bool:
        """True if its times follow from cells that are not chosen yet."""
        return self._steps_over_cells and not isinstance(self.grid, Grid)

    @property
    def _steps_over_cells(self) -> bool:
        """True if the body passes a cell, or several, in each step."""
        return isinstance(self.times, CellTimes) or (self.times is None and any(self.motion.moves))

    @property
    def end(self) -> float:
        """Last time of the run [s]."""
        return float(self.instants[-1])

    @cached_property
    def largest_load(self) -> tuple[float, LoadPoint]:
        """Time of the largest load of the run [s], and its point."""
        return largest_load(self.contact_load, self.end)

    @cached_property
    def planned_steps(self) -> tuple[TimeStep, ...]:
        """Steps through the given times; not for adaptive steps."""
        return plan_steps(self.instants, self.history, self.step_ratio, self.surface.clocks)

    @property
    def step_count(self) -> float:
        """Number of steps, estimated for adaptive ones."""
        chosen = self.chosen_steps
        if chosen is None:
            return float(len(self.planned_steps))
        return time_integration.estimated_steps(chosen, self.history, self.surface.creep)

    @property
    def chosen_steps(self) -> AdaptiveTimes | None:
        """Requirements on steps that the run chooses, also between given times; None without."""
        if self.adaptive is not None or self.adhesion is None:
            return self.adaptive
        # Adhesive contacts are followed in steps of small changes of the force.
        return AdaptiveTimes(self.end or 1.0, ADHESIVE_STEP_TOLERANCE)

    def steps(self, cell_size: tuple[float, float]) -> FixedSteps | time_integration.AdaptiveSteps:
        """Return the sequence of steps from the start, on cells of a size (dx, dy) [m]."""
        chosen = self.chosen_steps
        if chosen is None:
            return FixedSteps(self.planned_steps)
        creep, marks = self.surface.creep, self.motion.times_at_cells(cell_size)
        return time_integration.AdaptiveSteps(
            *(chosen, self.instants, self.history, creep, marks, self.surface.clocks),
            shown=None if self.adaptive else self.instants,
            **self.step_limits,
        )

    @property
    def step_limits(self) -> dict[str, Any]:
        """Limits of steps that adhesion has: options of `AdaptiveSteps`; none without adhesion."""
        if self.adhesion is None:
            return {}
        stretched = STRETCHED_ABRUPT if LAWS[self.adhesion.law].is_abrupt else STRETCHED
        return {"jumps_in": SHORTEST_ADHESIVE_STEP, "stretched": stretched}

    @cached_property
    def data_times(self) -> tuple[DataTimes, ...]:
        """Times of the data of the laws of each body."""
        return tuple(
            DataTimes(
                max(material.known_from for material in materials_of(body)),
                min(material.known_until for material in materials_of(body)),
                clock,
                name,
            )
            for body, clock, name in zip(self.bodies, self.clocks, self.body_names, strict=True)
        )

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names of the materials of the bodies that deform."""
        return ("material",) if len(self.bodies) == 1 else BODIES

    @property
    def given_materials(self) -> tuple[tuple[Material, ...], ...]:
        """Materials of each body that deforms, as they are given: at their own temperatures."""
        return tuple(materials_of(without_ends(body)) for body in self._given_bodies)

    @property
    def thinnest_layer(self) -> float:
        """Thickness of the thinnest layer of a body [m]; inf without layers."""
        layered = [body for body in self.bodies if isinstance(body, Layered)]
        return min((each.thickness for body in layered for each in body.layers), default=np.inf)

    @property
    def thickness(self) -> float:
        """Thickness of the thinnest body that is a half-space [m]; inf where none is given."""
        return min(material.thickness or np.inf for material in self.materials)
