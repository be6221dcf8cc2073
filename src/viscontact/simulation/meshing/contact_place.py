"""Place of a contact: around the origin, or small and far from it, where coarse cells miss it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.bodies.grid import MIN_CELLS_ACROSS
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadPoint
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate, estimate_contact
from viscontact.units.formatting import format_quantity

#: A contact is far from the origin along an axis if a grid around the origin would be this many
#: times as long as one around the contact.
FAR = 4.0

Place = tuple[float, float]


def locate_contact(
    indenter: Indenter,
    compliance: float,
    point: LoadPoint,
    *,
    response: SurfaceResponse = HALF_SPACE,
) -> ContactEstimate:
    """Estimate a contact at one compliance [1/Pa]; ValueError if no grid fits."""
    found, refusals = None, []
    far_compliance = response.long_waves * compliance
    try:
        found = estimate_contact(indenter, compliance, point, response=response)
    except ValueError as error:
        refusals.append(error)
    if found is not None and found.rim.cells_across >= MIN_CELLS_ACROSS:
        return found
    alone = _far_contact(indenter, compliance, point, found, response)
    if alone is not None:
        elsewhere = _place_elsewhere(indenter, far_compliance, point, alone)
        if elsewhere is None:
            return alone
        refusals.append(_refusal(alone.peak_place, elsewhere))
    if found is not None:
        may_tilt = point.tilt_x is None or point.tilt_y is None
        elsewhere = None if may_tilt else _place_elsewhere(indenter, far_compliance, point, found)
        if elsewhere is None:
            return found
        refusals.append(_refusal(found.peak_place, elsewhere))
    raise refusals[0]


def _far_contact(
    indenter: Indenter,
    compliance: float,
    point: LoadPoint,
    found: ContactEstimate | None,
    response: SurfaceResponse,
) -> ContactEstimate | None:
    """Estimate a contact on a grid around its probable place; None if it is not far away."""
    place = _probable_place(indenter, point, found)
    if place is None or not any(place):
        return None
    try:
        alone = estimate_contact(indenter, compliance, point, around=place, response=response)
    except ValueError:
        return None
    is_far = any(grid_centre([alone])) and alone.rim.cells_across >= MIN_CELLS_ACROSS
    return alone if is_far else None


def _probable_place(
    indenter: Indenter, point: LoadPoint, found: ContactEstimate | None
) -> Place | None:
    """Place of a small contact: under the force, at a map's deepest point, or as found [m]."""
    if point.tilt_x is None and point.tilt_y is None:
        return point.eccentricity_x, point.eccentricity_y
    x, y = indenter.sample_points
    if x.size and point.tilt_x is not None and point.tilt_y is not None:
        deepest = int((indenter.gap(x, y) - point.tilt_x * x - point.tilt_y * y).argmin())
        return float(x[deepest]), float(y[deepest])
    return None if found is None else found.centre


def _place_elsewhere(
    indenter: Indenter, compliance: float, point: LoadPoint, found: ContactEstimate
) -> Place | None:
    """Point of a height map below the surface beyond the grid of an estimate [m], or None."""
    # The displacement there is that of a point load, J F/(pi r) (Johnson 1985, Contact Mechanics,
    # eq. 3.22b). A body that is free to tilt is taken as level.
    x, y = indenter.sample_points
    (middle_x, middle_y), (lx, ly) = found.grid.centre, found.grid.size
    beyond = np.maximum(np.abs(x - middle_x) / lx, np.abs(y - middle_y) / ly) > 0.5
    x, y = x[beyond], y[beyond]
    away_x, away_y = x - found.centre_x, y - found.centre_y
    surface = compliance * found.force / (np.pi * np.hypot(away_x, away_y))
    tilt_x, tilt_y = point.tilt_x or 0.0, point.tilt_y or 0.0
    below = found.motion @ (1.0, *found.centre) + tilt_x * away_x + tilt_y * away_y
    below = below - indenter.gap(x, y) - surface
    if not (below > 0).any():
        return None
    deepest = int(below.argmax())
    return float(x[deepest]), float(y[deepest])


def _refusal(*places: Place) -> ValueError:
    """Refusal of contacts in two places."""
    one, other = (
        # To a nanometre: the rest is rounding.
        f"x = {format_quantity(round(x, 9), 'm', 3)}, y = {format_quantity(round(y, 9), 'm', 3)}"
        for x, y in places
    )
    return ValueError(
        f"grid: the contacts at {one} and {other} are too small and too far apart for one grid; "
        "keep one of the peaks only, or give a grid"
    )


def grid_centre(contacts: Sequence[ContactEstimate]) -> Place:
    """Centre of a grid over contacts, rounded [m]: 0 along an axis unless they are far away."""
    middles = np.array([each.centre for each in contacts])
    halves = np.array([each.extents for each in contacts]) / 2
    low, high = (middles - halves).min(axis=0), (middles + halves).max(axis=0)
    x, y = (_centre(*ends) for ends in zip(low.tolist(), high.tolist(), strict=True))
    return x, y


def _centre(low: float, high: float) -> float:
    middle, half = (low + high) / 2, (high - low) / 2
    # To a decimal place below a quarter of the contact, so that it is a short number.
    is_far = abs(middle) + half > FAR * half
    return round(middle, -int(np.floor(np.log10(half / 4)))) if is_far else 0.0
