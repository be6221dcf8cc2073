"""Balls at a given tilt, and balls on bodies whose law spans many decades.

A paraboloid of radius R at a tilt θ is the same paraboloid beside the origin by R θ, and deeper by
R θ²/2: r²/(2R) - θ x = ((x - R θ)² + y²)/(2R) - R θ²/2.
"""

import math

import numpy as np

import viscontact as vc
from verification.families.creep_curves import Creep, CreepSum, random_creep
from verification.families.exact_run import ExactRun
from verification.families.random_loads import (
    history_of_points,
    jump_and_ramp,
    ramp_and_hold,
    random_points,
    random_times,
    step_and_hold,
)
from verification.families.round_bodies import (
    cells_across,
    contact_size,
    grid_around,
    largest_level,
    round_exact,
    run_of,
    solution,
)
from verification.families.round_profiles import paraboloid, random_body

Array = np.ndarray


def tilted_ball(rng: np.random.Generator) -> ExactRun:
    """A paraboloid under any history, clamped at a tilt that moves its contact by up to a third."""
    creep, a = random_creep(rng), contact_size(rng)
    body = paraboloid(rng, a)
    radius = body.indenter.radius_x
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    kind, points = random_points(rng, jumps=creep.jumps)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    upright = history_of_points(points, control, largest_level(body, creep, control, a, end), end)
    reach = float(solution(body, creep, upright, np.linspace(0, end, 30), 0.5).contact_radius.max())
    turn, aside = rng.uniform(0, 2 * math.pi), reach * rng.uniform(0.05, 0.33)
    place = {"x": aside * math.cos(turn), "y": aside * math.sin(turn)}
    deeper = aside**2 / (2 * radius)
    tilts = {f"tilt_{axis}": each / radius for axis, each in place.items()}
    if control == "force":
        load = vc.ForceHistory(upright.times, upright.force, **tilts)
    else:
        load = vc.ApproachHistory(upright.times, upright.approach - deeper, **tilts)
    known = {f"eccentricity_{axis}": each for axis, each in place.items()}
    exact_upright = round_exact(body, creep, upright, known)

    def exact(t: Array) -> dict[str, Array]:
        values = exact_upright(t)
        if "approach" in values:
            values["approach"] = values["approach"] - deeper
        return values

    wider = tuple(reach + abs(each) for each in place.values())
    across = cells_across(rng)
    counts = tuple(count * half / reach for count, half in zip(across, wider, strict=True))
    grid = grid_around(rng, (wider[0], wider[1]), (counts[0], counts[1]))
    name = f"tilted ball, {kind} of {control}, {creep.name}"
    times = random_times(rng, end, most=30)
    return ExactRun(name, body.indenter, creep.material, load, grid, times, exact, dict(creep.more))


def wide_law(rng: np.random.Generator) -> ExactRun:
    """Four to seven retardation times over three to six decades, in logarithmic steps."""
    shear, ratio, time = 10 ** rng.uniform(6, 9), rng.uniform(0.2, 0.5), 10 ** rng.uniform(0, 4)
    count, part = int(rng.integers(4, 8)), 1 - ratio
    delays = time * np.geomspace(10 ** -rng.uniform(3, 6), 1.0, count)
    amplitudes = rng.uniform(0.2, 2.0, count) / (2 * shear)
    law = vc.CreepSeries(1 / (2 * shear), amplitudes.tolist(), delays.tolist())
    delayed = zip((part * amplitudes).tolist(), delays.tolist(), strict=True)
    compliance = CreepSum(part / (2 * shear), tuple(delayed))
    creep = Creep("wide series", vc.Material(law, ratio), compliance, time)
    a = contact_size(rng)
    body = random_body(rng, a)
    control = "force" if rng.random() < 0.5 else "approach"
    kind = (step_and_hold, jump_and_ramp, ramp_and_hold)[rng.integers(3)]
    end = time * 10 ** rng.uniform(-0.3, 0.5)
    load = history_of_points(kind(rng), control, largest_level(body, creep, control, a, end), end)
    times = vc.log_times(end * 10 ** -rng.uniform(3, 6), end, int(rng.integers(8, 40)))
    if rng.random() < 0.2:
        times = random_times(rng, end, most=30)
    name = f"{body.name}, {kind.__name__.replace('_', ' ')} of {control}, {count} terms"
    return run_of(rng, body, creep, load, times, name)
