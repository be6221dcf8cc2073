"""Warning that a height map is wholly in contact, with the force below which it is not."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadPoint
from viscontact.mechanics.contact.body_edge import trace_outline
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.rim import trace_rim
from viscontact.simulation.meshing.contact_extent import PointContact
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate, elastic_contact
from viscontact.units.formatting import format_quantity


def whole_map_warning(indenter: Indenter, found: PointContact, grid: Grid) -> dict[str, str]:
    """Warn if all of a height map is in contact under a load on a grid; empty otherwise."""
    # The coarse estimate leaves out short waves, which open first: it only excludes the warning.
    if min(indenter.sample_spacing) <= 0 or not _is_whole(found.estimate):
        return {}
    whole = _contact(found, indenter.gap(grid.x[:, None], grid.y[None, :]), grid, found.point)
    if not _is_whole(whole):
        return {}
    rim = trace_rim(grid, whole.in_contact, whole.gap, trace_outline(indenter, grid))
    size = " x ".join(format_quantity(each, "m", 2) for each in (rim.length, rim.width))
    less = "less"
    if found.point.force is not None:
        most = opening_force(replace(found, estimate=whole))
        less = f"with less than about {format_quantity(most, 'N', 2)}"
    return {
        "whole map": (
            f"the whole map ({size}) is in contact: the contact ends where the map ends, and its "
            f"roughness is pressed flat; press {less}, or measure a larger map"
        )
    }


def opening_force(found: PointContact) -> float:
    """Return the force at which a body wholly in contact under a force begins to open [N]."""
    # While the contact does not change, the pressure is linear in the force. It is solved at the
    # given one and at twice that; the first cell whose pressure falls to zero opens.
    estimate, force = found.estimate, found.point.force
    assert force is not None  # under an approach there is no such force
    doubled = replace(found.point, force=2 * force)
    twice = _contact(found, estimate.open_gap, estimate.grid, doubled).pressure
    rise = np.where(twice > estimate.pressure, twice - estimate.pressure, math.inf)
    covered = np.isfinite(estimate.open_gap)
    return float(force * (1 - estimate.pressure / rise)[covered].max())


def _is_whole(estimate: ContactEstimate) -> bool:
    """True if all cells of the body are in contact."""
    return bool(estimate.in_contact[np.isfinite(estimate.open_gap)].all())


def _contact(
    found: PointContact, open_gap: Floats, grid: Grid, point: LoadPoint
) -> ContactEstimate:
    """Elastic contact under a load on a grid."""
    domain = ContactDomain(grid, response=found.response)
    return elastic_contact(open_gap, found.compliance, point, domain)
