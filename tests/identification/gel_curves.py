"""Force curves of known gels on a soft cantilever: by the rods of `press_axisymmetric`.

The bodies are indented at given rates; from indentation and force follow position and deflection.
The fit marches the other way round, the tip on its cantilever, after Ting (1966).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

import viscontact as vc
from viscontact import reference

RADIUS, STIFFNESS, NU = 5e-6, 0.03, 0.5  # [m], [N/m], [-]
TIP = vc.Sphere(RADIUS)
SPEED, DEPTH, HOLD = 2e-6, 1e-6, 1.0  # [m/s], [m], [s]

#: Bodies by the names of their laws.
GELS = {
    "elastic": vc.Elastic(500.0),
    "maxwell": vc.Maxwell(500.0, 600.0),
    "zener": vc.Zener(500.0, 333.0, 277.0),
    "burgers": vc.Burgers(500.0, 1500.0, 600.0, 120.0),
    "creep-series": vc.CreepSeries(1e-3, [1e-3], [0.4]),
    "power-law": vc.PowerLaw(1.2e-3, 0.2, 1.0),
    "power-law-with-instant": vc.PowerLaw(1e-3, 0.4, 1.0, 5e-4),
}


@dataclass(frozen=True)
class Course:
    """Times [s], position from contact on [m] and bending [m] of a curve, evenly sampled."""

    times: np.ndarray
    position: np.ndarray
    bending: np.ndarray


@cache
def exact_course(name: str, rows: int = 1500) -> Course:
    """Approach without contact, loading, hold, retraction, and a way without contact."""
    rise = DEPTH / SPEED
    even = np.linspace(0.0, 1.0, 401)
    corners = [0.0, rise, rise + HOLD, 2 * rise + HOLD]
    parts = rise * even**1.5, rise + HOLD * even, rise + HOLD + rise * even
    t = np.unique(np.concatenate(parts))
    depth = np.interp(t, corners, [0.0, DEPTH, DEPTH, 0.0])
    compliance = vc.Material(GELS[name], NU).contact_compliance()
    contact = reference.press_axisymmetric(
        reference.SphereProfile(RADIUS), t, approach=depth, creep_compliance=compliance
    )
    bending = contact.force / STIFFNESS
    lead = np.linspace(-1.5e-6, 0.0, 201)[:-1]
    tail = np.linspace(0.0, -1e-6, 101)[1:]
    position = np.concatenate([lead, depth + bending, tail])
    times = np.concatenate([lead / SPEED, t, t[-1] - tail / SPEED])
    sampled = np.linspace(times[0], times[-1], rows)
    bent = np.concatenate([0 * lead, bending, 0 * tail])
    return Course(*(np.interp(sampled, times, column) for column in (times, position, bent)))


@dataclass(frozen=True)
class Drawn:
    """Curve with noise, and what is hidden in it."""

    curve: vc.ForceCurve
    tilt: float
    drift: float  # [m/s]


def drawn_curve(
    name: str,
    seed: int,
    *,
    noise: float = 3e-10,
    added: Callable[[Course, np.random.Generator], np.ndarray] | None = None,
) -> Drawn:
    """Curve with tilt, drift, offset and noise [m] of a seed, and whatever else is added [m]."""
    course, rng = exact_course(name), np.random.default_rng(seed)
    tilt, drift, offset = rng.uniform(-1, 1, 3) * (0.004, 2e-9, 2e-8)
    deflection = course.bending + offset + tilt * course.position + drift * course.times
    deflection = deflection + noise * rng.standard_normal(course.times.size)
    if added is not None:
        deflection = deflection + added(course, rng)
    curve = vc.ForceCurve(course.times, course.position, deflection, STIFFNESS)
    return Drawn(curve, tilt, drift)


def true_values(name: str, law: vc.laws.Law) -> dict[str, float]:
    """True parameters, those of a power law at the reference time of the fitted one."""
    gel = GELS[name]
    match gel:
        case vc.PowerLaw(compliance, exponent, reference_time, instant):
            grown = compliance * (law.reference_time / reference_time) ** exponent
            return {"compliance": grown, "exponent": exponent, "instant": instant}
        case vc.CreepSeries(instant, amplitudes, times):
            return {"instant": instant, "amplitudes[0]": amplitudes[0], "times[0]": times[0]}
    return dict(vars(gel))


def held(name: str, drawn: Drawn, **options: object) -> dict[str, bool]:
    """Whether each interval of a fit to the curve holds the truth."""
    record = vc.find_contact(drawn.curve, TIP).record()
    fit = vc.fit_indentation(record, name, poisson_ratio=NU, **options)
    truth = true_values(name, fit.law)
    intervals = dict(fit.intervals)
    for key, value in {"contact": 0.0, "slope": drawn.tilt, "drift": drawn.drift}.items():
        truth[key] = value
        found = fit.contact.position_interval if key == "contact" else None
        intervals[key] = found or fit.contact.baseline_intervals.get(key, (-np.inf, np.inf))
    return {key: bool(low <= truth[key] <= high) for key, (low, high) in intervals.items()}
