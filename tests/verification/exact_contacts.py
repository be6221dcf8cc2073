"""Random contacts whose exact solution is known, over random meshes, steps and laws.

Each family draws a run and what theory says of its scalars at every instant. Nothing of the solver
is used for the exact values; `viscontact.reference` shares no numerics with it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import viscontact as vc
from viscontact import reference
from viscontact.verify.creeping import CreepingBody, all_bodies

Array = np.ndarray


@dataclass(frozen=True)
class ExactRun:
    """A run and the exact values of its scalars.

    `exact` gives each scalar at the run's instants; inf where it has no finite value.
    """

    name: str
    indenter: vc.Indenter
    material: vc.Material
    load: vc.LoadHistory
    grid: vc.Grid
    times: Array
    exact: Callable[[Array], dict[str, Array]]
    more: dict[str, Any] = field(default_factory=dict)

    @property
    def arguments(self) -> dict[str, Any]:
        """What `simulate` takes."""
        return {
            "indenter": self.indenter,
            "material": self.material,
            "load": self.load,
            "grid": self.grid,
            "times": self.times,
            **self.more,
        }


def grid_over(
    rng: np.random.Generator, reach: tuple[float, float], cells: tuple[int, int]
) -> vc.Grid:
    """A grid with about so many cells across a contact of a largest half length and half width."""
    shape, size = [], []
    for half, count in zip(reach, cells, strict=True):
        cell = 2 * half / (count + rng.uniform(-0.5, 0.5))
        across = math.ceil(2 * half * rng.uniform(1.15, 1.6) / cell) + 2
        shape.append(across)
        size.append(across * cell)
    return vc.Grid((shape[0], shape[1]), (size[0], size[1]))


def cells(rng: np.random.Generator, most: int) -> int:
    """How many cells lie across a contact, even in the logarithm."""
    return round(math.exp(rng.uniform(math.log(12), math.log(most))))


def instants(rng: np.random.Generator, first: float, end: float, most: int) -> Array:
    """Uniform or logarithmic instants of a number that is even in the logarithm."""
    count = round(math.exp(rng.uniform(math.log(5), math.log(most))))
    if rng.random() < 0.5:
        return vc.uniform_times(end, count)
    return vc.log_times(first, end, count)


def moduli(rng: np.random.Generator) -> tuple[float, float, float]:
    """Shear modulus [Pa], Poisson's ratio, and the contact modulus E* [Pa] that they make."""
    shear, ratio = 10 ** rng.uniform(5, 10), rng.uniform(0.0, 0.5)
    return shear, ratio, 2 * shear / (1 - ratio)


def elastic_ellipse(rng: np.random.Generator, most: int) -> ExactRun:
    """Hertz 1882: an ellipsoid on an elastic body, force or approach as it likes."""
    shear, ratio, modulus = moduli(rng)
    radius_y = 10 ** rng.uniform(-3, -1)
    radius_x = radius_y * math.exp(rng.uniform(0, math.log(8)))
    force = modulus * radius_y**2 * 10 ** rng.uniform(-7, -5)
    largest = reference.hertz_elliptical(force, radius_x, radius_y, modulus)
    axes = (largest.semi_axis_x, largest.semi_axis_y)
    across = cells(rng, most)
    longer = min(round(across * math.exp(rng.uniform(0, math.log(2)))), 2 * most)
    grid = grid_over(rng, axes, (longer, across))
    aside = [rng.uniform(-0.5, 0.5) * cell for cell in grid.cell_size]
    body = vc.Paraboloid(radius_x, radius_y).shifted(*aside)
    levels = np.append(rng.uniform(0.1, 1.0, rng.integers(1, 5)), 1.0)
    rng.shuffle(levels)
    corners = np.arange(len(levels)) * 1.0
    by_force = rng.random() < 0.6
    still = {"eccentricity_x": aside[0], "eccentricity_y": aside[1]}
    load = (
        vc.ForceHistory(corners, force * levels, **still)
        if by_force
        else vc.ApproachHistory(corners, largest.approach * levels)
    )
    times = np.linspace(0.0, corners[-1], 2 * len(corners) - 1)

    def exact(t: Array) -> dict[str, Array]:
        level = np.interp(t, corners, levels)
        forces = force * (level if by_force else level**1.5)
        still = {"tilt_x": np.zeros(len(t)), "eccentricity_x": np.full(len(t), aside[0])}
        return still | _hertzian(largest, force, forces)

    material = vc.Material(vc.Elastic(shear), ratio)
    return ExactRun("elastic ellipse", body, material, load, grid, times, exact)


def _hertzian(largest: Any, force: float, forces: Array) -> dict[str, Array]:
    """What a contact is under other forces than the one that it is known for."""
    part = forces / force
    a, b = (axis * part ** (1 / 3) for axis in (largest.semi_axis_x, largest.semi_axis_y))
    approach = largest.approach * part ** (2 / 3)
    return {
        "force": forces,
        "approach": approach,
        "contact_area": math.pi * a * b,
        "contact_length": 2 * a,
        "contact_width": 2 * b,
        "peak_pressure": largest.peak_pressure * part ** (1 / 3),
        "mean_pressure": forces / (math.pi * a * b),
        "work": 0.4 * forces * approach,
    }


def elastic_cone(rng: np.random.Generator, most: int) -> ExactRun:
    """Love 1939: a cone on an elastic body; the pressure at its tip is infinite."""
    shear, ratio, modulus = moduli(rng)
    angle, force = math.radians(rng.uniform(75, 88)), 10 ** rng.uniform(-2, 3)
    levels = rng.uniform(0.2, 1.0, 3)
    largest = reference.cone(force * levels.max(), angle, modulus).contact_radius
    across = cells(rng, most)
    grid = grid_over(rng, (largest, largest), (across, across))
    times = np.arange(3.0)

    def exact(t: Array) -> dict[str, Array]:
        found = [reference.cone(force * level, angle, modulus) for level in levels]
        radius = np.array([one.contact_radius for one in found])
        approach = np.array([one.approach for one in found])
        return {
            "approach": approach,
            "contact_area": math.pi * radius**2,
            "contact_length": 2 * radius,
            "contact_width": 2 * radius,
            "peak_pressure": np.full(len(t), np.inf),
            "mean_pressure": np.array([one.mean_pressure for one in found]),
            "work": force * levels * approach / 3,
        }

    material = vc.Material(vc.Elastic(shear), ratio)
    load = vc.ForceHistory(times, force * levels)
    return ExactRun("elastic cone", vc.Cone(angle), material, load, grid, times, exact)


def elastic_punch(rng: np.random.Generator, most: int) -> ExactRun:
    """Sneddon 1965: a round flat punch, the force beside its axis; infinite at its edge."""
    shear, ratio, modulus = moduli(rng)
    radius, force = 10 ** rng.uniform(-3, -1), 10 ** rng.uniform(-2, 3)
    aside = rng.uniform(0.0, 0.3) * radius
    across = cells(rng, most)
    grid = grid_over(rng, (radius, radius), (across, across))

    def exact(t: Array) -> dict[str, Array]:
        one = reference.flat_punch(force, radius, modulus, aside)
        values = {
            "approach": one.approach,
            "tilt_x": one.tilt_x,
            "eccentricity_x": aside,
            "contact_area": math.pi * radius**2,
            "contact_length": 2 * radius,
            "contact_width": 2 * radius,
            "peak_pressure": np.inf,
            "mean_pressure": force / (math.pi * radius**2),
            "work": force * (one.approach + aside * one.tilt_x) / 2,
        }
        return {name: np.full(len(t), value) for name, value in values.items()}

    material = vc.Material(vc.Elastic(shear), ratio)
    load, times = vc.step(force, eccentricity_x=aside), np.zeros(1)
    return ExactRun("elastic punch", vc.FlatPunch(radius), material, load, grid, times, exact)


def random_body(rng: np.random.Generator) -> CreepingBody:
    """One of the laws there are closed forms for, some with drawn numbers."""
    if rng.random() < 0.5:
        bodies = all_bodies()
        return bodies[rng.integers(1, len(bodies))]
    shear, time, more = 10 ** rng.uniform(5, 10), 10 ** rng.uniform(-2, 4), rng.uniform(0.2, 8)
    if rng.random() < 0.4:
        return CreepingBody(
            "Maxwell, drawn",
            vc.Material(vc.Maxwell(shear, shear * time), 0.5),
            lambda t: (1 + np.asarray(t) / time) / (4 * shear),
            lambda t: 4 * shear * np.exp(-np.asarray(t) / time),
            time / 50,
            more * time,
        )
    relaxing = time / (1 + more)
    return CreepingBody(
        "Zener, drawn",
        vc.Material(vc.Zener(shear, shear / more, shear / more * time), 0.5),
        lambda t: (1 - more * np.expm1(-np.asarray(t) / time)) / (4 * shear),
        lambda t: 4 * shear * (1 + more * np.exp(-np.asarray(t) / relaxing)) / (1 + more),
        time / 50,
        5 * time,
    )


def growing_ball(rng: np.random.Generator, most: int) -> ExactRun:
    """Lee & Radok 1960: a ball under a sudden or ramped force on a creeping body."""
    body = random_body(rng)
    radius = 10 ** rng.uniform(-3, -1)
    force = radius**2 / float(body.creep(np.array([body.end]))[0]) * 10 ** rng.uniform(-6, -4)
    largest = float(np.cbrt(0.75 * radius * force * body.creep(np.array([body.end]))[0]))
    across = cells(rng, most)
    grid = grid_over(rng, (largest, largest), (across, across))
    # A ball that gives has been added to the body's compliance by hand: only under a step.
    sudden = body.ball is not None or rng.random() < 0.5
    duration = rng.uniform(0.2, 0.8) * body.end
    pair = (body.creep, body.relaxation)
    contact = (
        reference.lee_radok_step(force, radius, *pair)
        if sudden
        else reference.lee_radok_ramp(force, duration, radius, *pair)
    )
    load = vc.step(force) if sudden else vc.ramp(force, duration)
    times = instants(rng, body.first, body.end, 60)

    def exact(t: Array) -> dict[str, Array]:
        a = np.asarray(contact.contact_radius(t))
        places = np.linspace(0.0, 0.97, 30)[:, None] * a
        with np.errstate(divide="ignore", invalid="ignore"):
            return {
                "force": np.asarray(contact.force(t)),
                "approach": np.asarray(contact.approach(t)),
                "contact_area": math.pi * a**2,
                "contact_length": 2 * a,
                "contact_width": 2 * a,
                "peak_pressure": np.asarray(contact.pressure(places, t[None, :])).max(axis=0),
                "mean_pressure": np.nan_to_num(np.asarray(contact.force(t)) / (math.pi * a**2)),
                "work": _work_of_growth(contact, t, duration, sudden=sudden),
            }

    ball = {"indenter_material": body.ball} if body.ball is not None else {}
    shape = vc.Paraboloid(radius, radius)
    name = f"ball, {'step' if sudden else 'ramp'}, {body.name}"
    return ExactRun(name, shape, body.material, load, grid, times, exact, ball)


def _work_of_growth(contact: Any, t: Array, duration: float, *, sudden: bool) -> Array:
    """Force times advance; under a jump the two fifths of Hertz."""
    approach = np.asarray(contact.approach(t))
    if sudden:
        force, first = float(contact.force(0.0)), float(contact.approach(0.0))
        return 0.4 * force * first + force * (approach - first)
    fine = np.unique(np.concatenate([duration * np.linspace(0, 1, 2001) ** 3, t, [duration]]))
    deep, force = np.asarray(contact.approach(fine)), np.asarray(contact.force(fine))
    done = np.cumsum(np.append(0.0, (force[1:] + force[:-1]) / 2 * np.diff(deep)))
    return np.interp(t, fine, done)


def creeping_punch(rng: np.random.Generator, most: int) -> ExactRun:
    """Boltzmann and Sneddon: a round flat punch under a staircase of force."""
    body = random_body(rng)
    radius = 10 ** rng.uniform(-3, -1)
    across = cells(rng, most)
    grid = grid_over(rng, (radius, radius), (across, across))
    jumps = np.append(0.0, np.sort(rng.uniform(0.05, 0.9, 2))) * body.end
    levels = rng.uniform(0.5, 20.0, 3)
    load = vc.ForceHistory(np.repeat(jumps, 2)[1:], np.repeat(levels, 2)[:-1])
    times = instants(rng, body.first, body.end, 40)

    def exact(t: Array) -> dict[str, Array]:
        approach = reference.punch_staircase(t, jumps, levels, radius, body.creep)
        force = levels[np.searchsorted(jumps, t, side="right") - 1]
        return {
            "force": force,
            "approach": np.asarray(approach),
            "contact_area": np.full(len(t), math.pi * radius**2),
            "contact_length": np.full(len(t), 2 * radius),
            "contact_width": np.full(len(t), 2 * radius),
            "peak_pressure": np.full(len(t), np.inf),
            "mean_pressure": force / (math.pi * radius**2),
        }

    ball = {"indenter_material": body.ball} if body.ball is not None else {}
    name, shape = f"punch, stairs, {body.name}", vc.FlatPunch(radius)
    return ExactRun(name, shape, body.material, load, grid, times, exact, ball)


def stage_in_and_out(rng: np.random.Generator, most: int) -> ExactRun:
    """Ting 1966: a stage that goes in and out at one speed, on a solid or a fluid."""
    shear, time = 10 ** rng.uniform(5, 10), 10 ** rng.uniform(-2, 4)
    radius, rise = 10 ** rng.uniform(-3, -1), time * 10 ** rng.uniform(-1, 0.7)
    peak = radius * 10 ** rng.uniform(-5, -3)
    fluid, more = rng.random() < 0.5, rng.uniform(0.3, 5.0)
    if fluid:
        law, equilibrium, terms = vc.Maxwell(shear, shear * time), 0.0, (4 * shear,)
    else:
        law = vc.Zener(shear, shear / more, shear / more * time * (1 + more))
        equilibrium, terms = 4 * shear / (1 + more), (4 * shear * more / (1 + more),)
    profile = reference.SphereProfile(radius)
    contact = reference.ting_triangle(profile, peak, rise, equilibrium, terms, [time])
    largest, across = math.sqrt(radius * peak), cells(rng, most)
    grid = grid_over(rng, (largest, largest), (across, across))
    times = vc.uniform_times(2 * rise, round(math.exp(rng.uniform(math.log(8), math.log(80)))))

    def exact(t: Array) -> dict[str, Array]:
        fine = np.unique(np.append(np.linspace(0, 2 * rise, 601), t))
        force = np.asarray(contact.force(fine))
        speed = peak / rise * np.where(fine[1:] <= rise * (1 + 1e-9), 1.0, -1.0)
        work = np.cumsum(np.append(0.0, (force[1:] + force[:-1]) / 2 * speed * np.diff(fine)))
        a = np.asarray(contact.contact_radius(t))
        forces = np.interp(t, fine, force)
        area = math.pi * a**2
        return {
            "force": forces,
            "contact_area": area,
            "contact_length": 2 * a,
            "contact_width": 2 * a,
            "mean_pressure": np.divide(forces, area, out=np.zeros(len(t)), where=area > 0),
            "work": np.interp(t, fine, work),
        }

    shape = vc.Paraboloid(radius, radius)
    load = vc.triangle(approach=peak, rise=rise)
    name = f"stage in and out, {'fluid' if fluid else 'solid'}"
    return ExactRun(name, shape, vc.Material(law, 0.5), load, grid, times, exact)


def force_up_and_down(rng: np.random.Generator, most: int) -> ExactRun:
    """Ting 1966: a force that rises and falls on a Maxwell body."""
    shear, time = 10 ** rng.uniform(5, 10), 10 ** rng.uniform(-2, 4)
    radius, rise = 10 ** rng.uniform(-3, -1), time * 10 ** rng.uniform(-1, 0.5)
    peak = shear * radius**2 * 10 ** rng.uniform(-6, -4)
    contact = reference.ting_force_triangle(peak, rise, radius, 4 * shear, time)
    largest = float(contact.contact_radius(contact.widest))
    across = cells(rng, most)
    grid = grid_over(rng, (largest, largest), (across, across))
    times = vc.uniform_times(2 * rise, round(math.exp(rng.uniform(math.log(8), math.log(60)))))

    def exact(t: Array) -> dict[str, Array]:
        a, force = np.asarray(contact.contact_radius(t)), np.asarray(contact.force(t))
        area = math.pi * a**2
        return {
            "force": force,
            "approach": np.asarray(contact.approach(t)),
            "contact_area": area,
            "contact_length": 2 * a,
            "contact_width": 2 * a,
            "mean_pressure": np.divide(force, area, out=np.zeros(len(t)), where=area > 0),
        }

    shape = vc.Paraboloid(radius, radius)
    material = vc.Material(vc.Maxwell(shear, shear * time), 0.5)
    load = vc.triangle(peak, rise)
    return ExactRun("force up and down", shape, material, load, grid, times, exact)


FAMILIES = (
    elastic_ellipse,
    elastic_cone,
    elastic_punch,
    growing_ball,
    creeping_punch,
    stage_in_and_out,
    force_up_and_down,
)


def drawn(seed: int, count: int, most: int) -> list[ExactRun]:
    """So many runs, of all families in turn, with up to so many cells across the contact."""
    rng = np.random.default_rng(seed)
    return [FAMILIES[k % len(FAMILIES)](rng, most) for k in range(count)]
