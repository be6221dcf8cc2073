"""Lower limits of error bars, where coarser runs may agree by chance."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.simulation.accuracy.coarser_grids import straight_ends
from viscontact.simulation.accuracy.coarser_results import History, indentation
from viscontact.simulation.accuracy.curvature_jumps import curvature_jumps
from viscontact.simulation.accuracy.refinement_levels import moving_maximum
from viscontact.simulation.accuracy.rim_cells import (
    EXTENTS,
    cells_across,
    cells_along,
    cells_of_breadth,
    cells_over_thickness,
    crest_cells,
    fills_period,
    in_several_strips,
    slenderness,
    thin_rim_cells,
    tip_curvature,
)
from viscontact.simulation.transient.setup import RunSetup

#: Scalars that vanish for an elastic body.
RESISTANCES = ("resistance_x", "resistance_y", "friction_coefficient", "motion_work")

#: Motions of a contact under friction, and scalars that are not given.
SHIFTS = ("tangential_displacement_x", "tangential_displacement_y", "rotation")
GRIPPING = (
    *SHIFTS,
    *("stick_area", "slip_fraction", "friction_heat", "friction_power"),
    *("tangential_stiffness_x", "tangential_stiffness_y", "creepage", "drive_torque"),
)

TINY = float(np.finfo(np.float64).tiny)

#: Smallest error of extents in cells, however well two grids agree; with spots of few cells; at a
#: straight end; at a sharp one, towards which the contact widens without a limit; and where
#: the contact may end in the last cells of the body.
RIM_CELLS, SPOT_RIM_CELLS, END_RIM_CELLS, SHARP_RIM_CELLS, LAST_CELLS = 0.019, 1.0, 1.5, 3.5, 1.5

#: Cells across the contact at which the first of them is twice as large, as its rim is curved.
FEW_CELLS = 8.0

#: Growth of the first of them with the length of the cells across an axis over that along it, as
#: the widest line of a contact may lie between two lines of cells: rollers with cells of 11:1 err
#: by 0.1 in the mean, at worst by 0.6.
LONG_CELLS = 0.4

#: The same where the pressure drops steeply to the rim, to be added, times the square of the cells
#: across: the gap opens as at a smooth rim only next to it. Rounded punches on some 12 cells err by
#: 0.03 in the median, by 0.2 in one of ten.
STEEP_RIM_CELLS = 18.0

#: Least relative error of the area, times the square of the cells across; and times these cells
#: where the pressure is largest near the rim.
LEAST_AREA_ERROR, STEEP_AREA_ERROR = 0.28, 0.06

#: The same of several strips through a whole period, times the cells across all of them: each has
#: fewer, and its rims lie alike within all cells along them.
STRIP_AREA_ERROR = 0.04

#: Least error of the rim in cells, in the mean, where the body's curvature jumps at it by more than
#: the first of these parts, in full from the second on: of rounded cones, and bodies of points,
#: where nothing else is known of it: 0.013 in the median, 0.08 in one of twenty.
JUMP_RIM_CELLS, SHARP_JUMP = 0.05, (0.7, 0.85)

#: Least error of the rim in cells, in the mean and of an extent, where a contact on a creeping body
#: has begun to recede: neither the pressure beside its rim nor the gap is as far from it. Within a
#: cell of their largest contact, most after a quarter of it, balls err by 0.02 in the mean of the
#: rim, at worst by 0.07; the extent of a rounded punch by 0.3 where its contact grows again.
RECEDING_RIM_CELLS, RECEDING_EXTENT_CELLS, LARGEST_RIM_ERROR_AT = 0.028, 0.1, 0.25

#: How many times as large they are at the instant at which a contact is smallest, and at the next:
#: it has begun to grow again, and the gap over the surface that it has just left is almost zero.
#: Balls, ellipses and r^n bodies err by up to 0.2 in the mean of the rim, up to 0.3 in an extent.
SMALLEST_CONTACT = 1.7

#: Relative difference below which all grids agree on an extent: it is that of the body.
AGREEMENT_TOLERANCE = 1e-6

#: Error of the extents in cells, and relative error of the area times the cells along and across,
#: where the tip of a slender contact is curved within a cell: they grow with L and L², where
#: L = ln(1 + 2 cell/radius of the tip). Hertz's ellipses on cells as slender as they are too short
#: by 0.2 cells if 10 times as long as wide, by 0.35, at most 0.55 cells at 30 times.
TIP_CELLS, TIP_AREA = 0.1, 0.3

#: Least relative error of scalars, times the square of the cells across the contact: the approach
#: of a ball is too small by 0.14 +- 0.04, at most by 0.23, with the place of the rim in its cells.
LEAST_ERRORS = {
    "approach": 0.25,
    "force": 0.3,
    "work": 0.2,
    "heat": 0.15,
    "loss_per_cycle": 0.25,
}

#: The same where the pressure drops steeply to the rim, under blunt bodies, times the cells across.
STEEP_ERRORS = {"approach": 0.045, "force": 0.045, "work": 0.045}

#: Least relative error of the work there, times the square of the cells across: of a rounded punch
#: on 12 cells 2 at most.
STEEP_WORK_ERROR = 1.0

#: Least relative error of shifts and of the heat of friction, times the square of the cells across
#: the contact, and of the area that sticks or slips, over that of the contact, times these cells:
#: the stick radius is known to parts of a cell.
LEAST_SHIFT_ERROR, LEAST_HEAT_ERROR, LEAST_STICK_ERROR = 0.12, 2.0, 0.25

#: Growth of the first two of these with the logarithm of a contact's length over its width: Hertz's
#: ellipses err by 0.15 in the mean, at most by 0.8.
LONG_CONTACT = 0.15

#: Least relative error of these scalars where the contact reaches the curved end of a body, times
#: the cells along the contact: the approach of a round flat punch is too large by 0.24 +- 0.10.
#: Straight ends lie alike within the cells of all grids, whose differences show the error.
LEAST_END_ERROR = 0.4

#: Least error of an eccentricity, over the extent of the contact, and of a tilt, over the slope of
#: the indentation, times the square of the cells along that axis: balls and ellipses have 0.04 in
#: the median. A tilt of e/R is four times the slope a/(2R) where e is the extent.
LEAST_OFFSET, LEAST_TURN = 0.045, 0.13

#: How many times as large they are where the pressure drops steeply to the rim.
STEEP_OFFSETS = 2.0

#: Least relative error of the tilt there: that of an eccentric round punch is up to 1.5.
LEAST_END_TILT_ERROR = 1.0

#: Least relative error of the area of a contact that ends with the body along one axis only, times
#: the cells along the contact.
LEAST_END_AREA_ERROR = 1.1

#: Growth of the least errors of scalars with the square of a cell's length over the thickness of a
#: layer, where the pressure falls to the rim as on springs.
THIN_GROWTH = 4.0

#: Relative drop of the pressure from its peak to the next cells of a coarser grid, below which the
#: peak is smooth: such ones drop by much less.
SMOOTH_DROP = 0.2

#: Scalars that follow from the moments.
MOMENTS = ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")


@dataclass(frozen=True, eq=False)
class ContactKinds:
    """Kinds of contact over the times of a run."""

    at_end: Bools
    ended: Bools  # at the end, or has been there and keeps the error
    of_spots: Bools  # consists of several spots of few cells
    singular: Bools  # the largest pressure has no limit
    #: Pressure rises to both ends of the contact along x, y; shape (2, times).
    rises: Bools
    drops: Floats  # relative drop of pressure from the peak to the cells next to it; NaN if unknown
    exponents: Floats  # of the gap around the peak, see `apex_exponent`; NaN if unknown
    bends: Floats  # growth of the peak that the body's bend there can cause; NaN if unknown

    @property
    def steep(self) -> Bools:
        """Pressure is largest at a tip or near the rim, inside the body: it drops steeply there."""
        return np.asarray((self.drops > SMOOTH_DROP) & ~self.at_end)

    @property
    def steepness(self) -> Floats:
        """0 up to the drop of a steep rim, 1 from twice as much on."""
        part = np.interp(np.nan_to_num(self.drops), (SMOOTH_DROP, 2 * SMOOTH_DROP), (0.0, 1.0))
        return np.where(self.at_end, 0.0, part)


def least_bar(
    run: RunSetup, name: str, kinds: ContactKinds, history: History, by_cells: Floats
) -> Floats | float:
    """Lower limit of a scalar's bars over times, in its unit, by the differences of the grids."""
    if name in EXTENTS:
        axis = EXTENTS.index(name)
        if agrees(by_cells, history[name]) and np.isfinite(by_cells).any():
            return _least_body_extent_bar(run, axis, kinds)
        return _least_extent_bar(run, axis, kinds, history)
    if name == "contact_area":
        smooth = np.maximum(_least_rim_area(run, kinds, history), _thin_area(run, history))
        return np.maximum(_least_end_area(run, kinds, history), smooth)
    if name in MOMENTS:
        smooth = _least_moment_bar(run, name, kinds, history)
        return np.maximum(smooth, _least_end_tilt(run, name, kinds, history))
    if name in GRIPPING:
        return _least_grip_bar(run, name, history)
    if name in RESISTANCES:
        return least_resistance_bar(run, name, history)
    if name in LEAST_ERRORS and name != run.problem.load.control:
        return _least_bulk_bar(run, name, kinds, history)
    return 0.0


def agrees(differences: Floats, extents: Floats) -> bool:
    """Test whether the grids agree on an extent at all times: it is that of the body."""
    return bool(np.all(~(differences > AGREEMENT_TOLERANCE * extents)))


def _least_grip_bar(run: RunSetup, name: str, history: History) -> Floats:
    """Usual errors of a contact under friction on the cells across it."""
    across = np.maximum(cells_of_breadth(run, history), 1.0)
    given = name.removeprefix("tangential_")
    problem = run.problem
    rolls = problem.motion.creepage is not None and name in ("creepage", *SHIFTS)
    if rolls or getattr(problem.tangential, given, None) is not None:  # a prescribed motion
        return np.zeros(across.size)
    if name in ("stick_area", "slip_fraction"):
        whole = history["contact_area"] if name == "stick_area" else np.ones(across.size)
        partial = history["slip_fraction"] > 0
        return np.asarray(np.where(partial, LEAST_STICK_ERROR / across * whole, 0.0))
    least = LEAST_HEAT_ERROR if name.startswith("friction") else LEAST_SHIFT_ERROR
    return np.asarray(least / across**2 * np.abs(np.nan_to_num(history[name])))


def _least_extent_bar(run: RunSetup, axis: int, kinds: ContactKinds, history: History) -> Floats:
    """Parts of a cell [m]."""
    length, other = run.grid.cell_size[axis], run.grid.cell_size[1 - axis]
    few = 1 + (FEW_CELLS / np.maximum(history["cells_across"], 1.0)) ** 2
    # Cells along a line contact have no influence.
    long = LONG_CELLS * max(other / length - 1, 0.0) if run.grid.shape[1 - axis] > 1 else 0.0
    smooth = RIM_CELLS * (few + long) + TIP_CELLS * tip_curvature(run, history)[axis]
    smooth = smooth + RECEDING_EXTENT_CELLS * _just_receding(run, history)
    steep = STEEP_RIM_CELLS / np.maximum(history["cells_across"], 1.0) ** 2
    smooth = smooth + steep * kinds.steepness
    smooth = np.asarray(smooth + crest_cells(run, history, axis))
    smooth = np.maximum(smooth, 2 * thin_rim_cells(run, axis))
    parts = np.where(kinds.of_spots, SPOT_RIM_CELLS, smooth)
    if min(straight_ends(run)) < np.inf:
        parts = np.where(kinds.at_end, END_RIM_CELLS, parts)
        parts = np.where(kinds.at_end & kinds.singular, SHARP_RIM_CELLS, parts)
    return np.asarray(parts * length)


def _thin_area(run: RunSetup, history: History) -> Floats:
    """Least error of the area on thin layers [m²]."""
    strips = fills_period(run, history)
    rims = [
        np.where(strips[1 - axis], 2.0, 4.0) * thin_rim_cells(run, axis) * ~strips[axis]
        for axis in (0, 1)
    ]
    relative = np.max(rims, axis=0) / np.maximum(cells_across(run, history), 1.0)
    return np.asarray(relative * history["contact_area"])


def _least_body_extent_bar(run: RunSetup, axis: int, kinds: ContactKinds) -> Floats:
    """Cells in which the contact may end before the body does [m]: pressure falls to its ends."""
    uncertain = ~kinds.rises[axis] & (not run.grid.periodic[axis])
    return np.asarray(np.where(uncertain, LAST_CELLS * run.grid.cell_size[axis], 0.0))


def _least_rim_area(run: RunSetup, kinds: ContactKinds, history: History) -> Floats:
    """Least error of the area where the rim is steep, or curved within long cells [m²]."""
    across, along = np.maximum(cells_across(run, history), 1.0), cells_along(run, history)
    smooth = LEAST_AREA_ERROR / across**2
    breadth = np.maximum(cells_of_breadth(run, history), 1.0)
    smooth = smooth + 4 * RECEDING_RIM_CELLS * _just_receding(run, history) / breadth
    steep = np.where(kinds.steep, STEEP_AREA_ERROR / across, 0.0)
    tip = TIP_AREA * tip_curvature(run, history).max(axis=0) ** 2 / (along * across)
    strip = np.where(in_several_strips(run, history), STRIP_AREA_ERROR / across, 0.0)
    jumps = np.interp(curvature_jumps(run, history), SHARP_JUMP, (0.0, 1.0))
    jump = 4 * JUMP_RIM_CELLS * jumps / across
    relative = np.max(np.broadcast_arrays(smooth, steep, tip, strip, jump), axis=0)
    return np.asarray(relative * history["contact_area"])


def _just_receding(run: RunSetup, history: History) -> Floats:
    """1 where a contact on a creeping body has receded by part of a cell, 0 from one cell on."""
    area, largest = history["contact_area"], np.maximum.accumulate(history["contact_area"])
    if run.problem.surface.creep.is_elastic or not run.problem.motion.stands:
        return np.zeros(len(area))
    # The way of a rim, over the half width of the contact, is half the relative change of its area.
    parts = 1 - np.divide(area, largest, out=np.ones_like(area), where=largest > 0)
    ways = parts * cells_of_breadth(run, history) / 4
    # A contact that grows again does so over the surface that it has just left.
    changes = np.diff(area)
    grows_again = np.append(False, changes > 0) & (ways < 1)
    faded = np.where(grows_again, 1.0, np.maximum(1 - ways, 0.0))
    receding = moving_maximum(np.minimum(ways / LARGEST_RIM_ERROR_AT, 1.0) * faded)
    smallest = np.append(False, changes < 0) & np.append(changes > 0, False)
    smallest[1:] |= smallest[:-1]
    return np.where(smallest, SMALLEST_CONTACT, receding)


def _least_end_area(run: RunSetup, kinds: ContactKinds, history: History) -> Floats:
    """Cells at straight ends in which the contact becomes wider, or ends before the body [m²]."""
    if min(straight_ends(run)) == np.inf:
        return np.zeros(len(kinds.at_end))
    uncertain = kinds.at_end & ~kinds.rises.all(axis=0)
    relative = LEAST_END_AREA_ERROR / cells_along(run, history)
    return np.asarray(np.where(uncertain, relative * history["contact_area"], 0.0))


def _least_moment_bar(run: RunSetup, name: str, kinds: ContactKinds, history: History) -> Floats:
    """Effect of the solver's tolerance of the moments, and of a rim among the cells."""
    axis = int(name.endswith("y"))
    extent = np.nan_to_num(history[EXTENTS[axis]])
    slope = np.abs(np.nan_to_num(indentation(history))) / np.maximum(extent, TINY)
    part, lever = (LEAST_OFFSET, extent) if name.startswith("eccentricity") else (LEAST_TURN, slope)
    by_solver = run.problem.solver_error * lever
    by_cells = part * lever / np.maximum(extent / run.grid.cell_size[axis], 1.0) ** 2
    by_cells = by_cells * np.where(kinds.steep, STEEP_OFFSETS, 1.0)
    # Both grids of a symmetric contact have none.
    moved = np.abs(np.nan_to_num(history[name])) > by_solver
    return np.asarray(np.where(extent > 0, np.where(moved, by_solver + by_cells, by_solver), 0.0))


def _least_end_tilt(run: RunSetup, name: str, kinds: ContactKinds, history: History) -> Floats:
    """Usual error of a tilt on the cells along a contact that reaches a curved end."""
    given = name.startswith("eccentricity") or getattr(run.problem.load, name) is not None
    uncertain = kinds.ended & (min(straight_ends(run)) == np.inf) & (not given)
    relative = LEAST_END_TILT_ERROR / np.fmax.accumulate(cells_along(run, history))
    return np.asarray(np.where(uncertain, relative * np.abs(history[name]), 0.0))


def _least_bulk_bar(run: RunSetup, name: str, kinds: ContactKinds, history: History) -> Floats:
    """Usual errors on the cells across the contact, or along it where it reaches the end."""
    across = np.minimum(cells_across(run, history), cells_of_breadth(run, history))
    long = LONG_CONTACT * slenderness(history) if name in ("approach", "force") else 0.0
    least = LEAST_ERRORS[name] + long
    # Cells along a line contact have no influence.
    ratios = [cells_over_thickness(run, k) for k in (0, 1) if run.grid.shape[k] > 1]
    least = least * (1 + THIN_GROWTH * min(ratios, default=0.0) ** 2)
    relative = np.where(across > 0, least / np.maximum(across, 1.0) ** 2, 0.0)
    if name == "work":  # it keeps the error of a contact that is lost
        largest = np.maximum.accumulate(np.where(np.isfinite(across), across, 0.0))
        relative = np.where(across > 0, relative, least / np.maximum(largest, 1.0) ** 2)
    steep = STEEP_ERRORS.get(name, 0.0) / np.maximum(across, 1.0)
    if name == "work":
        steep = np.maximum(steep, STEEP_WORK_ERROR * kinds.steepness / np.maximum(across, 1.0) ** 2)
    relative = np.where(kinds.steep & (across > 0), np.maximum(relative, steep), relative)
    longest = np.fmax.accumulate(cells_along(run, history))
    curved = kinds.ended & (min(straight_ends(run)) == np.inf)
    at_end = np.where(curved, LEAST_END_ERROR / longest, 0.0)
    return np.asarray(np.maximum(relative, at_end) * np.abs(history[name]))


def least_resistance_bar(run: RunSetup, name: str, history: History) -> Floats:
    """Effect of the tolerance of the gap over times [N]: force times slope of the indentation."""
    motion = run.problem.motion
    extent = np.fmax(history["contact_length"], history["contact_width"])
    slope = np.abs(np.nan_to_num(indentation(history))) / np.maximum(np.nan_to_num(extent), TINY)
    coefficient = np.where(extent > 0, run.problem.solver_error * slope, 0.0)
    if name == "friction_coefficient":
        return np.asarray(coefficient)
    force = np.nan_to_num(history["force"]) * coefficient
    if name != "motion_work":
        return np.asarray(force)
    ways = np.hypot(*np.diff(motion.position_at(history["time"]), axis=0, prepend=np.nan).T)
    return np.asarray(np.cumsum(force * np.nan_to_num(ways)))
