"""Verification cases of shrinking contacts, loss of contact and renewed contact."""

from __future__ import annotations

import math

import numpy as np

from viscontact import reference
from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import ApproachHistory, ForceHistory, harmonic, triangle
from viscontact.mechanics.time_integration.requested_times import uniform_times
from viscontact.verify.case import Case, Comparison, Quantity, history, single
from viscontact.verify.creeping import TIME, G, maxwell, zener
from viscontact.verify.indentation import (
    FORCE,
    RADIUS,
    CaseRun,
    instants_of_change,
    press_ball,
)

_PROFILE = reference.SphereProfile(RADIUS)
_PEAK, _RISE = 1e-5, 60.0  # largest approach [m] and its time [s]
_LARGEST = math.sqrt(RADIUS * _PEAK)

#: Loading, withdrawal beyond the surface, rest, and loading again.
_STAGE = ApproachHistory(
    [0, _RISE, 2 * _RISE, 4 * _RISE, 5 * _RISE], _PEAK * np.array([0, 1, -0.2, -0.2, 0.8])
)


def _radius(run: CaseRun, exact: Floats) -> Comparison:
    """Contact radius where it spans six cells or more: a smaller contact has no traceable rim."""
    fine = exact > 6 * run.grid.cell_size[0]
    at = np.flatnonzero(fine)
    return history(exact[at], run.radius[at])


def _stage_triangle(cells: int) -> tuple[Comparison, ...]:
    body, load = zener(), triangle(approach=_PEAK, rise=_RISE)
    exact = reference.ting_triangle(_PROFILE, _PEAK, _RISE, 4 * G, [4 * G], [TIME / 2])
    times = uniform_times(2 * _RISE, 3 * cells)
    run = press_ball(body.material, load, times, _LARGEST, cells)
    (lost,) = instants_of_change(body.material, load, times, _LARGEST, cells / 2)
    return (
        history(exact.force(times), run.over_time("force")),
        _radius(run, np.asarray(exact.contact_radius(times))),
        single(exact.lost, lost),
    )


def _stage_haversine(cells: int) -> tuple[Comparison, ...]:
    body = zener()
    half = _PEAK / 2
    load = harmonic(approach=half, amplitude=-half, period=2 * _RISE, cycles=1, phase=math.pi / 2)
    exact = reference.ting_hump(
        _PROFILE,
        lambda t: _PEAK * np.sin(math.pi * t / (2 * _RISE)) ** 2,
        _RISE,
        2 * _RISE,
        body.relaxation,
    )
    times = uniform_times(2 * _RISE, max(3 * cells, 64))
    run = press_ball(body.material, load, times, _LARGEST, cells)
    return (
        history(exact.force(times), run.over_time("force")),
        _radius(run, np.asarray(exact.contact_radius(times))),
    )


def _stage_cycles(cells: int) -> tuple[Comparison, ...]:
    exact = reference.ting_cycles(_PROFILE, _PEAK, _RISE, 4 * G, TIME)
    load = ApproachHistory(_RISE * np.arange(7), _PEAK * np.array([0, 1, 0, 1, 0, 1, 0]))
    times = uniform_times(6 * _RISE, 6 * cells)
    run = press_ball(maxwell().material, load, times, _LARGEST, cells)
    changes = instants_of_change(maxwell().material, load, times, _LARGEST, cells / 2)
    return (
        history(exact.force(times), run.over_time("force")),
        single(exact.touched(2), changes[3]),
        single(exact.lost(2), changes[4]),
    )


def _force_triangle(cells: int) -> tuple[Comparison, ...]:
    exact = reference.ting_force_triangle(FORCE, _RISE, RADIUS, 4 * G, TIME)
    times = uniform_times(2 * _RISE, 3 * cells)
    largest = float(exact.contact_radius(exact.widest))
    run = press_ball(maxwell().material, triangle(FORCE, _RISE), times, largest, cells)
    return (
        history(exact.approach(times), run.over_time("approach")),
        _radius(run, np.asarray(exact.contact_radius(times))),
    )


def _force_haversines(cells: int) -> tuple[Comparison, ...]:
    body, steps = zener(), 2 * cells
    times = uniform_times(4 * _RISE, 2 * steps)
    force = FORCE * np.sin(math.pi * times / (2 * _RISE)) ** 2
    force[::steps] = 0.0
    exact = reference.press_axisymmetric(
        _PROFILE, times, force=force, creep_compliance=body.creep, elements=120, substeps=2
    )
    load, largest = ForceHistory(times, force), float(exact.contact_radius.max())
    run = press_ball(body.material, load, times, largest, cells)
    return (
        history(exact.approach, run.over_time("approach")),
        _radius(run, exact.contact_radius),
        history(exact.work, run.over_time("work")),
    )


def _renewed_contact(cells: int) -> tuple[Comparison, ...]:
    body, times = zener(), uniform_times(5 * _RISE, 5 * cells)
    exact = reference.press_axisymmetric(
        _PROFILE,
        times,
        approach=_STAGE.level_at(times),
        creep_compliance=body.creep,
        elements=120,
        substeps=2,
    )
    run = press_ball(body.material, _STAGE, times, _LARGEST, cells, margin=1.8)
    changes = instants_of_change(body.material, _STAGE, times, _LARGEST, cells / 2)
    row = run.grid.shape[0] // 2
    k = 3 * cells  # at three times the rise, in the middle of the rest
    surface = exact.displacement(run.grid.x[row:], float(times[k]))
    return (
        history(surface, run.states[k].displacement[row:, row]),
        single(float(exact.lost[0]), changes[0]),
        single(float(exact.touched[1]), changes[1]),
        history(exact.force, run.over_time("force")),
    )


_LEVELS = (12, 24, 48)
_FORCE, _RADIUS = Quantity("force", "N", 1e-3, 3e-4), Quantity("contact radius", "m", 5e-3, 1.5e-3)
_APPROACH = Quantity("approach", "m", 1e-3, 3e-4)

CASES: tuple[Case, ...] = (
    Case(
        "approach triangle, Zener",
        "Ting 1966",
        (_FORCE, _RADIUS, Quantity("contact lost", "s", 1e-3, 5e-4, has_order=False)),
        _LEVELS,
        _stage_triangle,
    ),
    Case(
        "approach haversine, Zener",
        "Ting 1966",
        (_FORCE, _RADIUS),
        _LEVELS,
        _stage_haversine,
    ),
    Case(
        "three approach triangles, Maxwell",
        "Ting 1968",
        (
            Quantity("force", "N", 3e-3, 1e-3),
            Quantity("third touch", "s", 1e-3, 5e-4, has_order=False),
            Quantity("third loss", "s", 1e-3, 5e-4, has_order=False),
        ),
        _LEVELS,
        _stage_cycles,
    ),
    Case("force triangle, Maxwell", "Ting 1966", (_APPROACH, _RADIUS), _LEVELS, _force_triangle),
    Case(
        "two force haversines, Zener",
        "Graham 1965",
        (_APPROACH, _RADIUS, Quantity("work", "J", 3e-3, 1e-3)),
        _LEVELS,
        _force_haversines,
    ),
    Case(
        "contact lost and made again, Zener",
        "Graham 1967, Ting 1968",
        (
            Quantity("residual displacement", "m", 3e-3, 1e-3),
            Quantity("contact lost", "s", 1e-3, 5e-4, has_order=False),
            Quantity("second contact", "s", 1e-3, 5e-4, has_order=False),
            _FORCE,
        ),
        _LEVELS,
        _renewed_contact,
    ),
)
