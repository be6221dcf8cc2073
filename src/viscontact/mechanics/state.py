"""State of a contact at one instant: fields, resultants, rigid motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import IntEnum
from typing import Any, Literal, NamedTuple

import numpy as np

from viscontact.backend.arrays import Bools, Flags, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.rolling_traction import RollingTraction


class Outcome(IntEnum):
    """Outcome of the contact solver at an instant.

    ``CONVERGED`` (0), ``NO_CONTACT`` (1), ``NOT_CONVERGED`` (2): tolerance not reached, or
    ``PULLED_OFF`` (3): a given force has pulled adhering bodies off each other, which ends the run.

    Examples
    --------
    >>> Outcome(1).name
    'NO_CONTACT'
    """

    CONVERGED = 0
    NO_CONTACT = 1
    NOT_CONVERGED = 2
    PULLED_OFF = 3


#: Part of a state that only moving contacts have. Others are named by their scalar.
MOTION = "motion"

#: Scalars that only states under a temperature or with ageing have.
OF_CLOCKS = ("temperature", "reduced_time", "reduced_time_indenter", "thickening")

#: Part of a state that only contacts under friction have.
FRICTION = "friction"

#: Part of a state that only bodies have that roll with traction.
ROLLING = "rolling"

#: Part of a state that only bodies have that roll in steady motion with traction.
OVER_CREEPAGE = "traction over creepage"

#: Part of a state of a run whose case names a fluid that leaks.
LEAKAGE = "leakage"

#: Part of one whose fluid leaks along both axes: what leaks along y.
LEAKAGE_Y = "leakage along y"

#: Parts of a state that only contacts of bodies that adhere have, and those on a stage.
ADHESION, STAGE = "adhesion", "stage"

#: Fields of a state over the cells, and those of a contact under friction.
FIELD_NAMES = ("pressure", "gap", "displacement", "in_contact")
FRICTION_FIELDS = ("traction_x", "traction_y", "slip_x", "slip_y", "slip_state", "friction_work")


#: Beginning or end of a contact of bodies that adhere.
EventKind = Literal["jump_in", "pull_off"]


class ContactEvent(NamedTuple):
    """Instant at which bodies that adhere come into contact or lose it."""

    kind: EventKind
    time: float  # [s]
    force: tuple[float, float]  # before and after it [N]
    approach: tuple[float, float]  # before and after it [m]
    pull: float  # largest pull of the contact that ends [N]; NaN where one begins
    pull_time: float  # when it was [s]
    #: Fall of the pull beside it over the square of the time from there [N/s²]; infinite where
    #: contact is lost at the largest pull.
    pull_bend: float = math.nan


def as_event(plain: Sequence[Any]) -> ContactEvent:
    """Return an event of plain data."""
    kind, time, forces, approaches, *pull = plain
    return ContactEvent(kind, time, tuple(forces), tuple(approaches), *pull)


@dataclass(frozen=True, eq=False)
class ContactState:
    """Fields, resultants and rigid motion at one instant; names as in the result's dataset.

    Attributes
    ----------
    time : float
        Instant; at a jump of the load, just after it [s].
    pressure : ndarray, shape (nx, ny)
        Contact pressure, positive in compression [Pa].
    gap : ndarray, shape (nx, ny)
        Gap, positive when open, +inf outside the indenter's outline [m].
    displacement : ndarray, shape (nx, ny)
        Surface displacement, positive into the half-space [m].
    in_contact : ndarray of bool, shape (nx, ny)
        True in cells where the bodies touch.
    line_load : ndarray, shape (nx,)
        Pressure integrated over y, along x [N/m].
    grid : Grid
        The cells of these fields. A run with an automatic grid may have enlarged it since the
        previous state.
    force : float
        Integral of the pressure [N].
    eccentricity_x, eccentricity_y : float
        Position of that resultant [m]; NaN without contact, and along a periodic axis, which has
        no centre.
    approach : float
        Rigid approach of the bodies, positive when they come closer; on a periodic grid relative
        to the mean plane of the displaced surface, NaN on a grid periodic along one axis only [m].
    tilt_x, tilt_y : float
        Rigid slopes, positive when they press the +x or +y end deeper [rad].
    contact_area : float
        Area inside the rim, resolved below the cell size [m²].
    contact_length, contact_width : float
        Extents of the contact along x and y, along a periodic axis at most a period [m].
    peak_pressure, mean_pressure : float
        Largest cell pressure, and force over area [Pa].
    peak_line_load : float
        Largest mean of the line load over a twentieth of the contact's length along x [N/m]. At a
        sharp end of the body the line load itself has no limit as cells become smaller.
    work : float
        Work of the load, and of layers that expand, on the contact since the start [J]; exact for
        an elastic body, across jumps and at the first instant, otherwise second-order accurate in
        the step. NaN where the approach is.
    loss_per_cycle : float
        Work lost in the last complete cycle of the load; NaN before the first is complete [J].
    time_error : float
        Estimated error of the pressure caused by the time steps so far, relative to the largest
        deflection [-].
    iterations : int
        Search directions of the contact solver.
    residual : float
        Largest gap under pressure or penetration elsewhere, over the largest displacement [-].
    cells_across : int
        Number of cells across the contact along its shorter direction.
    outcome : Outcome
        Outcome of the solver.
    warnings : tuple of str
        Accuracy warnings that occur first at this instant.
    events : tuple of ContactEvent
        Jumps into contact and pull-offs of bodies that adhere, since the state before.
    position_x, position_y : float or None
        Position of the axis of a moving body [m]. These and the following are None if no motion
        is prescribed.
    resistance_x, resistance_y : float or None
        Force of the half-space on the body against +x and +y: positive if it holds back a body
        that moves towards + [N].
    friction_coefficient : float or None
        Resistance against the motion over force; NaN at rest and without contact [-].
    motion_work : float or None
        Work of the motion against the resistance since the start [J].
    dissipation : float or None
        Power lost in the dashpots of the laws' retardation series [W]; NaN where the history is
        kept as a Boltzmann sum.
    heat : float or None
        Energy lost in them since the start [J].
    speed : float or None
        Speed of a body in steady motion [m/s]; None for a contact over time.
    temperature : float or None
        Temperature of the bodies [K]; None where it is not given.
    reduced_time : float or None
        Time at the reference temperature of the half-space's shift, and at its first age, in which
        its law creeps as it did so far [s]; None without a shift under a temperature, and ageing.
    reduced_time_indenter : float or None
        The same of the indenter [s].
    thickening : float or None
        Growth of the thickness of all layers by thermal expansion, which closes the gap as an
        approach does [m]; None without layers that expand.
    traction_x, traction_y : ndarray or None, shape (nx, ny)
        Traction of the body on the half-space along the surface [Pa]. This and all that follow are
        None without friction.
    slip_x, slip_y : ndarray or None, shape (nx, ny)
        Slip of the surface under the body since the contact of the cell [m].
    slip_state : ndarray of int or None, shape (nx, ny)
        0 where the bodies are apart, 1 where they stick, 2 where they slip.
    friction_work : ndarray or None, shape (nx, ny)
        Work of friction per area since the start [J/m²].
    tangential_force_x, tangential_force_y : float or None
        Integrals of the tractions [N].
    torque : float or None
        Their torque about the axis, from x to y; NaN on a periodic grid [N m].
    tangential_displacement_x, tangential_displacement_y : float or None
        Rigid shift of the body against the half-space far below; NaN where the approach is [m].
    rotation : float or None
        Rotation of the body about its axis, from x to y [rad].
    stick_area : float or None
        Area of the cells that stick [m²].
    slip_fraction : float or None
        Part of the cells in contact that slip [-].
    friction_heat : float or None
        Heat of friction since the start [J].
    friction_power : float or None
        Heat of the step over its duration; NaN at a jump [W].
    tangential_stiffness_x, tangential_stiffness_y : float or None
        Change of the force over that of the shift in the step; NaN at rest [N/m].
    duality_gap : float or None
        Bound of the energy of the error of the tractions, over the work of all friction on the
        largest displacement [-].
    creepage : float or None
        Way of the body's surface against the half-space in the step, over the travel: surface speed
        over travel, less 1; NaN at rest [-]. This and the next one are None but of a body that
        rolls under friction.
    drive_torque : float or None
        Torque of a drive that the tractions balance: their force against the motion times the
        radius of the body, positive where it drives; NaN at rest, and without a radius [N m].
    transmissivity, leak_rate, critical_gap : float or None
        Of a fluid through the gap, as of `leakage`: h³/12 between parallel plates [m³], volume over
        time [m³/s], and gap at the narrowest place of the widest channel [m]; NaN at instants
        whose fields are not kept. Along x if the fluid leaks along both axes. None without a fluid
        in the case.
    transmissivity_error, leak_rate_error, critical_gap_error : float or None
        Their errors.
    transmissivity_y, transmissivity_y_error, leak_rate_y, leak_rate_y_error : float or None
        The same along y, of a fluid that leaks along both axes; None of another one.
    critical_gap_y, critical_gap_y_error : float or None
        Likewise.

    least_pressure : float or None
        Least pressure, negative in tension [Pa]; None, like the next three, without adhesion.
    tensile_area : float or None
        Area outside the contact that pulls with more than a hundredth of the strength [m²].
    adhesion_energy : float or None
        Work that separating the surfaces from their gap would take [J].
    stability : float or None
        Factor by which a small change of the attraction returns, below 1 of a stable contact; a
        state ends where it reaches 1. NaN once a force has pulled the bodies apart [-].
    stage_position : float or None
        Position of the stage on whose spring the body hangs [m]; None without one.
    rolling_traction : RollingTraction or None
        Tractions over the creepage of a body that rolls in steady motion; None otherwise.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (6e-3, 6e-3))
    >>> state = next(vc.march(vc.Paraboloid(0.01, 0.01), rubber, vc.step(1.0), grid, [0.0]))
    >>> state.pressure.shape, state.outcome.name, round(state.force, 6)
    ((24, 24), 'CONVERGED', 1.0)
    """

    time: float
    pressure: Floats
    gap: Floats
    displacement: Floats
    in_contact: Bools
    line_load: Floats
    grid: Grid
    force: float
    eccentricity_x: float
    eccentricity_y: float
    approach: float
    tilt_x: float
    tilt_y: float
    contact_area: float
    contact_length: float
    contact_width: float
    peak_pressure: float
    mean_pressure: float
    peak_line_load: float
    work: float
    loss_per_cycle: float
    time_error: float
    iterations: int
    residual: float
    cells_across: int
    outcome: Outcome
    warnings: tuple[str, ...] = ()
    events: tuple[ContactEvent, ...] = ()
    position_x: float | None = None
    position_y: float | None = None
    resistance_x: float | None = None
    resistance_y: float | None = None
    friction_coefficient: float | None = None
    motion_work: float | None = None
    dissipation: float | None = None
    heat: float | None = None
    speed: float | None = None
    temperature: float | None = None
    reduced_time: float | None = None
    reduced_time_indenter: float | None = None
    thickening: float | None = None
    traction_x: Floats | None = None
    traction_y: Floats | None = None
    slip_x: Floats | None = None
    slip_y: Floats | None = None
    slip_state: Flags | None = None
    friction_work: Floats | None = None
    tangential_force_x: float | None = None
    tangential_force_y: float | None = None
    torque: float | None = None
    tangential_displacement_x: float | None = None
    tangential_displacement_y: float | None = None
    rotation: float | None = None
    stick_area: float | None = None
    slip_fraction: float | None = None
    friction_heat: float | None = None
    friction_power: float | None = None
    tangential_stiffness_x: float | None = None
    tangential_stiffness_y: float | None = None
    duality_gap: float | None = None
    creepage: float | None = None
    drive_torque: float | None = None
    transmissivity: float | None = None
    transmissivity_error: float | None = None
    leak_rate: float | None = None
    leak_rate_error: float | None = None
    critical_gap: float | None = None
    critical_gap_error: float | None = None
    transmissivity_y: float | None = None
    transmissivity_y_error: float | None = None
    leak_rate_y: float | None = None
    leak_rate_y_error: float | None = None
    critical_gap_y: float | None = None
    critical_gap_y_error: float | None = None
    least_pressure: float | None = None
    tensile_area: float | None = None
    adhesion_energy: float | None = None
    stability: float | None = None
    stage_position: float | None = None
    rolling_traction: RollingTraction | None = None

    @property
    def over(self) -> Literal["time", "speed"]:
        """Quantity in which the states of a run differ: time, or speed in steady motion."""
        return "time" if self.speed is None else "speed"

    @property
    def moving(self) -> bool:
        """True if a motion is prescribed."""
        return self.position_x is not None

    @property
    def parts(self) -> frozenset[str]:
        """Parts of its scalars that only some states have."""
        moving = {MOTION} if self.moving or self.speed is not None else set()
        gripping = set() if self.traction_x is None else {FRICTION}
        rolling = set() if self.creepage is None else {ROLLING}
        leaking = set() if self.leak_rate is None else {LEAKAGE}
        across = set() if self.leak_rate_y is None else {LEAKAGE_Y}
        adhering = set() if self.least_pressure is None else {ADHESION}
        staged = set() if self.stage_position is None else {STAGE}
        curved = set() if self.rolling_traction is None else {OVER_CREEPAGE}
        clocked = {name for name in OF_CLOCKS if getattr(self, name) is not None}
        return frozenset(
            moving | gripping | rolling | leaking | across | adhering | staged | curved | clocked
        )

    @property
    def field_names(self) -> tuple[str, ...]:
        """Names of its fields over the cells."""
        return FIELD_NAMES if self.traction_x is None else (*FIELD_NAMES, *FRICTION_FIELDS)

    def with_own_fields(self) -> ContactState:
        """Return the same state, whose fields are no parts of larger arrays of the run.

        To be kept: pressure and displacement of a state that a march has just yielded may lie
        beside other fields, which it would keep as well.
        """
        own: dict[str, Any] = {}
        for name in self.field_names:
            field = getattr(self, name)
            own[name] = field if field.base is None else field.copy()
        return self._with(own)

    def without_fields(self) -> ContactState:
        """Return the same state with empty fields, to save memory in long runs."""
        nothing: dict[str, Any] = {
            name: np.empty((0, 0), getattr(self, name).dtype) for name in self.field_names
        }
        traction = self.rolling_traction and self.rolling_traction.without_fields()
        others = {"line_load": np.empty(0), "rolling_traction": traction}
        return self._with(nothing | others)

    def _with(self, values: dict[str, Any]) -> ContactState:
        """The same state with other values."""
        # Not by `replace`, which takes ten times as long: it is done after each step.
        same = object.__new__(type(self))
        vars(same).update(vars(self) | values)
        return same
