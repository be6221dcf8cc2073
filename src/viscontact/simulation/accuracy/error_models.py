"""Error models of the scalars: order of convergence and safety factor."""

from __future__ import annotations

from dataclasses import replace

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.simulation.accuracy.refinement_levels import RefinementLevels


@dataclass(frozen=True)
class ErrorModel:
    """Conversion of differences between grids to errors."""

    order: float  # power of the cell size with which the error falls [-]
    #: Safety factor, calibrated on exact solutions (tests/verification/test_error_bars.py) so that
    #: 95 of 100 errors are smaller [-].
    factor: float
    at_end: ErrorModel | None = None  # where contact reaches the body's end
    of_spots: ErrorModel | None = None  # where contact consists of several spots of few cells
    steep: ErrorModel | None = None  # where pressure is largest near the rim, or at a tip
    #: Part of the estimated time error of the pressure that counts where no third run has shown the
    #: error of the time steps: of ten runs with a third one, nine had less, in peaks four fifths.
    of_time_error: float = 0.0
    #: Part of what exceeds 0.01 of it at the instants that a third run has left out.
    of_left_out: float = 0.0
    #: Part of it where the contact recedes in a step that no coarser run has shown: balls and blunt
    #: bodies have once to twice as much in area and peak.
    of_receding: float = 0.0
    #: Part of the errors from the cells at the instants before and after that counts at an instant:
    #: a rim moves among the cells, and its errors change sign from instant to instant.
    of_neighbours: float = 1.0

    def of(self, levels: RefinementLevels) -> Floats:
        """Error from the cells."""
        return self.factor * levels.by_cells(self.order)


#: Approach, force, its offset and work, also where a contact reaches the end of a body: pressure is
#: singular there, and the cells approximate the end by a staircase.
_BULK = ErrorModel(
    *(2.0, 1.15),
    at_end=ErrorModel(0.7, 1.2),
    of_time_error=0.1,
    of_left_out=0.1,
    of_receding=0.1,
    of_neighbours=0.6,
)
_FORCE = ErrorModel(
    *(2.0, 1.0),
    at_end=ErrorModel(0.7, 1.2),
    of_time_error=0.15,
    of_left_out=0.15,
    of_receding=0.15,
    of_neighbours=0.3,
)
_TILT = replace(_BULK, factor=1.0, of_neighbours=0.5)
_OFFSET = ErrorModel(2.0, 1.0, at_end=ErrorModel(0.7, 0.8), of_neighbours=0.75)
_WORK = ErrorModel(
    *(2.0, 1.19),
    at_end=ErrorModel(0.7, 1.2),
    of_time_error=0.4,
    of_left_out=0.4,
    of_neighbours=0.65,
)

_CYCLE = replace(_WORK, factor=1.35)

#: Area and peak, also where contact consists of several spots of fewer cells across, in the mean:
#: some of them exist on one grid only. Calibrated on self-affine surfaces, 2 to 9 cells across.
COARSE_SPOT_CELLS = 8.0
_AREA = ErrorModel(
    *(2.0, 1.02),
    of_spots=ErrorModel(1.0, 1.5),
    steep=ErrorModel(1.0, 0.6),
    of_left_out=0.2,
    of_receding=1.0,
    of_neighbours=0.6,
)
_PEAK = ErrorModel(
    *(2.0, 1.44),
    at_end=ErrorModel(1.0, 1.5),
    of_spots=ErrorModel(2.0, 4.0),
    of_time_error=0.8,
    of_left_out=0.8,
    of_receding=0.8,
    of_neighbours=0.65,
)

#: Peak of the line load, a mean over a twentieth of the contact. Calibrated on ellipses, crowned
#: rollers, and rollers and punches with sharp ends, 15 to 80 cells long.
_LINE_LOAD = ErrorModel(
    *(2.0, 2.0),
    at_end=ErrorModel(0.7, 1.1),
    of_spots=ErrorModel(2.0, 4.0),
    of_time_error=0.5,
    of_left_out=0.5,
)

_EXTENT = ErrorModel(
    *(2.0, 1.0),
    steep=ErrorModel(1.0, 0.6),
    of_left_out=0.2,
    of_receding=1.0,
    of_neighbours=0.4,
)

#: Ends of the segments of a load program.
INSTANTS = ErrorModel(2.0, 1.8)

#: Scalars of a moving contact: of first order in steps longer than the retardation times, of
#: second order else. Calibrated on starts, reciprocations and steps of parts of cells.
_RESISTANCE, _LOSS = ErrorModel(1.5, 1.0), ErrorModel(1.5, 1.5)

#: Scalars of friction, calibrated on loops after Mindlin and Deresiewicz, 14 to 60 cells across:
#: those of the stick radius, which jumps by cells, are of first order.
_SHIFT = ErrorModel(2.0, 1.5, of_time_error=0.5)
_STICK = ErrorModel(1.0, 0.8, of_time_error=0.5)
_FRICTION_HEAT = ErrorModel(1.5, 0.7, of_time_error=0.5)

#: Least pressure, and pull-off by the coarser grids alone, with the parts of force and time that
#: reading it off steps of 2 % of the force may miss: where the pull is largest it hardly changes.
#: Calibrated on round and oval bodies of all laws, on 28 to 44 cells.
_PULL = ErrorModel(2.0, 2.0, of_time_error=0.5)
PULL_OFF = ErrorModel(2.0, 3.0)
PULL_OFF_READING = (2e-3, 8e-3)

#: Error models of the scalars; the mean pressure follows from force and area. Pressure is smooth
#: except at the rim, which lies between cells.
ERROR_MODELS = {
    "force": _FORCE,
    "eccentricity_x": _OFFSET,
    "eccentricity_y": _OFFSET,
    "approach": _BULK,
    "tilt_x": _TILT,
    "tilt_y": _TILT,
    "contact_area": _AREA,
    "contact_length": _EXTENT,
    "contact_width": _EXTENT,
    "peak_pressure": _PEAK,
    "peak_line_load": _LINE_LOAD,
    "work": _WORK,
    "loss_per_cycle": _CYCLE,
    "resistance_x": _RESISTANCE,
    "resistance_y": _RESISTANCE,
    "friction_coefficient": _RESISTANCE,
    "motion_work": _LOSS,
    "dissipation": _LOSS,
    "heat": _LOSS,
    "tangential_force_x": _SHIFT,
    "tangential_force_y": _SHIFT,
    "torque": _SHIFT,
    "tangential_displacement_x": _SHIFT,
    "tangential_displacement_y": _SHIFT,
    "rotation": _SHIFT,
    "stick_area": _STICK,
    "slip_fraction": _STICK,
    "friction_heat": _FRICTION_HEAT,
    "friction_power": _FRICTION_HEAT,
    "tangential_stiffness_x": _SHIFT,
    "tangential_stiffness_y": _SHIFT,
    "creepage": _SHIFT,
    "drive_torque": _SHIFT,
    "least_pressure": _PULL,
    "tensile_area": ErrorModel(1.0, 1.5),
    "adhesion_energy": _BULK,
}

#: Those that replace them for moving contacts: the loss of a cycle has the work of the motion.
MOVING_MODELS = {"loss_per_cycle": _LOSS}
