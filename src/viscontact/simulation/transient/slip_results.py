"""Scalars, fields and warnings of a step under friction, as in the result."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.simulation.checks.friction import Grip
from viscontact.simulation.checks.motion import rolling_radius
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.slip_state import ROUNDING, SlipState, StepSlip
from viscontact.simulation.transient.slip_step import SlipStep

#: Gap over the displacement from which on a cell that enters was apart before.
TOUCHING = 1e-6

#: Part of the shift of a body, turning included, below which a change of it counts as rounding.
AT_REST = 1e-7


def slip_scalars(
    run: RunSetup, duration: float, before: SlipState, after: SlipState, step: StepSlip
) -> dict[str, float]:
    """Scalars at the end of a step of a duration [s]."""
    # Without a datum displacements are not known.
    grid, has_datum = run.grid, run.has_datum
    motion = after.motion if has_datum else np.full(3, math.nan)
    sticks, touches = np.count_nonzero(step.state == 1), np.count_nonzero(step.state)
    radius = math.sqrt(touches * grid.cell_area / math.pi)
    stiffness = _stiffness(before, after, radius) if has_datum else (math.nan, math.nan)
    lost = after.heat - before.heat
    return {
        "tangential_force_x": float(after.forces[0]),
        "tangential_force_y": float(after.forces[1]),
        "torque": math.nan if any(grid.periodic) else float(after.forces[2]),
        "tangential_displacement_x": float(motion[0]),
        "tangential_displacement_y": float(motion[1]),
        "rotation": float(motion[2]),
        "stick_area": sticks * grid.cell_area,
        "slip_fraction": 1 - sticks / touches if touches else 0.0,
        "friction_heat": after.heat,
        "friction_power": lost / duration if duration > 0 else math.nan,
        "tangential_stiffness_x": stiffness[0],
        "tangential_stiffness_y": stiffness[1],
        "duality_gap": step.duality_gap,
    }


def rolling_scalars(
    run: RunSetup, step: tuple[float, float], before: SlipState, after: SlipState
) -> dict[str, float]:
    """Further scalars of a body that rolls in a step between two times [s]."""
    begin, end = step
    way = np.subtract(run.position_at(end), run.position_at(begin))
    length = float(np.hypot(*way))
    if not length > 0:
        return {"creepage": math.nan, "drive_torque": math.nan}
    along = way / length
    shift = float((after.motion - before.motion)[:2] @ along)
    pushes = -float(after.forces[:2] @ along)  # the body ahead
    radius = rolling_radius(run.problem, run.problem.motion)
    torque = pushes * radius if math.isfinite(radius) else math.nan
    return {"creepage": -shift / length, "drive_torque": torque}


def slip_fields(after: SlipState, step: StepSlip) -> dict[str, Any]:
    """Fields at the end of a step, read-only."""
    fields = {
        "traction_x": after.traction[0],
        "traction_y": after.traction[1],
        "slip_x": after.slip[0],
        "slip_y": after.slip[1],
        "slip_state": step.state,
        "friction_work": after.work,
    }
    for field in fields.values():
        field.flags.writeable = False
    return fields


def grip_of(grid: Grid, step: SlipStep, after: SlipState, slip_fraction: float) -> Grip:
    """What the contact carries at the end of a step."""
    cells, held = (each.contact.cells for each in (after, step.before))
    force = float(np.hypot(*step.constraints.resultants[:2]))
    slipping = round(cells * slip_fraction)
    on_line = min(grid.shape) == 1
    contact, before = after.contact, step.before.contact
    open_before = before.gap > TOUCHING * contact.displacement
    approached = bool((contact.entered_since(before) & open_before).any())
    return Grip(step.time, force, step.carried, cells, slipping, held, on_line, approached)


def _stiffness(before: SlipState, after: SlipState, radius: float) -> tuple[float, float]:
    """Changes of the forces over those of the shifts in the step; NaN at rest [N/m].

    `radius` is that of a circle as large as the contact [m].
    """
    moved, added = after.motion - before.motion, after.forces - before.forces
    moved[np.abs(moved) <= AT_REST * np.abs(after.motion * (1.0, 1.0, radius)).max()] = 0.0
    added[np.abs(added) < ROUNDING * np.abs(after.forces)] = 0.0
    along_x, along_y = (
        float(added[axis] / moved[axis]) if moved[axis] else math.nan for axis in (0, 1)
    )
    return along_x, along_y
