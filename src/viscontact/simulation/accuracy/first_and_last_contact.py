"""Error bars at the first and the last contact, and without contact."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.loads import MixedHistory
from viscontact.simulation.accuracy.coarser_results import (
    CoarserResult,
    History,
    indentation,
    with_contact,
)
from viscontact.simulation.accuracy.refinement_levels import aligned, moving_maximum
from viscontact.simulation.accuracy.rim_cells import EXTENTS
from viscontact.simulation.transient.setup import RunSetup

#: Scalars that are exactly zero without contact.
ZERO_WITHOUT_CONTACT = (
    *("force", "contact_area", "contact_length", "contact_width"),
    *("peak_pressure", "mean_pressure", "peak_line_load"),
)

#: Those that are zero without contact of bodies that adhere, too.
ZERO_APART = ("contact_area", *EXTENTS)

#: The same of a contact under friction.
ZERO_WITHOUT_GRIP = (
    *("tangential_force_x", "tangential_force_y", "torque"),
    *("stick_area", "slip_fraction"),
)

#: The same of a moving contact, and those that are zero before the first contact.
ZERO_WITHOUT_MOVING_CONTACT = ("resistance_x", "resistance_y")
ZERO_BEFORE_CONTACT = ("motion_work", "dissipation", "heat")

#: Cells across the contact up to which its peak may be any below that of more cells, and its place
#: any within a cell; below which its area may be any smaller one.
FIRST_CELLS = 3.0


def touching_times(history: History, results: list[CoarserResult]) -> Bools:
    """Times of contact in the run or in a coarser one."""
    touching = with_contact(history)
    for result in results:
        touching |= np.nan_to_num(aligned("contact_area", history["time"], result)) > 0
    return touching


def before_loss(history: History) -> Bools:
    """Last times of contact before it is lost."""
    touching = with_contact(history)
    return np.asarray(touching & ~np.append(touching[1:], True))


def _before_first_cell(history: History, touching: Bools) -> Bools:
    """Times after the first touch at which the contact is still smaller than a cell."""
    return np.asarray(~np.logical_or.accumulate(touching) & (indentation(history) > 0))


def bound_by_first_contact(values: dict[str, Floats], history: History) -> None:
    """Take the scalars of the first cells and their bars as errors of a contact below a cell."""
    contact = with_contact(history)
    early = _before_first_cell(history, contact)
    if not early.any() or not contact.any():
        return
    first = int(contact.argmax())
    for name in ZERO_WITHOUT_CONTACT:
        # Unknown if those of the first cells are, as a mean pressure over an area that may be zero.
        largest = np.abs(history[name][first]) + values[name][first]
        values[name][early] = np.maximum(values[name][early], largest)


def bound_by_few_cells(area_bars: Floats, history: History) -> Floats:
    """Bars of the area; of a contact of one or two cells across it may be any smaller one [m²]."""
    few = history["cells_across"] < FIRST_CELLS
    return np.where(few, np.fmax(area_bars, history["contact_area"]), area_bars)


def bound_in_first_cells(values: dict[str, Floats], history: History) -> None:
    """Take the way to the peak and place of more cells as error of those of the first cells."""
    contact, across = with_contact(history), history["cells_across"]
    first = int(contact.argmax())
    more = across[first:] > FIRST_CELLS
    if not more.any():
        return
    later = first + int(more.argmax())
    for name in ("peak_pressure", "eccentricity_x", "eccentricity_y"):
        ways = np.abs(history[name][later] - history[name][first:later])
        values[name][first:later] = np.fmax(values[name][first:later], ways)


def certainly_separated(run: RunSetup, history: History, touching: Bools) -> Bools:
    """Times without contact in the run, and under a given approach without any next to them."""
    apart = ~with_contact(history)
    load, times = run.problem.load, history["time"]
    if load.control == "force":
        return apart
    near = moving_maximum(touching, 1) > 0
    if isinstance(load, MixedHistory):
        # Under no force, and where the end of contact is what ended a segment, there is none.
        lost = [event.time for event in load.events if event.scalar == "contact"]
        unloaded = [time for time in times.tolist() if load.at(time).force is not None]
        near &= ~np.isin(times, [*lost, *unloaded])
    return np.asarray(apart & ~near & ~_before_first_cell(history, touching))


def zero_without_contact(
    run: RunSetup, values: dict[str, Floats], apart: Bools, touching: Bools
) -> None:
    """Set bars of zero at instants at which bodies are apart, or have not touched before."""
    without = ZERO_WITHOUT_CONTACT if run.law is None else ZERO_APART
    zero: list[tuple[tuple[str, ...], Bools]] = [(without, apart)]
    if not run.problem.motion.stands:
        before = apart & ~np.logical_or.accumulate(touching)
        zero += [(ZERO_WITHOUT_MOVING_CONTACT, apart), (ZERO_BEFORE_CONTACT, before)]
    if run.problem.friction is not None:
        zero.append((ZERO_WITHOUT_GRIP, apart))
        if not run.problem.motion.stands:
            zero.append((("drive_torque",), apart))
    for names, where in zero:
        for name in names:
            values[name][where] = 0.0
