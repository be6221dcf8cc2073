"""Round bodies under any history of force or approach, on any law.

Truth: the rods of `rod_solution` (Sneddon 1965; Ting 1966, 1968; Graham 1967).
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

import viscontact as vc
from verification.families.creep_curves import Creep, random_creep
from verification.families.exact_run import ExactRun, NotDrawnError
from verification.families.random_loads import (
    history_of_points,
    ramp_and_hold,
    random_points,
    random_times,
    step_and_hold,
    withdrawn,
)
from verification.families.rod_solution import RodSolution, solve_by_rods
from verification.families.round_profiles import (
    RoundBody,
    paraboloid,
    quartic_ball,
    random_body,
    rounded_cone,
    sphere,
)
from viscontact.bodies.loads.harmonic_history import HarmonicHistory

Array = np.ndarray

#: Scalars that are smooth in the steps of the rods.
RICHARDSON = ("force", "approach", "work")

#: Laws whose creep ends, so that a run can choose its own end.
SETTLING = ("elastic", "Zener", "relaxation series", "Zener on Zener")


def contact_size(rng: np.random.Generator) -> float:
    """Radius of a contact [m]."""
    return 10 ** rng.uniform(-5, -2)


def largest_level(body: RoundBody, creep: Creep, control: str, a: float, end: float) -> float:
    """Force [N] or approach [m] under which a contact has about the radius a."""
    g = float(body.profile.depth(np.array(a)))
    if control == "approach":
        return g
    swept = float(body.profile.depth_integral(np.array(a)))
    return 2 * (a * g - swept) / float(creep.compliance(np.array([end / 2]))[0])


def grid_around(
    rng: np.random.Generator, reach: tuple[float, float], across: tuple[float, float]
) -> vc.Grid:
    """A grid with about so many cells across a contact of given half length and half width."""
    shape, size = [], []
    for half, count in zip(reach, across, strict=True):
        cell = 2 * half / (count + rng.uniform(-0.5, 0.5))
        cells = math.ceil(2 * half * rng.uniform(1.15, 1.5) / cell) + 2
        shape.append(cells)
        size.append(cells * cell)
    return vc.Grid((shape[0], shape[1]), (size[0], size[1]))


def cells_across(rng: np.random.Generator, most: int = 36) -> tuple[float, float]:
    """Cells across a contact along x and along y, even in the logarithm."""
    count = math.exp(rng.uniform(math.log(11), math.log(most)))
    other = count * math.exp(rng.uniform(-0.4, 0.4)) if rng.random() < 0.4 else count
    return count, max(other, 9.0)


def round_exact(
    body: RoundBody, creep: Creep, load: vc.LoadHistory, more: dict[str, float] | None = None
) -> Any:
    """Exact scalars of a round body at any instants, without what the load prescribes."""

    def exact(times: Array) -> dict[str, Array]:
        found = solution(body, creep, load, times)
        values = found.scalars(sharp=body.sharp, peak=creep.jumps)
        if isinstance(load, HarmonicHistory):
            rough = solution(body, creep, load, times, finer=0.5).scalars(peak=False)
            # The rods follow chords of the sine; halving them shows the rest (Richardson 1911).
            for name in RICHARDSON:
                values[name] = (4 * values[name] - rough[name]) / 3
        del values[load.control]
        for name, value in (more or {}).items():
            values[name] = np.where(values["contact_area"] > 0, value, np.nan)
        return values

    return exact


def solution(
    body: RoundBody, creep: Creep, load: vc.LoadHistory, times: Array, finer: float = 1.0
) -> RodSolution:
    """Solution by rods; NotDrawnError where the contact becomes a ring.

    Without instant compliance the order in time is lower, which more steps make up for.
    """
    if not creep.jumps:
        finer *= 3
    try:
        found = solve_by_rods(body.profile, load, times, creep.compliance, finer=finer)
    except ValueError as error:
        raise NotDrawnError(str(error)) from error
    if found.contact.places[-1] > 0.95 * body.profile.largest:
        raise NotDrawnError("contact outgrows the profile")
    return found


def run_of(
    rng: np.random.Generator,
    body: RoundBody,
    creep: Creep,
    load: vc.LoadHistory,
    times: Any,
    name: str,
    *,
    most: int = 36,
    shifted: float = 0.4,
) -> ExactRun:
    """A run on a given grid, the body shifted by a part of a cell with some probability."""
    end = float(times[-1])
    coarse = solution(body, creep, load, np.linspace(0, end, 40), finer=0.5)
    reach = float(coarse.contact.contact_radius.max())
    if not reach > 0:
        raise NotDrawnError("no contact")
    grid = grid_around(rng, (reach, reach), cells_across(rng, most))
    indenter, more = body.indenter, {}
    if rng.random() < shifted:
        aside = [rng.uniform(-0.5, 0.5) * cell for cell in grid.cell_size]
        indenter = indenter.shifted(*aside)
        load, more = beside(rng, load, aside)
    options = dict(creep.more)
    if rng.random() < 0.15:
        options["tolerance"] = 10 ** rng.uniform(-7, -4.5)
    exact = round_exact(body, creep, load, more)
    return ExactRun(name, indenter, creep.material, load, grid, times, exact, options)


def beside(
    rng: np.random.Generator, load: vc.LoadHistory, aside: list[float]
) -> tuple[vc.LoadHistory, dict[str, float]]:
    """The load through the shifted body's axis, and what it makes known of the force's place.

    With free tilts the force acts on the axis; a clamped body finds its force there.
    """
    found = {"eccentricity_x": aside[0], "eccentricity_y": aside[1]}
    if isinstance(load, HarmonicHistory):
        return replace(load, tilt_x=0.0, tilt_y=0.0), found
    if load.control == "approach":
        return load, found
    if rng.random() < 0.5:
        return vc.ForceHistory(load.times, load.force, tilt_x=0.0, tilt_y=0.0), found
    return vc.ForceHistory(load.times, load.force, *aside), {}


def round_body(rng: np.random.Generator) -> ExactRun:
    """Any body, law and history."""
    creep = random_creep(rng)
    a = contact_size(rng)
    body = random_body(rng, a)
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    kind, points = random_points(rng, jumps=creep.jumps)
    if control == "approach":
        points = withdrawn(rng, points)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    largest = largest_level(body, creep, control, a, end)
    load = history_of_points(points, control, largest, end)
    times = random_times(rng, end)
    name = f"{body.name}, {kind} of {control}, {creep.name}"
    return run_of(rng, body, creep, load, times, name)


def held_ball(rng: np.random.Generator) -> ExactRun:
    """A ball beside the centres of the cells, held on a body under a sudden or ramped load."""
    creep, a = random_creep(rng), contact_size(rng)
    body = paraboloid(rng, a)
    control = "force" if creep.jumps and rng.random() < 0.7 else "approach"
    kinds = (ramp_and_hold, *((step_and_hold, step_and_hold) if creep.jumps else ()))
    points = kinds[rng.integers(len(kinds))](rng)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    load = history_of_points(points, control, largest_level(body, creep, control, a, end), end)
    times = random_times(rng, end, most=20) if creep.name != "elastic" else np.array([0.0, end])
    name = f"ball held by {control}, {creep.name}"
    return run_of(rng, body, creep, load, times, name, most=64, shifted=1.0)


def harmonic_load(rng: np.random.Generator) -> ExactRun:
    """One to three cycles of a force or of an approach; the work lost in a cycle, too."""
    creep, a = random_creep(rng, creeping=True), contact_size(rng)
    while not creep.jumps:
        creep = random_creep(rng, creeping=True)
    body = random_body(rng, a)
    control = "force" if rng.random() < 0.5 else "approach"
    cycles = int(rng.integers(1, 4))
    period = creep.time * 10 ** rng.uniform(-0.7, 0.9) / cycles
    largest = largest_level(body, creep, control, a, cycles * period)
    part = rng.uniform(0.2, 0.5)  # amplitude over the largest level
    phase = -math.pi / 2 if rng.random() < 0.5 else rng.uniform(0, 2 * math.pi)
    mean = {"mean" if control == "force" else "approach": largest * (1 - part)}
    load = vc.harmonic(**mean, amplitude=largest * part, period=period, cycles=cycles, phase=phase)
    end = cycles * period
    times = np.linspace(0.0, end, cycles * int(rng.integers(4, 13)) + 1)
    name = f"{body.name}, {cycles} cycles of {control}, {creep.name}"
    run = run_of(rng, body, creep, load, times, name, most=20)
    without_loss = run.exact

    def exact(t: Array) -> dict[str, Array]:
        ends = period * np.arange(cycles + 1)
        every = np.unique(np.concatenate([t, ends]))
        values = without_loss(every)
        work = np.interp(ends, every, values["work"])
        done = np.floor(np.asarray(t) / period * (1 + 1e-9)).astype(int)
        lost = np.where(done > 0, work[done] - work[done - 1], np.nan)
        at = np.searchsorted(every, t)
        return {name: found[at] for name, found in values.items()} | {"loss_per_cycle": lost}

    return replace(run, exact=exact)


def automatic(rng: np.random.Generator) -> ExactRun:
    """Grid chosen by the run; in half of the runs its times as well."""
    creep, a = random_creep(rng), contact_size(rng)
    while not creep.jumps:
        creep = random_creep(rng)
    # A flatter body takes a finer grid for its end's sake.
    body = (paraboloid, sphere, rounded_cone, quartic_ball)[rng.integers(4)](rng, a)
    control = "force" if rng.random() < 0.6 else "approach"
    kind, points = random_points(rng, jumps=True)
    end = creep.time * 10 ** rng.uniform(-0.7, 0.9)
    load = history_of_points(points, control, largest_level(body, creep, control, a, end), end)
    times = random_times(rng, end, most=12)
    name = f"{body.name}, {kind} of {control}, {creep.name}, automatic grid"
    run = run_of(rng, body, creep, load, times, name, shifted=0.0)
    choice = rng.random()
    chosen = run.times
    if choice < 0.5 and creep.name in SETTLING:
        chosen, name = None, f"{name} and times"
    elif choice > 0.8:
        chosen, name = vc.adaptive_times(end, 10 ** rng.uniform(-2.5, -1.5)), f"{name} and steps"
    return replace(run, name=name, grid=None, times=chosen)
