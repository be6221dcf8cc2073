"""Contact problems that are hard on a solver: every law, body, load and unit, and cells 30 to 1.

What is drawn: lengths from nanometres to kilometres, moduli from 1 Pa to 1 TPa, times from
nanoseconds to decades, cells from 1:30 to 30:1, forces as near to the hull's edge as 1 %, bodies
that creep on a body that creeps, loads that fall to zero and come back on what is left of their
dent.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

import viscontact as vc
from verification.hard_bodies import hard_body
from viscontact.laws import SeriesLaw
from viscontact.loads import LoadPoint
from viscontact.simulation.meshing.elastic_estimate import estimate_contact

#: Cells of a grid, about; and least and most of them along a side.
CELLS, FEWEST, MOST = 1600, 12, 400

#: Grids are this many times as wide as the contact reaches from the origin.
ROOM = 2.8


@dataclass(frozen=True)
class HardProblem:
    """Arguments of `march`, and what was drawn, in words."""

    indenter: vc.Indenter
    material: vc.Material
    load: vc.LoadHistory
    grid: vc.Grid
    times: np.ndarray
    indenter_material: vc.Material | None = None
    kinds: tuple[str, ...] = ()

    def march(self, **options):
        arguments = (self.indenter, self.material, self.load, self.grid, self.times)
        return vc.march(*arguments, indenter_material=self.indenter_material, **options)


def law_of(seed):
    """The kind of law that a problem has, without the problem."""
    return _begun(np.random.default_rng([seed, 6]))[-2]


def hard_problem(seed):
    """A problem; the seed says which."""
    rng = np.random.default_rng([seed, 6])
    length, modulus, duration, law_kind, law = _begun(rng)
    material = _material(rng, law)
    other = _other_body(rng, modulus, duration)
    body = hard_body(rng, length)
    compliance = material.contact_compliance()
    if other is not None:
        compliance = compliance + other.contact_compliance()
    force, staged = body.press / float(compliance(duration)), bool(rng.random() < 0.3)
    if body.outline is not None:
        grid = _grid(rng, body.outline)
        aside, tail = _where(rng, _outermost(body, grid))
        deepest = body.deepest
    else:
        aside, tail = _where(rng, body.reach if not staged else (0.0, 0.0))
        point = replace(aside, force=force)
        found = estimate_contact(body.indenter, float(compliance(duration)), point)
        grid, deepest = _grid(rng, [ROOM * reach for reach in found.reach]), found.approach
    level = deepest * float(rng.uniform(0.3, 0.9)) if staged else force
    tail = _tilted(rng, tail, staged, deepest, grid.size)
    load_kind, load = _load(rng, staged, level, duration, tail, gentle=compliance.instant == 0)
    times = np.unique(np.concatenate([[0.0], duration * rng.uniform(3e-3, 1, 6) ** 3]))
    if load_kind == "swing":
        times = np.linspace(0.0, load.period, 129)
    kinds = (body.kind, law_kind, "creeping indenter" if other else "rigid indenter")
    kinds += (("stage: " if staged else "force: ") + load_kind,)
    return HardProblem(body.indenter, material, load, grid, times, other, kinds)


def _begun(rng):
    length, modulus = 10.0 ** rng.uniform(-9, 3), 10.0 ** rng.uniform(0, 12)
    duration = 10.0 ** rng.uniform(-9, 9)
    return length, modulus, duration, *_law(rng, modulus, duration)


def _law(rng, modulus, duration):
    other, time = modulus * 10.0 ** rng.uniform(-2, 2), duration * 10.0 ** rng.uniform(-4, 4)
    exponent = float(rng.uniform(0.1, 0.9))
    rows = np.cumsum(rng.uniform(0.1, 1.0, 8)) / 5
    table = duration * np.geomspace(1e-4, rng.uniform(0.5, 2), 8)
    series = time * 10.0 ** np.arange(-2.0, 2.0)
    parts = 10.0 ** rng.uniform(-2, 0, 4)
    laws = {
        "elastic": lambda: vc.Elastic(modulus),
        "Maxwell": lambda: vc.Maxwell(modulus, modulus * time),
        "Zener": lambda: vc.Zener(modulus, other, other * time),
        "Burgers": lambda: vc.Burgers(modulus, modulus * time * 10, other, other * time),
        "creep series": lambda: vc.CreepSeries(1 / modulus, parts / modulus, series),
        "relaxation series": lambda: vc.RelaxationSeries(modulus / 10, modulus * parts, series),
        "power": lambda: vc.PowerLaw(1 / modulus, exponent, time, instant=0.1 / modulus),
        "soft start": lambda: vc.PowerLaw(1 / modulus, exponent, time),
        "fractional Maxwell": lambda: vc.FractionalMaxwell(modulus, time, exponent),
        "fractional Zener": lambda: vc.FractionalZener(modulus, modulus / 20, time, exponent),
        "creep table": lambda: vc.TabulatedCreep(table, (0.2 + rows) / modulus),
        "relaxation table": lambda: vc.TabulatedRelaxation(table, modulus / (0.2 + rows)),
    }
    kind = str(rng.choice(list(laws)))
    return kind, laws[kind]()


def _material(rng, law):
    ratio = float(rng.uniform(0, 0.5))
    # With other laws its creep is inverted by numbers, at every one of the audit's many instants.
    if rng.random() < 0.25 and isinstance(law, SeriesLaw):
        return vc.Material(law, bulk_modulus=3 / float(law(0.0)))
    return vc.Material(law, ratio)


def _other_body(rng, modulus, duration):
    """A creeping or elastic indenter's material; None for a rigid one."""
    if rng.random() < 0.7:
        return None
    stiff = modulus * 10.0 ** rng.uniform(-1, 1)
    law = vc.Elastic(stiff) if rng.random() < 0.3 else vc.Zener(stiff, stiff, stiff * duration / 5)
    return vc.Material(law, 0.3)


def _where(rng, reach):
    """Where the force acts at the most, and the tail of a history that says so."""
    x, y = (float(r * (rng.random() < 0.6) * _edgewise(rng)) for r in reach)
    draw = rng.random()
    if draw < 0.12:
        x, tail = 0.0, {"tilt_x": 0.0, "eccentricity_y": y}
    elif draw < 0.24:
        y, tail = 0.0, {"eccentricity_x": x, "tilt_y": 0.0}
    elif draw < 0.32:
        x, y, tail = 0.0, 0.0, {"tilt_x": 0.0, "tilt_y": 0.0}
    else:
        tail = {"eccentricity_x": x, "eccentricity_y": y}
    free = (tail.get("tilt_x"), tail.get("tilt_y"))
    return LoadPoint(1.0, x, y, *free), tail


def _edgewise(rng):
    """A part from -1 to 1, often near the ends."""
    return rng.choice([-1, 1]) * (
        1 - 10.0 ** rng.uniform(-2, 0) if rng.random() < 0.5 else rng.random()
    )


def _outermost(body, grid):
    """Farthest eccentricities that cells under a body can balance."""
    solid = np.isfinite(body.indenter.gap(grid.x[:, None], grid.y[None, :]))
    ends = grid.x[solid.any(axis=1)][-1], grid.y[solid.any(axis=0)][-1]
    return [part * end for part, end in zip(body.reach, ends, strict=True)]


def _grid(rng, size):
    """Cells of an aspect between 1:30 and 30:1, about as many on every grid."""
    aspect = 30.0 ** rng.uniform(-1, 1)
    nx = math.sqrt(CELLS * size[0] / (size[1] * aspect))
    ny = nx * aspect * size[1] / size[0]
    shape = [int(np.clip(round(n), FEWEST, MOST)) for n in (nx, ny)]
    for thin, other in ((0, 1), (1, 0)):
        if shape[thin] == FEWEST:
            # The aspect is kept by more cells the other way.
            scale = aspect if thin == 0 else 1 / aspect
            shape[other] = int(
                np.clip(round(FEWEST * scale * size[other] / size[thin]), FEWEST, MOST)
            )
    return vc.Grid((shape[0], shape[1]), (float(size[0]), float(size[1])))


def _load(rng, staged, level, duration, tail, *, gentle):
    """A load of a kind, up to a level; gentle where the law cannot follow a jump."""
    kinds = _GENTLE if gentle else (*_GENTLE, *_SUDDEN)
    weights = np.array([_WEIGHTS.get(kind, 1.0) for kind in kinds])
    kind = str(rng.choice(list(kinds), p=weights / weights.sum()))
    if kind == "step":
        return kind, vc.step(**{_name(staged): level}, **tail)
    if kind == "ramp":
        rise = duration * float(rng.uniform(0.01, 1))
        return kind, vc.ramp(**{_name(staged): level}, duration=rise, **tail)
    if kind == "triangle":
        rise = duration * float(rng.uniform(0.1, 0.4))
        return kind, vc.triangle(**{_name(staged): level}, rise=rise, **tail)
    if kind == "swing":
        middle = {"approach" if staged else "mean": level / 2}
        return kind, vc.harmonic(
            **middle, amplitude=level / 2, period=duration, cycles=1, phase=-math.pi / 2, **tail
        )
    parts, levels = np.array(_HISTORIES[kind], dtype=float).T
    levels = np.where(levels < 0, levels if staged else 0.0, levels) * level
    if kind == "walk" and not staged:
        for name in ("eccentricity_x", "eccentricity_y"):
            if tail.get(name):
                tail = {**tail, name: tail[name] * np.linspace(-1, 1, len(parts))}
    history = vc.ApproachHistory if staged else vc.ForceHistory
    return kind, history(duration * parts, levels, **tail)


def _name(staged):
    return "approach" if staged else "force"


def _tilted(rng, tail, staged, deepest, size):
    """The tail with its tilts given, free or level or as steep as the body sinks."""
    tail = {f"tilt_{axis}": rng.choice([None, 0.0]) for axis in "xy"} if staged else dict(tail)
    for axis, extent in zip("xy", size, strict=True):
        if tail.get(f"tilt_{axis}") is not None and rng.random() < 0.6:
            tail[f"tilt_{axis}"] = float(rng.uniform(-0.3, 0.3) * deepest / extent)
    return tail


_GENTLE = ("ramp", "triangle", "reload", "late", "three times", "swing")
_SUDDEN = ("step", "drop", "jump to zero and back", "nearly nothing", "walk")
_WEIGHTS = {"swing": 0.1}

#: Parts of the duration, and of the largest level; below zero a stage is lifted, a force is none.
_HISTORIES = {
    "reload": [(0, 0), (0.1, 1), (0.2, 1), (0.3, -0.2), (0.5, -0.2), (0.9, 0.8)],
    "late": [(0, 0), (0.3, 0), (0.4, 1), (0.7, 0.02), (0.9, 0.6)],
    "three times": [(0, 0), (0.1, 1), (0.2, 0), (0.3, 0.5), (0.4, 0), (0.6, 0.9), (0.8, 0)],
    "drop": [(0, 0.7), (0.1, 1), (0.2, 1), (0.2, 0.1), (0.3, 0), (0.5, 0), (0.9, 0.8)],
    "jump to zero and back": [(0, 1), (0.2, 1), (0.2, -0.5), (0.6, -0.5), (0.6, 0.9)],
    "nearly nothing": [(0, 1), (0.3, 1), (0.3, 1e-9), (0.6, 1e-9), (0.8, 1)],
    "walk": [(0, 1), (0.4, 0.5), (1, 0.9)],
}
