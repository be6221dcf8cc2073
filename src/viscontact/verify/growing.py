"""Verification cases of growing contacts: a ball under a sudden force, or a ramp."""

from __future__ import annotations

from functools import partial

import numpy as np

from viscontact import reference
from viscontact.bodies.loads import ramp, step
from viscontact.mechanics.time_integration.requested_times import log_times
from viscontact.verify.case import Case, Comparison, Quantity, history
from viscontact.verify.creeping import CreepingBody, all_bodies, maxwell, zener
from viscontact.verify.indentation import FORCE, RADIUS, press_ball


def _radius_at_end(body: CreepingBody) -> float:
    return float(np.cbrt(0.75 * RADIUS * FORCE * body.creep(np.array([body.end]))[0]))


def _step(body: CreepingBody, cells: int) -> tuple[Comparison, ...]:
    exact = reference.lee_radok_step(FORCE, RADIUS, body.creep, body.relaxation)
    times = log_times(body.first, body.end, 3 * cells)
    run = press_ball(
        body.material, step(FORCE), times, _radius_at_end(body), cells, indenter_material=body.ball
    )
    radius = np.asarray(exact.contact_radius(times))
    return (
        history(radius**2 / RADIUS, run.over_time("approach")),
        history(exact.pressure(0.0, times), run.central_pressure),
        history(radius, run.radius),
    )


def _ramp(body: CreepingBody, cells: int) -> tuple[Comparison, ...]:
    duration = 0.95 * body.end / 3
    exact = reference.lee_radok_ramp(FORCE, duration, RADIUS, body.creep, body.relaxation)
    # Pressure starts as the cube root of time.
    times = body.end * np.linspace(0, 1, 3 * cells + 1) ** 2
    run = press_ball(body.material, ramp(FORCE, duration), times, _radius_at_end(body), cells)
    radius = np.asarray(exact.contact_radius(times))
    late = np.flatnonzero(times >= duration / 5)  # a coarse mesh resolves these
    return (
        history(radius[late] ** 2 / RADIUS, run.over_time("approach")[late]),
        history(exact.pressure(0.0, times[late]), run.central_pressure[late]),
    )


CASES: tuple[Case, ...] = (
    *(
        Case(
            f"ball under a sudden force, {body.name}",
            "Lee & Radok 1960",
            (
                Quantity("approach", "m", 5e-4, 2e-4),
                Quantity("central pressure", "Pa", 2e-3, 8e-4),
                Quantity("contact radius", "m", 4e-3, 2e-3),
            ),
            (10, 20, 40),
            partial(_step, body),
        )
        for body in all_bodies()
    ),
    *(
        Case(
            f"ball under a ramp, {body.name}",
            "Lee & Radok 1960",
            (
                Quantity("approach", "m", 5e-4, 2e-4),
                Quantity("central pressure", "Pa", 4e-3, 1.5e-3),
            ),
            (10, 20, 40),
            partial(_ramp, body),
        )
        for body in (maxwell(), zener())
    ),
)
