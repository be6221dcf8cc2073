"""Computed history of a sphere on a half-space, and the exact one of its recorded case."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact import reference
from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter, Paraboloid, Sphere
from viscontact.bodies.laws import Elastic
from viscontact.bodies.loads import ApproachHistory, ForceHistory
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.drawing.content.along_run import along_run, within_span
from viscontact.drawing.content.panel import FAINT, TEXT, Axis, Curve, Ink, Mark, Panel
from viscontact.results.recorded_case import is_layered, recorded_ends, recorded_grid
from viscontact.results.recorded_objects import recorded_clock, recorded_object
from viscontact.results.run_axis import require_time
from viscontact.units.formatting import ReadableUnit

_NAME = "exact"
# Steps of the reference between corners of the load, and points of its pressure.
_STEPS, _PLACES = 60, 48
#: Computed values beside a curve of theory.
_computed = partial(Curve, has_spaced_markers=True, is_on_top=True)


@dataclass(frozen=True, eq=False)
class ExactHistory:
    """Exact histories at a run's times: lengths [m], force [N], pressure [Pa]."""

    solution: str
    contact_radius: Floats
    approach: Floats
    force: Floats
    peak_pressure: Floats


def exact_panels(results: xr.Dataset, times: ArrayLike | None) -> list[Panel]:
    """Panels of radius, approach or force, and peak pressure, and one of their differences."""
    require_time(results, _NAME)
    theory = exact_history(results, _NAME)
    names = ["force", "approach", "contact_area", "peak_pressure"]
    run = within_span(results, names, times, _NAME, "")
    within = np.isin(results["time"].values, run["time"].values)
    x, label = along_run([run]), exact_label(results, theory.solution)
    instants, panels, differences = run["time"].values, [], []
    compared = _compared_histories(results, run, theory)
    for number, (quantity, si, ours, theirs) in enumerate(compared):
        exact, ink = theirs[within], Ink(place=number)
        curves = (
            Curve(instants, exact, label, FAINT),
            _computed(instants, ours, ink=ink, look="white", symbol=number),
        )
        note = "" if number else "markers: computed"
        panels.append(Panel(x, Axis.of(quantity, si, exact), curves, note=note))
        part = (ours - exact) / (np.abs(exact).max() or 1.0)
        differences.append(
            _computed(instants, part, quantity.lower(), ink, "linked", symbol=number)
        )
    of_largest = Axis("Difference", ReadableUnit("% of the largest", 0.01))
    zero = (Mark(0.0, "y", ink=TEXT),)
    note = f"computed less {label}"
    return [*panels, Panel(x, of_largest, tuple(differences), marks=zero, note=note)]


def _compared_histories(
    results: xr.Dataset, run: xr.Dataset, theory: ExactHistory
) -> list[tuple[str, str, Floats, Floats]]:
    """Label, unit, computed and exact history of each quantity that was not prescribed."""
    radius = np.sqrt(run["contact_area"].values / np.pi)
    by_approach = isinstance(recorded_object(results, "load", _NAME), ApproachHistory)
    follows = (
        ("Force", "N", run["force"].values, theory.force)
        if by_approach
        else ("Approach", "m", run["approach"].values, theory.approach)
    )
    return [
        ("Contact radius", "m", radius, theory.contact_radius),
        follows,
        ("Peak pressure", "Pa", run["peak_pressure"].values, theory.peak_pressure),
    ]


def exact_history(results: xr.Dataset, figure: str) -> ExactHistory:
    """Hertz's, Lee and Radok's or Ting's solution of the case of a result."""
    # Lee and Radok's for a step or a ramp that is held; for other piecewise linear loads Ting's
    # equations as solved by `viscontact.reference`, for an elastic half-space Hertz's solution.
    indenter, load = (recorded_object(results, part, figure) for part in ("indenter", "load"))
    radius = sphere_radius(indenter)
    _require_known(results, indenter, radius, load, figure)
    compliance, is_elastic = _compliance(results, figure)
    instants = np.asarray(results["time"].values, dtype=np.float64)
    growing = exact_sphere(results, figure)
    if growing is not None and not is_elastic:
        return _of_growing(growing, instants)
    times, level = _loaded(load, instants)
    try:
        marched = _contact(
            *(float(radius or 0.0), load, compliance),
            *(_clock(results, figure).reduced(times), level),
        )
    except ValueError as error:
        raise ValueError(f"{figure}: {error}") from error
    last = np.searchsorted(times, instants, side="right") - 1
    return _of_marched(marched, last, "Hertz" if is_elastic else "Ting")


def exact_label(results: xr.Dataset, solution: str, figure: str = _NAME) -> str:
    """Legend of an exact solution, which replaces a sphere by its paraboloid."""
    sphere = isinstance(recorded_object(results, "indenter", figure), Sphere)
    return f"{'paraboloid' if sphere else 'exact'} ({solution})"


def _require_known(
    results: xr.Dataset, indenter: Indenter, radius: float | None, load: Any, figure: str
) -> None:
    kind = type(indenter).__name__
    if radius is None:
        raise ValueError(
            f"{figure}: needs a sphere or a round paraboloid, for which there is an exact "
            f"solution, got a {kind}; draw history instead"
        )
    if is_layered(results) or is_layered(results, "indenter_material"):
        raise ValueError(f"{figure}: needs a half-space, not layers; draw history instead")
    if any(recorded_grid(results).periodic):
        raise ValueError(f"{figure}: needs a half-space without period; draw history instead")
    if recorded_ends(results):
        raise ValueError(f"{figure}: needs a half-space without ends; draw history instead")
    if not isinstance(load, ForceHistory | ApproachHistory):
        raise ValueError(
            f"{figure}: needs a load of straight pieces, such as a step, a ramp or a triangle, "
            f"got a {type(load).__name__}; draw history instead"
        )
    tail = ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")
    off = [name for name in tail if np.any(getattr(load, name, None) or 0.0)]
    if off:
        raise ValueError(
            f"{figure}: needs a load on the axis, got {off[0].replace('_', ' ')}; draw history "
            "instead"
        )


def _compliance(results: xr.Dataset, figure: str) -> tuple[Any, bool]:
    """Contact compliance of both bodies, and True if both are elastic."""
    bodies = [recorded_object(results, part, figure) for part in ("material", "indenter_material")]
    there = [body for body in bodies if body is not None]
    compliance = there[0].contact_compliance()
    for other in there[1:]:
        compliance = compliance + other.contact_compliance()
    return compliance, all(isinstance(body.law, Elastic) for body in there)


def _clock(results: xr.Dataset, figure: str) -> Clock:
    """Clock of the creep of both bodies; ValueError if they have different ones."""
    parts = ("material", "indenter_material")
    clocks = dict.fromkeys(recorded_clock(results, part, figure) for part in parts)
    creeping = [clock for clock in clocks if clock is not TIME]
    if len(creeping) > 1:
        raise ValueError(
            f"{figure}: needs bodies whose creep follows one clock, and these have different "
            "shifts or ageing; draw history instead"
        )
    return next(iter(creeping), TIME)


def _loaded(load: Any, instants: Floats) -> tuple[Floats, Floats]:
    """Times of a reference solution, some steps between those of a run, and the levels there."""
    corners = np.unique(np.concatenate([load.kinks, load.jumps, [0.0, instants[-1]]]))
    corners = corners[corners <= instants[-1]]
    placed = reference.clustered_times(corners, _STEPS) if corners.size > 1 else corners
    times = np.unique(np.concatenate([placed, instants]))
    # A jump has two values, but for the one at the beginning, before which there is no contact.
    jumps = load.jumps[(load.jumps > 0) & (load.jumps <= instants[-1])]
    before = np.concatenate([times, jumps])
    level = np.concatenate([load.level_at(times), load.level_at(jumps, side="left")])
    order = np.lexsort((np.arange(before.size) < times.size, before))
    return before[order], level[order]


def _contact(
    radius: float, load: Any, compliance: Any, times: Floats, driven: Floats
) -> reference.AxisymmetricContact:
    """Reference solution under the load at times of the clock."""
    profile = reference.SphereProfile(radius)
    if isinstance(load, ApproachHistory):
        return reference.press_axisymmetric(
            profile, times, approach=driven, creep_compliance=compliance
        )
    return reference.press_axisymmetric(profile, times, force=driven, creep_compliance=compliance)


def _of_growing(contact: reference.LeeRadokContact, instants: Floats) -> ExactHistory:
    radius = np.asarray(contact.contact_radius(instants))
    places = radius[:, None] * _places()
    pressure = np.asarray(contact.pressure(places, instants[:, None]))
    return ExactHistory(
        "Lee–Radok",
        radius,
        np.asarray(contact.approach(instants)),
        np.asarray(contact.force(instants)),
        pressure.max(axis=1),
    )


def _of_marched(
    contact: reference.AxisymmetricContact, last: Integers, solution: str
) -> ExactHistory:
    """History at the last times of a solution before those of a run, by their numbers."""
    instants = contact.times[last]
    radius = contact.contact_radius[last]
    peaks = [
        float(np.max(contact.pressure(a * _places(), float(t)))) if a > 0 else 0.0
        for a, t in zip(radius, instants, strict=True)
    ]
    return ExactHistory(
        solution, radius, contact.approach[last], contact.force[last], np.array(peaks)
    )


def _places() -> Floats:
    # Denser towards the rim, where the pressure of a fluid is largest.
    places: Floats = np.sin(np.linspace(0.0, np.pi / 2, _PLACES, endpoint=False))
    return places


def exact_sphere(results: xr.Dataset, figure: str) -> reference.LeeRadokContact | None:
    """Lee-Radok solution for a sphere or paraboloid under a step or held ramp; None otherwise."""
    indenter, load, material, other = (
        recorded_object(results, part, figure)
        for part in ("indenter", "load", "material", "indenter_material")
    )
    radius = sphere_radius(indenter)
    if radius is None or not isinstance(load, ForceHistory):
        return None
    if is_layered(results) or is_layered(results, "indenter_material") or recorded_ends(results):
        return None
    parts = ("material", "indenter_material")
    if any(recorded_clock(results, part, figure) is not TIME for part in parts):
        return None  # in the time of the clock
    compliance = material.contact_compliance()
    if other is not None:
        compliance = compliance + other.contact_compliance()
    return _growing_contact(load, radius, compliance)


def sphere_radius(indenter: Indenter) -> float | None:
    """Radius of a sphere or round paraboloid [m]; None for any other body."""
    if isinstance(indenter, Sphere):
        return indenter.radius
    if isinstance(indenter, Paraboloid) and indenter.radius_x == indenter.radius_y:
        return indenter.radius_x
    return None


def _growing_contact(
    load: ForceHistory, radius: float, compliance: Any
) -> reference.LeeRadokContact | None:
    times, force = load.times, load.force
    if times[0] != 0 or force[-1] <= 0:
        return None
    if (force == force[-1]).all():
        return reference.lee_radok_step(float(force[-1]), radius, compliance, compliance.relaxation)
    if force[0] == 0 and times[1] > 0 and (force[1:] == force[-1]).all():
        duration = float(times[1])
        return reference.lee_radok_ramp(
            float(force[-1]), duration, radius, compliance, compliance.relaxation
        )
    return None
