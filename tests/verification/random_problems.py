"""Small contact problems of every kind, in units from nanometres to kilometres."""

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

import viscontact as vc


@dataclass(frozen=True)
class Problem:
    """Arguments of `march`."""

    indenter: vc.Indenter
    material: vc.Material
    load: vc.ForceHistory
    grid: vc.Grid
    times: np.ndarray


@cache  # half of the time of a problem is that of its grid
def random_problem(seed):
    """A problem with a solution on a grid that holds it; the seed says which."""
    rng = np.random.default_rng(seed)
    length = 10.0 ** rng.uniform(-9, 3)
    modulus = 10.0 ** rng.uniform(3, 12)
    duration = 10.0 ** rng.uniform(-6, 6)
    material = vc.Material(_law(rng, modulus, duration), float(rng.uniform(0, 0.5)))
    times = np.unique(np.concatenate([[0.0], duration * rng.uniform(3e-3, 1, 7) ** 3]))
    depth = 10.0 ** rng.uniform(-4, -1)
    indenter, size, reach = _indenter(rng, length, depth)
    compliance = material.contact_compliance()(float(times[-1]))
    force = depth * length**2 / compliance
    load = _load(rng, force, reach, duration)
    shape = (int(rng.integers(32, 65)), int(rng.integers(32, 65)))
    if size is None:
        # Only its size and place: as coarse as it may be.
        wish = {"tolerance": 0.5, "quantities": ["approach"]}
        chosen = vc.auto_grid(indenter, material, load, end=float(times[-1]), **wish)
        return Problem(indenter, material, load, replace(chosen, shape=shape), times)
    return Problem(indenter, material, load, vc.Grid(shape, size), times)


def _law(rng, modulus, duration):
    other, time = modulus * 10.0 ** rng.uniform(-2, 2), duration * 10.0 ** rng.uniform(-4, 4)
    kind = rng.integers(5)
    if kind == 0:
        return vc.Elastic(modulus)
    if kind == 1:
        return vc.Maxwell(modulus, modulus * time)
    if kind == 2:
        return vc.Zener(modulus, other, other * time)
    if kind == 3:
        return vc.Burgers(modulus, modulus * time * 10, other, other * time)
    moduli = modulus * 10.0 ** rng.uniform(-2, 0, 4)
    return vc.RelaxationSeries(modulus / 10, moduli, time * 10.0 ** np.arange(-2.0, 2.0))


def _indenter(rng, length, depth):
    """An indenter, the grid's size if the outline rules it, and how far off centre it bears."""
    kind = rng.integers(8)
    if kind == 0:
        return vc.Sphere(length), None, (0.05 * length, 0.05 * length)
    if kind == 1:
        ratio = 10.0 ** rng.uniform(-4, 4)
        return vc.Paraboloid(length, ratio * length), None, (0.0, 0.0)
    if kind == 2:
        return vc.Cone(math.radians(rng.uniform(75, 89))), None, (0.0, 0.0)
    if kind == 3:
        return vc.FlatPunch(length), (2.2 * length, 2.2 * length), (0.9 * length, 0.0)
    if kind == 4:
        width = length * 10.0 ** rng.uniform(-1.5, 0)
        size = (2.2 * length, 2.2 * width)
        punch = vc.FlatPunch(half_length=length, half_width=width)
        return punch, size, (0.9 * length, 0.9 * width)
    if kind == 5:
        crowned = vc.Roller(length, 2 * length, length * 10.0 ** rng.uniform(0.5, 3))
        return crowned, None, (2 * length, 0.0)
    if kind == 6:
        # Six times the half width of a line contact, Johnson (1985), eq. 4.43.
        width = 6 * length * math.sqrt(depth / math.pi)
        return vc.Roller(length, 2 * length), (4.4 * length, width), (1.5 * length, 0.0)
    axis = np.linspace(-length, length, 40)
    # Rough, but so that the force presses a few peaks down to their size.
    height = length * math.sqrt(depth) * rng.uniform(0.003, 0.03) * rng.standard_normal((40, 40))
    rough = vc.HeightMap(axis, axis, height)
    if rng.random() < 0.5:
        return rough, (2.4 * length, 2.4 * length), (0.5 * length, 0.5 * length)
    bowl = vc.Paraboloid(20 * length, 20 * length)
    return rough + bowl, (2.4 * length, 2.4 * length), (0.2 * length, 0.1 * length)


def _load(rng, force, reach, duration):
    kind = rng.integers(5)
    aside = [float(r * rng.uniform(-1, 1) * (rng.random() < 0.7)) for r in reach]
    where = {"eccentricity_x": aside[0], "eccentricity_y": aside[1]}
    if rng.random() < 0.15:
        where = {"eccentricity_x": aside[0], "tilt_y": 0.0}
    if kind < 2:
        return vc.step(force, **where)
    if kind == 2:
        return vc.ramp(force, duration * rng.uniform(0.01, 1), **where)
    if kind == 3:
        return vc.triangle(force, duration * rng.uniform(0.1, 0.4), **where)
    # Up, held, down by a jump, to zero, and up again.
    parts = duration * np.array([0.0, 0.1, 0.2, 0.2, 0.3, 0.5, 0.9])
    forces = force * np.array([0.0, 1.0, 1.0, rng.uniform(0.01, 0.5), 0.0, 0.0, 0.8])
    return vc.ForceHistory(parts, forces, **where)
