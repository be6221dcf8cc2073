"""Lee-Radok solution of the recorded case of a result."""

from __future__ import annotations

from typing import Any

import xarray as xr

from viscontact.bodies.indenters import Indenter, Paraboloid, Sphere
from viscontact.bodies.loads import ForceHistory
from viscontact.reference import LeeRadokContact, lee_radok_ramp, lee_radok_step
from viscontact.results.recorded_case import is_layered, recorded_object


def exact_sphere(results: xr.Dataset, figure: str) -> LeeRadokContact | None:
    """Lee-Radok solution for a sphere or paraboloid under a step or held ramp; None otherwise."""
    indenter, load, material, other = (
        recorded_object(results, part, figure)
        for part in ("indenter", "load", "material", "indenter_material")
    )
    radius = sphere_radius(indenter)
    if radius is None or not isinstance(load, ForceHistory):
        return None
    if is_layered(results) or is_layered(results, "indenter_material"):
        return None
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


def _growing_contact(load: ForceHistory, radius: float, compliance: Any) -> LeeRadokContact | None:
    times, force = load.times, load.force
    if times[0] != 0 or force[-1] <= 0:
        return None
    if (force == force[-1]).all():
        return lee_radok_step(float(force[-1]), radius, compliance, compliance.relaxation)
    if force[0] == 0 and times[1] > 0 and (force[1:] == force[-1]).all():
        duration = float(times[1])
        return lee_radok_ramp(float(force[-1]), duration, radius, compliance, compliance.relaxation)
    return None
