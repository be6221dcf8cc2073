"""Flat punches: round, elliptic and rectangular; dents after unloading; eccentric and tilted ones.

Truth: under a flat punch the pressure keeps its form, so one rod carries it (Boltzmann's integral;
Sneddon 1965 for the circle). The stiffness of any flat punch is π E* C, C the electrostatic
capacity of its outline: 2a/π of a circle, a/K(e) of an ellipse (Galin 1961, Contact Problems in the
Theory of Elasticity). Once the load is gone, the face rests on the whole of its recovering dent.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipk

import viscontact as vc
from verification.families.creep_curves import Creep, random_creep
from verification.families.exact_run import ExactRun, NotDrawnError
from verification.families.random_loads import (
    history_of_points,
    in_and_recover,
    jump_and_ramp,
    ramp_and_hold,
    random_points,
    random_times,
    staircase,
    step_and_hold,
    two_cycles,
)
from verification.families.rod_solution import RodSolution, solve_by_rods
from verification.families.round_bodies import cells_across, grid_around
from viscontact.reference import PunchProfile

Array = np.ndarray

#: Capacity of a rectangular plate over its shorter edge, by the ratio of its edges: extrapolated
#: from graded meshes of 48² to 96² elements, to 2e-6. Square: 0.36679, Read (1997), J. Comput.
#: Phys. 133, 1-5.
CAPACITIES = {1.0: 0.366788, 1.5: 0.453122, 2.0: 0.531918, 3.0: 0.676201, 4.0: 0.809329}


@dataclass(frozen=True)
class EllipticPunch(vc.Indenter):
    """A flat face within an ellipse."""

    half_length: float  # along x [m]
    half_width: float  # along y [m]

    def gap(self, x: ArrayLike, y: ArrayLike) -> Array:
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        inside = (x / self.half_length) ** 2 + (y / self.half_width) ** 2 <= 1
        return np.where(inside, 0.0, np.inf)


@dataclass(frozen=True, eq=False)
class Face:
    """A flat face, the radius of a round one as stiff, and its reach along x and y [m]."""

    name: str
    indenter: vc.Indenter
    radius: float
    area: float
    reach: tuple[float, float]


def _creep(rng: np.random.Generator, *, creeping: bool = False) -> Creep:
    """A law with instant compliance: without it a rod of no gap has no first state."""
    creep = random_creep(rng, creeping=creeping)
    while not creep.jumps:
        creep = random_creep(rng, creeping=creeping)
    return creep


def _round_face(rng: np.random.Generator) -> Face:
    a = 10 ** rng.uniform(-4, -2)
    return Face("round", vc.FlatPunch(a), a, math.pi * a**2, (a, a))


def _elliptic_face(rng: np.random.Generator) -> Face:
    a = 10 ** rng.uniform(-4, -2)
    b = a / math.exp(rng.uniform(0.1, math.log(6)))
    angle = rng.uniform(0, math.pi)
    cosine, sine = math.cos(angle), math.sin(angle)
    radius = math.pi * a / (2 * float(ellipk(1 - (b / a) ** 2)))
    reach = math.hypot(a * cosine, b * sine), math.hypot(a * sine, b * cosine)
    return Face("elliptic", EllipticPunch(a, b).rotated(angle), radius, math.pi * a * b, reach)


def _rectangular_face(rng: np.random.Generator) -> Face:
    ratio = list(CAPACITIES)[rng.integers(len(CAPACITIES))]
    edge = 10 ** rng.uniform(-4, -2)
    body = vc.FlatPunch(half_length=ratio * edge / 2, half_width=edge / 2)
    radius = math.pi / 2 * CAPACITIES[ratio] * edge
    return Face(f"{ratio:g}:1", body, radius, ratio * edge**2, (ratio * edge / 2, edge / 2))


def _solved(face: Face, creep: Creep, load: vc.LoadHistory, times: Array) -> RodSolution:
    """The rod is one number, so that many steps are cheap; only given approaches need them."""
    finer = 1.0 if load.control == "force" else 3.0
    try:
        return solve_by_rods(PunchProfile(face.radius), load, times, creep.compliance, finer=finer)
    except ValueError as error:
        raise NotDrawnError(str(error)) from error


def _scalars(face: Face, found: RodSolution) -> dict[str, Array]:
    force = found.of("force")
    inside = force > 1e-9 * force.max(initial=0.0)  # rounding at the separation does not count
    return {
        "force": force,
        "approach": found.of("approach"),
        "work": found.of("work"),
        "contact_area": np.where(inside, face.area, 0.0),
        "contact_length": np.where(inside, 2 * face.reach[0], 0.0),
        "contact_width": np.where(inside, 2 * face.reach[1], 0.0),
        "mean_pressure": force / face.area,
        "peak_pressure": np.where(inside, np.inf, 0.0),
    }


def _run(
    rng: np.random.Generator, face: Face, creep: Creep, points: object, control: str, name: str
) -> ExactRun:
    end = creep.time * 10 ** rng.uniform(-0.5, 0.9)
    approach = face.radius * 10 ** rng.uniform(-4, -2)
    compliance = float(creep.compliance(np.array([end / 2]))[0])
    largest = approach if control == "approach" else 2 * face.radius * approach / compliance
    load = history_of_points(points, control, largest, end)
    grid = grid_around(rng, face.reach, cells_across(rng))
    times = random_times(rng, end)

    def exact(t: Array) -> dict[str, Array]:
        values = _scalars(face, _solved(face, creep, load, t))
        del values[load.control]
        return values

    exact(np.array([0.0, end]))
    return ExactRun(name, face.indenter, creep.material, load, grid, times, exact, dict(creep.more))


def punch(rng: np.random.Generator) -> ExactRun:
    """A face of any outline, any law, any history of force or approach."""
    creep = _creep(rng)
    face = (_round_face, _elliptic_face, _rectangular_face)[rng.integers(3)](rng)
    control = "force" if rng.random() < 0.6 else "approach"
    kind, points = random_points(rng, jumps=True)
    name = f"{face.name} face, {kind} of {control}, {creep.name}"
    return _run(rng, face, creep, points, control, name)


def dent(rng: np.random.Generator) -> ExactRun:
    """A round or elliptic face under a force that is taken away; the dent recovers."""
    creep = _creep(rng, creeping=True)
    face = (_round_face, _elliptic_face)[int(rng.random() < 0.3)](rng)
    kind = (in_and_recover, two_cycles)[int(rng.random() < 0.4)]
    times, levels = kind(rng)
    if kind is in_and_recover:  # away early, so that recovery takes most of the run
        times = times * rng.uniform(0.3, 1.0) / times[-1]
    points = times, levels
    name = f"{face.name} face, dent, {creep.name}"
    return _run(rng, face, creep, points, "force", name)


def eccentric_punch(rng: np.random.Generator) -> ExactRun:
    """A round face under a force beside its axis, or clamped at a tilt that grows with approach.

    Its tilt is 3 e/(2 a²) times its approach (see `reference.flat_punch`) whatever the law, as both
    are the same Boltzmann integral; a tilt θ puts the force at e = 2 a² θ/(3 approach).
    """
    creep = _creep(rng)
    face = _round_face(rng)
    a = face.radius
    kinds = (ramp_and_hold, step_and_hold, jump_and_ramp, staircase)
    kind = kinds[rng.integers(len(kinds))]
    turn, aside = rng.uniform(0, 2 * math.pi), rng.uniform(0.05, 0.3) * a
    place = {"eccentricity_x": aside * math.cos(turn), "eccentricity_y": aside * math.sin(turn)}
    given = kind(rng)
    free = rng.random() < 0.7
    name = f"eccentric face, {kind.__name__.replace('_', ' ')}, {creep.name}"
    run = _run(rng, face, creep, given, "force" if free else "approach", name)
    load = run.load
    tilts = {f"tilt_{axis}": 1.5 * place[f"eccentricity_{axis}"] / a**2 for axis in "xy"}
    if free:
        load = vc.ForceHistory(load.times, load.force, **place)
    else:
        along = {axis: tilt * load.approach for axis, tilt in tilts.items()}
        load = vc.ApproachHistory(load.times, load.approach, **along)
    centric = run.exact

    def exact(t: Array) -> dict[str, Array]:
        values = centric(t)
        values["work"] = values["work"] * (1 + 1.5 * (aside / a) ** 2)
        touching = values["contact_area"] > 0
        more = {each: tilt * values["approach"] for each, tilt in tilts.items()} if free else place
        return values | {each: np.where(touching, value, np.nan) for each, value in more.items()}

    return ExactRun(
        name, run.indenter, run.material, load, run.grid, run.times, exact, dict(creep.more)
    )
