"""Balls and ellipsoids under a force beside their axis.

A paraboloid x²/(2 Rx) + y²/(2 Ry) that is tilted by e_x/Rx and e_y/Ry is the same paraboloid around
(e_x, e_y), and deeper by e_x²/(2 Rx) + e_y²/(2 Ry): under a force there it turns so at once, and
does not turn further, whatever the law and the history.
"""

import math

import numpy as np

import viscontact as vc
from verification.families.creep_curves import random_creep
from verification.families.exact_run import ExactRun
from verification.families.random_loads import history_of_points, random_points, random_times
from verification.families.round_bodies import (
    cells_across,
    contact_size,
    grid_around,
    largest_level,
    round_exact,
    solution,
)
from verification.families.round_profiles import paraboloid

Array = np.ndarray


def eccentric_ball(rng: np.random.Generator) -> ExactRun:
    """A paraboloid that may turn, under a force up to some per cent of the contact beside it."""
    creep, a = random_creep(rng), contact_size(rng)
    while not creep.jumps:
        creep = random_creep(rng)
    body = paraboloid(rng, a)
    radius = body.indenter.radius_x
    kind, points = random_points(rng, jumps=True)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    upright = history_of_points(points, "force", largest_level(body, creep, "force", a, end), end)
    reach = float(solution(body, creep, upright, np.linspace(0, end, 30), 0.5).contact_radius.max())
    turn, aside = rng.uniform(0, 2 * math.pi), reach * 10 ** rng.uniform(-2.5, -0.5)
    place = {"x": aside * math.cos(turn), "y": aside * math.sin(turn)}
    if rng.random() < 0.3:
        place["y"] = 0.0
    deeper = (place["x"] ** 2 + place["y"] ** 2) / (2 * radius)
    load = vc.ForceHistory(
        upright.times, upright.force, eccentricity_x=place["x"], eccentricity_y=place["y"]
    )
    exact_upright = round_exact(body, creep, upright, {})

    def exact(t: Array) -> dict[str, Array]:
        values = exact_upright(t)
        touching = values["contact_area"] > 0
        values["approach"] = np.where(touching, values["approach"] - deeper, np.nan)
        for axis, each in place.items():
            values[f"tilt_{axis}"] = np.where(touching, each / radius, np.nan)
        del values["work"]  # the turn at the first touch takes some
        return values

    wider = tuple(reach + abs(each) for each in place.values())
    counts = tuple(
        count * half / reach for count, half in zip(cells_across(rng), wider, strict=True)
    )
    grid = grid_around(rng, (wider[0], wider[1]), (counts[0], counts[1]))
    name = f"eccentric ball, {kind} of force, {creep.name}"
    times = random_times(rng, end, most=20)
    return ExactRun(name, body.indenter, creep.material, load, grid, times, exact, dict(creep.more))


def eccentric_ellipsoid(rng: np.random.Generator) -> ExactRun:
    """Unequal radii; only the tilts have a closed form for any law."""
    run = eccentric_ball(rng)
    radius, ratio = run.indenter.radius_x, math.exp(rng.uniform(0.1, 1.2))
    radii = (radius * ratio, radius / ratio)
    places = run.load.eccentricity_x, run.load.eccentricity_y
    # The contact is about as slender as the body (Johnson 1985, section 4.2).
    slender = ratio ** (4 / 3)
    nx, ny = run.grid.shape
    size = run.grid.size[0] * math.sqrt(slender) * 1.2, run.grid.size[1] * 1.2 / math.sqrt(slender)
    grid = vc.Grid((round(nx * 1.3), round(ny * 1.1)), size)
    centred = run.exact

    def exact(t: Array) -> dict[str, Array]:
        touching = centred(t)["contact_area"] > 0
        return {
            f"tilt_{axis}": np.where(touching, place / each, np.nan)
            for axis, place, each in zip("xy", places, radii, strict=True)
        }

    name = run.name.replace("ball", "ellipsoid")
    body = vc.Paraboloid(*radii)
    return ExactRun(name, body, run.material, run.load, grid, run.times, exact, run.more)
