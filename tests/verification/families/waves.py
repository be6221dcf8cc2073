"""Periodic contacts: straight waves, and full contact of straight and crossed waves.

Truth: Westergaard 1939 for straight waves; Johnson, Greenwood & Higginson 1985, Int. J. Mech. Sci.
27, 383, for full contact; Lee & Radok 1960 for contacts that grow on a creeping body.
"""

import math

import numpy as np

import viscontact as vc
from verification.families.creep_curves import Creep, mean_compliance, random_creep
from verification.families.exact_run import ExactRun
from verification.families.random_loads import (
    history_of_points,
    ramp_and_hold,
    random_times,
    step_and_hold,
)
from verification.families.rod_solution import solve_by_rods
from viscontact.reference import PunchProfile

Array = np.ndarray


def relaxed(creep: Creep, times: Array, path: Array) -> Array:
    """Integral of M(t - t') d path(t') at the times, from a path that starts with a jump.

    One rod of a flat punch of unit radius under the path as its approach, by its force 2 χ.
    """
    load = vc.ApproachHistory(np.append(0.0, times[1:]), path)
    # One step from row to row: the rows are close already.
    found = solve_by_rods(PunchProfile(1.0), load, times, creep.compliance, finer=0.2)
    return np.asarray(found.of("force")) / 2


def line_waves(rng: np.random.Generator) -> ExactRun:
    """Straight waves along x or y in partial contact, under a force that is held or grows."""
    creep = random_creep(rng)
    wavelength = 10 ** rng.uniform(-5, -2)
    amplitude = wavelength * 10 ** rng.uniform(-4, -2)
    along = "xy"[rng.integers(2)]
    waves = int(rng.integers(1, 3))
    end = creep.time * 10 ** rng.uniform(-0.5, 0.8)
    sudden = creep.jumps and rng.random() < 0.6
    points = step_and_hold(rng) if sudden else ramp_and_hold(rng)
    grid = _strip(rng, waves, wavelength, along)
    settled = float(creep.compliance(np.array([end]))[0])
    full = math.pi * amplitude / wavelength  # over J: the pressure of full contact
    force = rng.uniform(0.1, 0.7) * full / settled * grid.area
    load = history_of_points(points, "force", force, end)
    phase = rng.uniform(0, 2 * math.pi)
    body = vc.Waviness(amplitude, **{f"wavelength_{along}": wavelength, f"phase_{along}": phase})
    times = random_times(rng, end, most=25)
    mean = creep_of_force(creep, load)

    def exact(t: Array) -> dict[str, Array]:
        ratio = mean(t) / grid.area / full
        width = 2 * wavelength / math.pi * np.arcsin(np.sqrt(ratio))
        area = waves * width * grid.size["yx".index(along)]
        with np.errstate(divide="ignore", invalid="ignore"):
            approach = np.where(ratio > 0, amplitude * ratio * (1 - np.log(ratio)), 0.0)
            pressure = np.where(area > 0, load.level_at(t) / area, 0.0)
        values = {"approach": approach, "contact_area": area, "mean_pressure": pressure}
        if sudden:
            values["peak_pressure"] = _peak(creep, t, full, lambda t: mean(t) / grid.area / full)
            values["work"] = _work_of_waves(amplitude, full, force, mean, t, grid.area)
        return values

    name = f"waves along {along}, {'step' if sudden else 'ramp'}, {creep.name}"
    return ExactRun(name, body, creep.material, load, grid, times, exact, dict(creep.more))


def _strip(rng: np.random.Generator, waves: int, wavelength: float, along: str) -> vc.Grid:
    """A period of some waves: 24 to 80 cells a wave, and eight across."""
    count, thin = round(waves * math.exp(rng.uniform(math.log(24), math.log(80)))), 8
    size = (waves * wavelength, waves * wavelength * thin / count * rng.uniform(0.7, 1.4))
    shape = (count, thin)
    if along == "y":
        size, shape = size[::-1], shape[::-1]
    return vc.Grid(shape, size, periodic=True)


def _peak(creep: Creep, t: Array, full: float, ratio_at: object) -> Array:
    """Largest pressure over the contact, at some distances from the crest [Pa]."""
    end = max(float(t[-1]), 1e-9 * creep.time)
    fine = np.unique(np.concatenate([[0.0], t, np.geomspace(1e-4 * end, end, 200)]))
    ratio = ratio_at(fine)
    found = np.zeros(len(t))
    for sine in math.sqrt(float(ratio[-1])) * np.linspace(0.0, 0.98, 15):
        root = np.sqrt(np.maximum(ratio - sine**2, 0.0))
        path = 2 * full * math.sqrt(1 - sine**2) * root
        found = np.maximum(found, np.interp(t, fine, relaxed(creep, fine, path)))
    return found


def creep_of_force(creep: Creep, load: vc.ForceHistory) -> object:
    """Integral of J(t - t') dF(t') [N/Pa], exactly for a load of ramps and a first jump."""
    rows, levels = load.times, load.force

    def crept(t: Array) -> Array:
        t = np.asarray(t, dtype=float)
        total = levels[0] * creep.compliance(np.maximum(t - rows[0], 0.0))
        for k in range(len(rows) - 1):
            end = np.minimum(t, rows[k + 1])
            rate = (levels[k + 1] - levels[k]) / (rows[k + 1] - rows[k])
            means = mean_compliance(creep, np.maximum(t - end, 0.0), t - rows[k])
            total = total + rate * (end - rows[k]) * means
        return total

    return crept


def _work_of_waves(
    amplitude: float, full: float, force: float, mean: object, t: Array, area: float
) -> Array:
    """Work of a sudden force: elastic at first, then force times advance."""
    ratio = mean(t) / area / full
    first = float(mean(np.zeros(1))[0]) / area / full
    approach = amplitude * ratio * (1 - np.log(ratio))
    begin = amplitude * first * (1 - math.log(first))
    # Integral of F dδ with δ' = -Δ ln r, F proportional to r on an elastic body.
    elastic = force / first * amplitude * (first**2 / 4 - first**2 / 2 * math.log(first))
    return elastic + force * (approach - begin)


def full_contact(rng: np.random.Generator) -> ExactRun:
    """Waves pressed flat at once by a force that is held: peak pressure and work."""
    creep = random_creep(rng)
    while not creep.jumps:
        creep = random_creep(rng)
    lengths = 10 ** rng.uniform(-5, -2) * np.array([1.0, rng.uniform(0.5, 2.0)])
    amplitude = lengths[0] * 10 ** rng.uniform(-4, -2)
    crossed = rng.random() < 0.7
    waves = 2 * math.pi * math.hypot(1 / lengths[0], 1 / lengths[1] if crossed else 0.0)
    shape = rng.integers(16, 49, 2)
    grid = vc.Grid((int(shape[0]), int(shape[1])), (lengths[0], lengths[1]), periodic=True)
    lengths_of = {"wavelength_x": lengths[0]} | ({"wavelength_y": lengths[1]} if crossed else {})
    body = vc.Waviness(amplitude, **lengths_of, phase_x=rng.uniform(0, 2 * math.pi))
    end = creep.time * 10 ** rng.uniform(-0.5, 0.8)
    stiffness = amplitude * waves / 2  # amplitude of pressure over M
    first = stiffness / float(creep.compliance(np.zeros(1))[0])
    force = first * grid.area * rng.uniform(1.05, 2.0)
    load = vc.step(force)
    times = random_times(rng, end, most=20)

    def exact(t: Array) -> dict[str, Array]:
        fine = np.unique(np.concatenate([[0.0], t, np.geomspace(1e-4 * end, end, 300)]))
        amplitudes = relaxed(creep, fine, np.full(len(fine), stiffness))
        work = first * amplitude * grid.area / (8 if crossed else 4)
        return {
            "peak_pressure": force / grid.area + np.interp(t, fine, amplitudes),
            "work": np.full(len(t), work),
            "approach": np.full(len(t), amplitude),
        }

    name = f"full contact of {'crossed' if crossed else 'straight'} waves, {creep.name}"
    return ExactRun(name, body, creep.material, load, grid, times, exact, dict(creep.more))
