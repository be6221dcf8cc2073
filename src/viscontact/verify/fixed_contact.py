"""Verification cases of constant or known contact areas: the error in time alone.

The error of the mesh is removed by one elastic contact on the same mesh.

"""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from viscontact import reference
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import FlatPunch, Roller
from viscontact.bodies.laws import CreepSeries, Elastic
from viscontact.bodies.loads import ForceHistory, harmonic, step
from viscontact.bodies.loads.history import Control
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.time_integration.requested_times import log_times
from viscontact.verify.case import Case, Comparison, Quantity, history, single
from viscontact.verify.creeping import TIME, G, fractional_zener, tabulated_creep, zener
from viscontact.verify.indentation import FORCE, RADIUS, CaseRun, press, press_ball

PUNCH = FlatPunch(5e-3)
GRID = Grid((18, 18), (11e-3, 11e-3))
_PERIOD, _AMPLITUDE, _MEAN = 2 * TIME, 4.0, 10.0  # s, N, N


def softness_of_punch() -> float:
    """Approach over force and compliance on this mesh; 1/(2 a) for fine meshes [1/m]."""
    body = Material(Elastic(2.5e8), 0.5)  # J = 1e-9/Pa
    run = press(body, step(1.0), [0.0], GRID, indenter=PUNCH, tolerance=1e-10)
    return run.states[0].approach * 1e9


def _oscillation(control: Control, compliance: complex, softness: float, steps: int) -> CaseRun:
    cycles = 8  # the transient has decayed to exp(-14)
    amplitude = _AMPLITUDE if control == "force" else _AMPLITUDE * abs(compliance) * softness
    load = (
        harmonic(_MEAN, amplitude, _PERIOD, cycles)
        if control == "force"
        else harmonic(approach=20 * amplitude, amplitude=amplitude, period=_PERIOD, cycles=cycles)
    )
    times = _PERIOD * np.arange(cycles * steps + 1) / steps
    return press(zener().material, load, times, GRID, indenter=PUNCH, tolerance=1e-8)


def _amplitude(run: CaseRun, name: str, steps: int) -> complex:
    """Complex amplitude over the last cycle."""
    values = run.over_time(name)[-steps - 1 :]
    turns = np.exp(-2j * math.pi * np.arange(steps + 1) / steps)
    return complex(2 * np.trapezoid(values * turns) / steps)


def _harmonic(control: Control, steps: int) -> tuple[Comparison, ...]:
    frequency, softness = 2 * math.pi / _PERIOD, softness_of_punch()
    compliance = reference.series_complex_compliance(frequency, 1 / (8 * G), [1 / (8 * G)], [TIME])
    run = _oscillation(control, compliance, softness, steps)
    force, approach = (_amplitude(run, name, steps) for name in ("force", "approach"))
    exact = reference.punch_harmonic(1 / (2 * softness), compliance, force_amplitude=abs(force))
    return (
        single(exact.approach_amplitude, abs(approach)),
        single(exact.phase_lag, float(np.angle(force / approach))),
        single(exact.loss_per_cycle, run.states[-1].loss_per_cycle),
    )


def _staircase(steps: int) -> tuple[Comparison, ...]:
    del steps  # none are needed between the jumps
    body, softness = fractional_zener(), softness_of_punch()
    jumps, levels = np.array([0.0, 7.0, 20.0, 80.0]), np.array([10.0, 25.0, 4.0, 12.0])
    load = ForceHistory(np.repeat(jumps, 2)[1:], np.repeat(levels, 2)[:-1])
    times = np.array([3.0, 7.0, 15.0, 20.0, 26.0, 80.0, 300.0])
    run = press(body.material, load, times, GRID, indenter=PUNCH, tolerance=1e-8)
    exact = reference.punch_staircase(times, jumps, levels, 1 / (2 * softness), body.creep)
    return (history(exact, run.over_time("approach")),)


def _table(cells: int) -> tuple[Comparison, ...]:
    """Contact at the table's own times, at which a table is exact."""
    table = tabulated_creep()
    times = np.append(0.0, np.geomspace(TIME / 1e4, 10 * TIME, 61))[:-4:3]
    radius = float(np.cbrt(0.75 * RADIUS * FORCE * table.creep(times[-1:])[0]))
    ours, series = (
        press_ball(body.material, step(FORCE), times, radius, cells) for body in (table, zener())
    )
    return (
        history(series.over_time("approach"), ours.over_time("approach")),
        history(series.over_time("contact_area"), ours.over_time("contact_area")),
    )


def _roller(cells: int) -> tuple[Comparison, ...]:
    """Approach, tilt and area of a growing contact, which are those of an elastic body of J(t)."""
    law = CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 133.8688])
    roller, load = Roller(5e-3, 9.565e-3, 75e-3), step(1e4, eccentricity_x=5e-3)
    grid = Grid((3 * cells, 3 * cells), (48e-3, 3.2e-3))
    crept = press(Material(law, 0.38), load, log_times(1.0, 1e3, 12), grid, indenter=roller)
    elastic_body = Material(Elastic(1 / (2 * law(1e3))), 0.38)
    (exact,) = press(elastic_body, load, [0.0], grid, indenter=roller).states
    last = crept.states[-1]
    return (
        single(exact.approach, last.approach),
        single(exact.tilt_x, last.tilt_x),
        single(exact.contact_area, last.contact_area),
    )


CASES: tuple[Case, ...] = (
    *(
        Case(
            f"flat punch, harmonic {control}, Zener",
            "Ferry 1980, Sneddon 1965",
            (
                Quantity("approach amplitude", "m", 1e-3, 2e-4),
                Quantity("phase lag", "rad", 1e-3, 4e-4),
                Quantity("loss per cycle", "J", 1e-3, 1e-3),
            ),
            (128, 192, 256),
            partial(_harmonic, control),
        )
        for control in ("force", "approach")
    ),
    Case(
        "flat punch, staircase of force, fractional Zener",
        "Boltzmann 1874, Sneddon 1965",
        (Quantity("approach", "m", 1e-7, 1e-7),),
        (1,),
        _staircase,
    ),
    Case(
        "ball, table of a series at its own times",
        "Lee & Radok 1960",
        (Quantity("approach", "m", 1e-5, 1e-5), Quantity("contact area", "m2", 1e-5, 1e-5)),
        (12,),
        _table,
    ),
    Case(
        "eccentric roller, sudden force, PMMA",
        "Lee & Radok 1960, correspondence",
        (
            Quantity("approach", "m", 1e-6, 1e-6),
            Quantity("tilt", "rad", 1e-6, 1e-6),
            Quantity("contact area", "m2", 1e-6, 1e-6),
        ),
        (16,),
        _roller,
    ),
)
