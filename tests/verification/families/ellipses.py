"""Elliptical contacts, rotated and shifted, on elastic and on creeping bodies.

Truth: Hertz 1882 for the ellipse. Its axis ratio depends on the body alone; so force, approach
and size follow each other as under a ball of the same stiffness, whatever the law (Graham 1965,
Int. J. Eng. Sci. 3, 27; Ting 1968 for contacts that shrink), and the rods of that ball give them.
"""

import math
from dataclasses import dataclass

import numpy as np

import viscontact as vc
from verification.families.creep_curves import Creep, random_creep
from verification.families.exact_run import ExactRun
from verification.families.random_loads import (
    SMOOTH,
    history_of_points,
    jump_and_ramp,
    ramp_and_hold,
    random_times,
    step_and_hold,
    triangle,
)
from verification.families.round_bodies import (
    beside,
    cells_across,
    contact_size,
    grid_around,
    solution,
)
from verification.families.round_profiles import RoundBody, RoundProfile
from viscontact import reference

Array = np.ndarray


@dataclass(frozen=True)
class Ellipse:
    """An elliptic paraboloid as a ball of the same stiffness: ratios to the ball's contact."""

    radius_x: float
    radius_y: float
    ball: float  # radius of the ball [m]
    axis_x: float  # half axes over the radius of the ball's contact [-]
    axis_y: float

    @classmethod
    def of(cls, radius_x: float, radius_y: float) -> "Ellipse":
        """From Hertz's solution under a unit of force and of modulus."""
        hertz = reference.hertz_elliptical(1.0, radius_x, radius_y, 1.0)
        ball = (0.75 / hertz.approach**1.5) ** 2
        radius = math.sqrt(ball * hertz.approach)
        return cls(radius_x, radius_y, ball, hertz.semi_axis_x / radius, hertz.semi_axis_y / radius)

    @property
    def body(self) -> RoundBody:
        ball = self.ball
        profile = RoundProfile(lambda r: r / ball, lambda s: s**2 / ball, 0.5 * ball)
        return RoundBody("ellipse", vc.Paraboloid(ball, ball), profile)

    def scalars(self, of_ball: dict[str, Array], angle: float) -> dict[str, Array]:
        """Scalars of the ellipse, turned by an angle [rad]."""
        radius, force = of_ball["contact_length"] / 2, of_ball["force"]
        a, b = self.axis_x * radius, self.axis_y * radius
        area = math.pi * a * b
        cosine, sine = math.cos(angle), math.sin(angle)
        values = {
            "force": force,
            "approach": of_ball["approach"],
            "work": of_ball["work"],
            "contact_area": area,
            "contact_length": 2 * np.hypot(a * cosine, b * sine),
            "contact_width": 2 * np.hypot(a * sine, b * cosine),
            "mean_pressure": np.divide(force, area, out=np.zeros_like(area), where=area > 0),
        }
        if "peak_pressure" in of_ball:
            values["peak_pressure"] = of_ball["peak_pressure"] / (self.axis_x * self.axis_y)
        return values


def _pressed_ellipse(
    rng: np.random.Generator, ratio: float, angle: float, creep: Creep, name: str
) -> ExactRun:
    """A run with an ellipse of a ratio of radii, under one loading and at most one unloading."""
    a = contact_size(rng)
    radius_y = a * 10 ** rng.uniform(1, 2)
    ellipse = Ellipse.of(ratio * radius_y, radius_y)
    creeping = creep.name != "elastic"
    kinds = (ramp_and_hold, triangle, *((step_and_hold, jump_and_ramp) if creep.jumps else ()))
    kind = kinds[rng.integers(len(kinds))] if creeping else SMOOTH[rng.integers(len(SMOOTH))]
    points = kind(rng)
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    end = creep.time * 10 ** rng.uniform(-0.5, 0.8)
    radius = a / ellipse.axis_y
    approach = radius**2 / ellipse.ball
    compliance = float(creep.compliance(np.array([end / 2]))[0])
    force = 4 / 3 * radius * approach / compliance
    load = history_of_points(points, control, force if control == "force" else approach, end)
    body = ellipse.body
    reach = _reach(ellipse, solution(body, creep, load, np.linspace(0, end, 30), 0.5), angle)
    grid, cells = _grid(rng, ellipse, reach, angle)
    most = int(np.clip(6e4 / cells, 4, 25))
    times = random_times(rng, end, most=max(most, 6))[: 3 * most]
    aside = [rng.uniform(-0.5, 0.5) * cell for cell in grid.cell_size]
    indenter = vc.Paraboloid(ellipse.radius_x, radius_y).rotated(angle).shifted(*aside)
    load, more = beside(rng, load, aside)

    def exact(t: Array) -> dict[str, Array]:
        values = ellipse.scalars(solution(body, creep, load, t).scalars(peak=creep.jumps), angle)
        del values[load.control]
        touching = values["contact_area"] > 0
        return values | {each: np.where(touching, value, np.nan) for each, value in more.items()}

    options = dict(creep.more)
    return ExactRun(name, indenter, creep.material, load, grid, times, exact, options)


def _reach(ellipse: Ellipse, found: object, angle: float) -> tuple[float, float]:
    """Half extents of the largest contact along x and y [m]."""
    radius = float(found.contact_radius.max())
    a, b = ellipse.axis_x * radius, ellipse.axis_y * radius
    cosine, sine = abs(math.cos(angle)), abs(math.sin(angle))
    return math.hypot(a * cosine, b * sine), math.hypot(a * sine, b * cosine)


def _grid(
    rng: np.random.Generator, ellipse: Ellipse, reach: tuple[float, float], angle: float
) -> tuple[vc.Grid, int]:
    """A grid whose cells resolve the narrow axis, however it lies; and its number of cells."""
    slender = max(ellipse.axis_x, ellipse.axis_y) / min(ellipse.axis_x, ellipse.axis_y)
    across = min(cells_across(rng)[0], max(10.0, 60.0 / slender**0.5))
    if abs(math.sin(2 * angle)) < 1e-9:
        along = across * math.exp(rng.uniform(0.0, 0.5))
        counts = (along, across) if reach[0] >= reach[1] else (across, along)
    else:
        tilted = math.hypot(ellipse.axis_x * math.cos(angle), ellipse.axis_y * math.sin(angle))
        narrow = min(ellipse.axis_x, ellipse.axis_y) * reach[0] / tilted
        counts = tuple(max(across * half / narrow, 10.0) for half in reach)
    grid = grid_around(rng, reach, (counts[0], counts[1]))
    return grid, grid.shape[0] * grid.shape[1]


def turned_ellipse(rng: np.random.Generator) -> ExactRun:
    """Ratios of radii up to 20, turned by any angle."""
    creep = random_creep(rng)
    ratio, angle = math.exp(rng.uniform(0.1, math.log(20))), rng.uniform(0, math.pi)
    name = f"ellipse {ratio:.3g}:1 at {math.degrees(angle):.0f} deg, {creep.name}"
    return _pressed_ellipse(rng, ratio, angle, creep, name)


def slender_ellipse(rng: np.random.Generator) -> ExactRun:
    """Ratios of radii from 20 to 100, along an axis or turned."""
    creep = random_creep(rng)
    ratio = math.exp(rng.uniform(math.log(20), math.log(100)))
    angle = rng.uniform(0, math.pi) if rng.random() < 0.4 else rng.integers(2) * math.pi / 2
    name = f"ellipse {ratio:.3g}:1 at {math.degrees(angle):.0f} deg, {creep.name}"
    return _pressed_ellipse(rng, ratio, angle, creep, name)
