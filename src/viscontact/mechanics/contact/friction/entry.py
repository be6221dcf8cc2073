"""Compliance of cells that come into contact during a step.

At the begin of the step such a cell is still free, and slides under the body while it closes its
gap; to hold it there would be false. As the contact grows the surface moves along itself, against
the body, in the ratio of the tractions q/p to the movement that closes the gap, times C. So a cell
that sticks from its touch on has the slip -C (q/p) gap, as if it were more compliant by C gap/p.
Near the edge, by modes II and III of a crack, C = n n^T + (1 + κ) t t^T with the normal n of the
edge; so it is everywhere in a line contact. Farther out, of a sphere under tractions in proportion
to its pressure, at ρ contact radii,

    C_n = [ρ² (4 + κ)/8 - (2 + κ) (π - A)/(2π) + κ B/(4π)]/(ρ²/2 - 1 + A/π),
    C_t = [ρ² (4 + 3κ)/8 - (2 + κ) (π - A)/(2π) - κ B/(4π)]/(ρ²/2 - 1 + A/π),
    A = (2 - ρ²) asin(1/ρ) + (ρ² - 1)^(1/2),  B = ρ² asin(1/ρ) + (2 - ρ²) (ρ² - 1)^(1/2)/ρ²,

which is 1 + κ/4 and 1 + 3κ/4 for a first contact, all of which is new.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), eqs. 3.42a, 3.91a and 3.91b, section 5.1.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.mechanics.contact.friction.normal_contact import NormalContact

#: Of layers over lengths of growth [m]: compliance along the surface over that into it, and κ.
OfLayers = Callable[[Floats], tuple[Floats, Floats]]

#: Contact radii up to which a cell is near the edge.
NEAR = 1.001

#: Difference of gaps over the largest that is rounding, and the tolerance of the solver.
SAME = 1e-6


def entry_compliance(
    contact: NormalContact,
    before: NormalContact,
    cell_size: tuple[float, float],
    kappa: float | Floats,
    *,
    plane: bool = False,
    layers: OfLayers | None = None,
    cut: tuple[slice, slice] = (slice(None), slice(None)),
) -> Floats:
    """Entries xx, xy and yy of C gap/p in cells that enter [m/Pa], shape (3, nx, ny).

    The contacts are those at the end of the step and at its begin; `plane` tells a line contact.
    The entries are those of a part of the grid.
    """
    gap, enters = before.gap, contact.entered_since(before)
    found = np.zeros((3, *gap[cut].shape))
    if not enters.any():
        return found
    compliance = np.maximum(gap[enters] / contact.pressure[enters], 0.0)
    radii = _radii(enters, before.cells, gap, plane=plane)
    if layers is not None:
        size = _size(before if before.cells else contact, cell_size, plane=plane)
        ratio, kappa = layers(size * np.where(np.isinf(radii), 1.0, radii - 1))
        compliance *= ratio
    if plane:
        along, across = np.ones(compliance.size), 1 + kappa * np.ones(compliance.size)
    else:
        along, across = _ratios(radii, kappa)
    x, y = _edge_normal(gap, enters, cell_size)
    xx, yy = along * x * x + across * y * y, along * y * y + across * x * x
    found[:, enters[cut]] = (np.stack([xx, (along - across) * x * y, yy]) * compliance)[
        :, _within(enters, cut)
    ]
    return found


def _within(cells: Bools, cut: tuple[slice, slice]) -> Bools:
    """For each of some cells whether it is in a part of the grid."""
    inside = np.zeros(cells.shape, bool)
    inside[cut] = True
    return inside[cells]


def _size(contact: NormalContact, cell_size: tuple[float, float], *, plane: bool) -> float:
    """Radius of a round contact, half width of a line [m]."""
    if plane:
        return contact.cells * min(cell_size) / 2
    return float(np.sqrt(contact.cells * np.prod(cell_size) / np.pi))


def _radii(enters: Bools, held: int, gap: Floats, *, plane: bool) -> Floats:
    """Distance of cells that enter, in the radii of a round contact before; inf without one."""
    # Cells enter in the order of their gaps: the area inside is known when each does. Those of one
    # gap, as mirror images, enter together.
    heights = gap[enters]
    order = np.argsort(heights, kind="stable")
    rises = np.diff(heights[order]) > SAME * heights[order[-1]]
    group = np.append(0, np.cumsum(rises))
    mean = np.bincount(group, np.arange(order.size)) / np.bincount(group)
    area = np.empty(order.size)
    area[order] = held + mean[group] + 0.5
    if not held:
        return np.full(order.size, np.inf)
    return area / held if plane else np.sqrt(area / held)


def _ratios(radii: Floats, kappa: float | Floats) -> tuple[Floats, Floats]:
    """C along the normal of the edge and across it, at distances in contact radii."""
    kappa = kappa * np.ones(radii.size)
    along = np.where(np.isinf(radii), 1 + kappa / 4, 1.0)
    across = np.where(np.isinf(radii), 1 + 3 * kappa / 4, 1 + kappa)
    far = (radii > NEAR) & np.isfinite(radii)
    rho, kappa = radii[far], kappa[far]
    angle, root = np.arcsin(1 / rho), np.sqrt(rho**2 - 1)
    a = (2 - rho**2) * angle + root
    b = rho**2 * angle + (2 - rho**2) * root / rho**2
    closed = rho**2 / 2 - 1 + a / np.pi
    mean, split = (2 + kappa) * (np.pi - a) / (2 * np.pi), kappa * b / (4 * np.pi)
    along[far] = (rho**2 * (4 + kappa) / 8 - mean + split) / closed
    across[far] = (rho**2 * (4 + 3 * kappa) / 8 - mean - split) / closed
    return along, across


def _edge_normal(gap: Floats, enters: Bools, cell_size: tuple[float, float]) -> Floats:
    """Unit vectors in cells that enter along which the gap opens; along x where it is level."""
    cells = np.stack(np.nonzero(enters))
    slopes = np.zeros(cells.shape)
    for axis, (cell, count) in enumerate(zip(cell_size, gap.shape, strict=True)):
        before, after = cells.copy(), cells.copy()
        before[axis] = np.maximum(cells[axis] - 1, 0)
        after[axis] = np.minimum(cells[axis] + 1, count - 1)
        if count > 1:
            with np.errstate(invalid="ignore"):
                rise = gap[tuple(after)] - gap[tuple(before)]
            slopes[axis] = rise / ((after[axis] - before[axis]) * cell)
    known = np.isfinite(slopes).all(axis=0)
    slopes = np.where(known, slopes, 0.0)
    length = np.hypot(*slopes)
    unit = np.divide(slopes, length, out=np.zeros(slopes.shape), where=length > 0)
    unit[0][length == 0] = 1.0
    return unit
