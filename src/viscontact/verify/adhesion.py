"""Verification cases of bodies that adhere: spheres, cylinders, waves, punches, and creep."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import xarray as xr
from scipy.optimize import brentq, minimize_scalar

from viscontact import reference
from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import FlatPunch, Indenter, Paraboloid, Waviness
from viscontact.bodies.laws import Elastic, Zener
from viscontact.bodies.loads import ApproachHistory, ForceHistory, LoadHistory
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import Outcome
from viscontact.runs.single import simulate
from viscontact.verify.case import Case, Comparison, Quantity, history, single

_COMPLIANCE, _WORK, _RADIUS = 1e-6, 0.05, 1e-3  # [1/Pa], [J/m²], [m]
_GEL = Material(Elastic(0.25 / _COMPLIANCE), poisson_ratio=0.5)
_SPHERE = Paraboloid(_RADIUS, _RADIUS)

#: Units of force, radius and approach of a sphere (Maugis 1992).
_FORCE = math.pi * _WORK * _RADIUS
_LENGTH = float(np.cbrt(0.75 * _FORCE * _RADIUS * _COMPLIANCE))
_DEPTH = _LENGTH**2 / _RADIUS

#: Range of a Tabor number of 1, of a sphere and of a cylinder [m].
_UNIT_RANGE = float(np.cbrt(_RADIUS * (_WORK * _COMPLIANCE) ** 2))

#: Tabor numbers of Maugis's spheres, with the side of the grid [unit of radii].
_SPHERES = {0.1: 10.1, 0.2: 7.8, 0.3: 6.7, 0.5: 6.3, 0.7: 6.1, 1.0: 5.9}

#: Stiffness of a stage [unit of force over that of approach].
_SPRING = 1.0

#: Waves: length, amplitude, unit of pressure, work whose tension is a tenth of it or so.
_WAVE, _HEIGHT = 1e-3, 1e-6
_FLAT = math.pi * _HEIGHT / (_COMPLIANCE * _WAVE)
_WAVE_WORK = 0.01 * _FLAT**2 * _WAVE * _COMPLIANCE

#: A body that relaxes to the compliance of the gel from a fifth of it, with a time of 1 s.
_STIFFENING = 5.0
_CREEPING = Material(
    Zener(
        0.25 * _STIFFENING / _COMPLIANCE,
        *(2 * (0.25 / _COMPLIANCE * _STIFFENING / (_STIFFENING - 1),)),
    ),
    poisson_ratio=0.5,
)


def _pulled(
    body: Indenter,
    load: LoadHistory,
    grid: Grid,
    sticks: Adhesion,
    instants: list[float],
    material: Material = _GEL,
) -> xr.Dataset:
    return simulate(
        *(body, material, load, grid, instants), adhesion=sticks, errors=False, fields="none"
    )


def _withdrawn(*levels: float) -> ApproachHistory:
    """Sphere that is withdrawn from an approach to another [units of approach]."""
    return ApproachHistory([0.0, 1.0], np.array(levels) * _DEPTH)


def _square(cells: int, size: float) -> Grid:
    return Grid((cells, cells), (size * _LENGTH, size * _LENGTH))


def _maugis(cells: int, tabor: float) -> tuple[Comparison, ...]:
    """Pull-off force, and force at an approach of 0."""
    sticks = Adhesion(_WORK, range=_UNIT_RANGE / tabor, law="dugdale")
    exact = reference.maugis_dugdale(_RADIUS, _COMPLIANCE, _WORK, _UNIT_RANGE / tabor)
    found = _pulled(
        _SPHERE, _withdrawn(0.0, -1.2), _square(cells, _SPHERES[tabor]), sticks, [0.0, 1.0]
    )
    return (
        single(-exact.pull_off.force, found.attrs["pull_off_force"]),
        single(exact.at_approach(0.0).force, float(found.force[0])),
    )


def _jkr(cells: int) -> tuple[Comparison, ...]:
    """Pull-off force in the shortest range that the cells resolve."""
    exact = reference.jkr_sphere(_RADIUS, _COMPLIANCE, _WORK)
    found = _pulled(
        _SPHERE, _withdrawn(0.0, -1.2), _square(cells, 5.0), Adhesion(_WORK), [0.0, 1.0]
    )
    return (single(-exact.pull_off.force, found.attrs["pull_off_force"]),)


def _dmt(cells: int) -> tuple[Comparison, ...]:
    """Pull-off force 2 π w R of a hard sphere, at a Tabor number of 0.02."""
    sticks = Adhesion(_WORK, range=_UNIT_RANGE / 0.02, law="dugdale")
    load, size = _withdrawn(0.5, -2.0), 17.0
    found = _pulled(_SPHERE, load, _square(cells, size), sticks, [0.0, 1.0])
    return (single(2 * _FORCE, found.attrs["pull_off_force"]),)


def _stage(cells: int) -> tuple[Comparison, ...]:
    """Where a sphere on a spring jumps off: the least position of the stage."""
    tabor, stiffness = 0.5, _SPRING * _FORCE / _DEPTH
    exact = reference.maugis_dugdale(_RADIUS, _COMPLIANCE, _WORK, _UNIT_RANGE / tabor)

    def position(radius: float) -> float:
        state = exact.at_radius(radius)
        return (state.approach + state.force / stiffness) / _DEPTH

    ends = minimize_scalar(
        lambda radius: position(radius * _LENGTH), bounds=(0.05, 2.0), method="bounded"
    )
    last = exact.at_radius(float(ends.x) * _LENGTH)
    load = ApproachHistory(
        [0.0, 1.0], np.array([0.0, -4.0]) * _DEPTH, stage_stiffness=_SPRING * _FORCE / _DEPTH
    )
    sticks = Adhesion(_WORK, range=_UNIT_RANGE / tabor, law="dugdale")
    found = _pulled(_SPHERE, load, _square(cells, _SPHERES[tabor]), sticks, [0.0, 1.0])
    jump = float(load.approach_at(float(found.attrs["event_times"][-1])))
    force = float(found.attrs["event_force"][-2])
    return single(float(ends.fun) * _DEPTH, jump), single(last.force, force)


def _cylinder(cells: int) -> tuple[Comparison, ...]:
    """Pull-off force, and half widths under forces above it."""
    line = reference.adhesive_line(_RADIUS, _COMPLIANCE, _WORK, _UNIT_RANGE)
    scale, length = float(np.cbrt(_RADIUS**2 * _WORK * _COMPLIANCE)), 1e-4
    pull = -line.pull_off.line_load * length
    grid = Grid((1, cells), (length, 9 * scale), periodic=(True, False))
    sticks = Adhesion(_WORK, range=_UNIT_RANGE, law="dugdale")
    load = ForceHistory([0.0, 1.0], [pull, -1.5 * pull])
    times = np.linspace(0.0, 1.0, 9).tolist()
    found = _pulled(Paraboloid(math.inf, _RADIUS), load, grid, sticks, times)
    held = found.outcome.values == Outcome.CONVERGED

    def lacking(half_width: float, force: float) -> float:
        return line.at_half_width(half_width).line_load - force / length

    widths = [
        brentq(lacking, line.pull_off.half_width, 20 * scale, (force,))
        for force in found.force.values[held].tolist()
    ]
    return (
        single(pull, found.attrs["pull_off_force"]),
        history(widths, found.contact_width.values[held] / 2),
    )


def _wave(cells: int) -> tuple[Comparison, ...]:
    """Mean pressure over the half width, in the shortest range that the cells resolve."""
    grid = Grid((cells, 1), (_WAVE, 1e-4), periodic=True)
    load = ApproachHistory([0.0, 1.0], np.array([0.6, 0.0]) * _HEIGHT)
    times = np.linspace(0.0, 1.0, 7).tolist()
    found = _pulled(Waviness(_HEIGHT, wavelength_x=_WAVE), load, grid, Adhesion(_WAVE_WORK), times)
    exact = [
        reference.adhesive_wave_pressure(length / 2, _HEIGHT, _WAVE, _COMPLIANCE, _WAVE_WORK)
        for length in found.contact_length.values.tolist()
    ]
    return (history(exact, found.force.values / grid.area),)


def _punch(cells: int) -> tuple[Comparison, ...]:
    """Pull-off force of a flat punch whose range is short against its radius."""
    radius = 30 * _LENGTH
    reach = math.sqrt(_WORK * _COMPLIANCE * radius) / 3  # a zone of π/36 of the radius
    grid = Grid((cells, cells), (2.1 * radius, 2.1 * radius))
    depth = 3 * math.sqrt(_WORK * _COMPLIANCE * radius)
    load = ApproachHistory([0.0, 1.0], [0.0, -depth])
    sticks = Adhesion(_WORK, range=reach, law="dugdale")
    found = _pulled(FlatPunch(radius), load, grid, sticks, [0.0, 1.0])
    exact = reference.adhesive_punch(radius, _COMPLIANCE, _WORK, reach)
    return (single(exact, found.attrs["pull_off_force"]),)


def _edge(cells: int) -> tuple[Comparison, ...]:
    """Energy release of a receding edge on a creeping body, of a wave at its mean plane."""
    zone = 8 * _WAVE / 1024  # of the relaxed body
    strength = math.sqrt(math.pi * _WAVE_WORK / (4 * _COMPLIANCE * zone))
    sticks = Adhesion(_WAVE_WORK, strength=strength, law="dugdale")
    end = 50.0 + 0.9 * _WAVE / zone * 0.3  # the edge passes a zone in about 3 retardation times
    load = ApproachHistory([0.0, 50.0, end], np.array([0.55, 0.55, 0.1]) * _HEIGHT)
    times = np.append(0.0, np.linspace(50.0, end, 31))
    body = Waviness(_HEIGHT, wavelength_x=_WAVE)
    grid = Grid((cells, 1), (_WAVE, 1e-4), periodic=True)
    found = _pulled(body, load, grid, sticks, times.tolist(), _CREEPING)
    inside = slice(6, -3)
    half = found.contact_length.values / 2
    speed = -np.gradient(half, times)[inside]
    angle = math.pi * (half[inside] + zone / 3) / _WAVE
    lacking = _FLAT * np.sin(angle) ** 2 - found.force.values[inside] / grid.area
    energy = lacking**2 * _WAVE * _COMPLIANCE / (2 * np.tan(angle) * _WAVE_WORK)
    compliance = _CREEPING.contact_compliance()
    exact = [
        reference.edge_energy(zone / each, lambda time: compliance(time) / _COMPLIANCE)
        for each in speed.tolist()
    ]
    return (single(float(np.mean(exact)), float(np.mean(energy))),)


CASES: tuple[Case, ...] = (
    *(
        Case(
            f"sphere that adheres, Dugdale, Tabor number {tabor:g}",
            "Maugis 1992",
            (
                Quantity("pull-off force", "N", 5e-2, 4e-3),
                Quantity("force at no approach", "N", 5e-2, 6e-3),
            ),
            (32, 64, 128),
            partial(_maugis, tabor=tabor),
        )
        for tabor in _SPHERES
    ),
    Case(
        "sphere that adheres, shortest range of the cells",
        "Johnson, Kendall & Roberts 1971",
        (Quantity("pull-off force", "N", 0.15, 5e-2),),
        (48, 96, 192),
        _jkr,
    ),
    Case(
        "sphere that adheres, long range",
        "Derjaguin, Muller & Toporov 1975",
        (Quantity("pull-off force", "N", 3e-2, 1e-2),),
        (48, 96, 192),
        _dmt,
    ),
    Case(
        "sphere that adheres, on a stage with a spring",
        "Maugis 1992",
        (
            Quantity("stage at jump-off", "m", 3e-2, 1e-2),
            Quantity("force at jump-off", "N", 3e-2, 1e-2),
        ),
        (32, 64, 128),
        _stage,
    ),
    Case(
        "cylinder that adheres, Dugdale, periodic along it",
        "Baney & Hui 1997",
        (
            Quantity("pull-off force", "N", 3e-2, 1e-2),
            Quantity("half width", "m", 2e-2, 1e-2),
        ),
        (48, 96, 192),
        _cylinder,
    ),
    Case(
        "waves that adhere, shortest range of the cells",
        "Johnson 1995",
        (Quantity("mean pressure", "Pa", 6e-2, 4e-2),),
        (256, 512, 1024),
        _wave,
    ),
    Case(
        "flat punch that adheres, Dugdale",
        "Kendall 1971, Maugis 1992",
        (Quantity("pull-off force", "N", 0.1, 3e-2),),
        (64, 128, 256),
        _punch,
    ),
    Case(
        "receding edge of a creeping body",
        "Schapery 1975, Greenwood 2004",
        (Quantity("energy release over work", "1", 0.1, 0.1),),
        (512, 1024, 2048),
        _edge,
    ),
)
