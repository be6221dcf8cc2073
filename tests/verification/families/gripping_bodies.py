"""Round bodies under friction: pulled, shifted or turned while the normal load varies.

Truth: the same run on three times the cells in thirds of the steps. Its uncertainty is twice the
difference from twice the cells in halves, its own error where that falls with the cells.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

import viscontact as vc
from verification.families.creep_curves import random_creep
from verification.families.exact_run import ExactRun, NotDrawnError
from verification.families.finer_runs import FinerRuns
from verification.families.random_loads import (
    Points,
    history_of_points,
    jump_and_ramp,
    random_times,
    step_and_hold,
)
from verification.families.round_bodies import (
    cells_across,
    contact_size,
    grid_around,
    largest_level,
    solution,
)
from verification.families.round_profiles import random_body

Array = np.ndarray

#: Compared scalars. Power and stiffness are of a step, and the steps are not the same.
SCALARS = (
    *("tangential_displacement_x", "tangential_displacement_y", "rotation"),
    *("tangential_force_x", "tangential_force_y", "torque"),
    *("stick_area", "slip_fraction", "friction_heat"),
)


def pulled_body(rng: np.random.Generator) -> ExactRun:
    """A force along any direction, to and fro."""

    def pull(corners: Array, levels: Array, force: float, depth: float, a: float) -> Any:
        turn = rng.uniform(0, 2 * math.pi) if rng.random() < 0.5 else 0.0
        ahead, aside = (force * levels * part(turn) for part in (np.cos, np.sin))
        return vc.TangentialHistory(corners, force_x=ahead, force_y=aside)

    return _gripped(rng, "pulled", pull, 0.9)


def shifted_body(rng: np.random.Generator) -> ExactRun:
    """A shift that may make the whole contact slide."""

    def shift(corners: Array, levels: Array, force: float, depth: float, a: float) -> Any:
        turn = rng.uniform(0, 2 * math.pi) if rng.random() < 0.5 else 0.0
        ahead, aside = (depth * levels * part(turn) for part in (np.cos, np.sin))
        return vc.TangentialHistory(corners, displacement_x=ahead, displacement_y=aside)

    return _gripped(rng, "shifted", shift, 1.5)


def turned_body(rng: np.random.Generator) -> ExactRun:
    """A torque or a rotation."""

    def turn(corners: Array, levels: Array, force: float, depth: float, a: float) -> Any:
        if rng.random() < 0.5:
            return vc.TangentialHistory(corners, torque=0.5 * force * a * levels)
        return vc.TangentialHistory(corners, rotation=depth / a * levels)

    return _gripped(rng, "turned", turn, 0.9)


def coupled_body(rng: np.random.Generator) -> ExactRun:
    """Any of these on a material whose pressure feels the tractions, against a rigid body."""
    run = (pulled_body, shifted_body, turned_body)[rng.integers(3)](rng)
    ratio, own = float(rng.uniform(0.0, 0.5)), run.material.poisson_ratio
    assert own is not None  # of all laws that are drawn
    # The contact grows with the root of the compliance, 1 - ν, at most.
    larger = max(math.sqrt((1 - ratio) / (1 - own)), 1.0)
    grid = replace(run.grid, size=tuple(larger * each for each in run.grid.size))
    friction = vc.Friction(run.more["friction"].coefficient)
    coupled = replace(
        run,
        name=f"coupled {run.name}",
        material=replace(run.material, poisson_ratio=ratio),
        grid=grid,
        more=dict(run.more) | {"friction": friction},
    )
    return _compared(coupled)


def _gripped(rng: np.random.Generator, name: str, load_along: Any, most: float) -> ExactRun:
    creep, a = random_creep(rng), contact_size(rng)
    if not creep.jumps:
        raise NotDrawnError("no instant compliance")
    body, (kind, points) = random_body(rng, a), _normal_points(rng)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.7)
    load = history_of_points(
        points, "force", largest_level(body, creep, "force", a, end), end, tilt_x=0.0, tilt_y=0.0
    )
    found = solution(body, creep, load, np.linspace(0, end, 30), 0.5)
    reach = float(found.contact_radius.max())
    coefficient = float(10 ** rng.uniform(-1.3, 0))
    corners, levels = _corners(rng, end, most)
    force = coefficient * float(np.min(load.force))
    depth = coefficient * float(np.max(found.scalars(peak=False)["approach"]))
    along = load_along(corners, levels, force, depth, reach)
    grid = grid_around(rng, (reach, reach), cells_across(rng, 30))
    more = dict(creep.more) | {
        "friction": vc.Friction(coefficient, coupling=False),
        "tangential": along,
    }
    kinks = np.unique([*corners, *(each for each in np.atleast_1d(load.times) if each <= end)])
    times = random_times(rng, end, most=24)
    apart = np.abs(times[:, None] - kinks).min(axis=1) > 1e-3 * end
    times = np.unique([*times[apart], *kinks])
    run = ExactRun(
        f"{name} {body.name}, {kind} force, {creep.name}",
        *(body.indenter, creep.material, load, grid, times),
        exact=lambda at: {},
        more=more,
    )
    return _compared(run)


def _compared(run: ExactRun) -> ExactRun:
    """A run with its truth, of finer ones."""
    finer = FinerRuns(run, SCALARS, 2.0)
    return replace(run, exact=finer.values, uncertainty=finer.uncertainty)


def _normal_points(rng: np.random.Generator) -> tuple[str, Points]:
    """A force that is never zero: held, or rising or falling after a jump."""
    kind = (step_and_hold, jump_and_ramp)[rng.integers(2)]
    return kind.__name__.replace("_", " "), kind(rng)


def _corners(rng: np.random.Generator, end: float, most: float) -> tuple[Array, Array]:
    """Instants and levels of a load along the surface, to and fro."""
    count = int(rng.integers(2, 6))
    parts = np.append(0.0, np.cumsum(rng.uniform(0.3, 1.0, count)))
    sizes = rng.uniform(0.2, most, count) * np.where(np.arange(count) % 2, -1, 1)
    if rng.random() < 0.3:  # on and on, not to and fro
        sizes = np.sort(np.abs(sizes))
    return end * parts / parts[-1], np.append(0.0, sizes)
