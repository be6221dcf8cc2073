"""Strip in plane strain: displacement that two free faces add to that of the mirrored half-plane.

This is the operator G of `strip` at k = 0, in units of its half length W, with its kernels

    T = 2 Σ cos κX (1 - κZ) exp(-κZ),   F = (2/π) ∫ (2H - S) cos(ζZ) dζ,
    C = (2/π) ∫ (2/ζ) L cos(ζZ) cos(ζZ') dζ,

and κ = nπ, n >= 1, under even pressures, κ = (n + 1/2)π under odd ones; Poisson's ratio is in none
of them. A uniform pressure has no wave κ: it compresses the strip as a column, whose end stays
plane, and counts as no displacement. A pressure that is linear in x bends the strip as a beam,
whose end stays plane, too, and counts as none. Without its moment, odd pressures have loads on the
faces up to one that moves the strip as a rigid body, which is chosen at will.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy  # its special functions are imported at their first use

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.strip import (
    SHORTEST,
    cosine_transform,
    face_of_strips,
    surface_panels,
)
from viscontact.mechanics.halfspace.strip_slab import slab

#: Displacement that the operator of waves without end along y misses, as in `strip_basis`.
MISSED = 2e-5


@dataclass(frozen=True, eq=False)
class PlaneStrip:
    """G under line loads between the nodes of the surface (`strip.surface_panels`)."""

    added: Floats  # shape (nodes, nodes) [-]
    error: float  # that it may miss, over the largest displacement [-]


@lru_cache(maxsize=2)
def plane_strip(*, odd: bool) -> PlaneStrip:
    """What two free faces add to even or odd pressures; of odd ones, to those without moment."""
    surface, face = surface_panels(), face_of_strips()
    stress, above = _stress_on_face(odd=odd), _stress_on_surface(odd=odd)
    arm = 1 - surface.places
    weighted = stress * surface.weights
    returned = (weighted @ above) * face.panels.weights
    count = len(returned)
    matrix, loads = np.eye(count) - returned, stress
    to_waves = face.to_waves
    if odd:
        # The load that moves the strip as a rigid body is fixed by a moment, and the moment of the
        # pressure is taken off.
        bent = weighted @ arm
        loads = stress - np.outer(bent, arm) / (arm**2 @ surface.weights)
        sums = face.panels.weights * face.panels.places
        matrix = np.block([[matrix, bent[:, None]], [sums, np.zeros(1)]])
        # Loads on the faces have no resultant, which would bend the strip without limit.
        to_waves = to_waves - cosine_transform(face.panels, np.zeros(1))
    full = np.zeros((len(matrix), loads.shape[1]))
    full[:count] = loads
    freed = np.linalg.solve(matrix, full)[:count]
    sinh, _, denominator, _ = slab(face.waves, -1.0 if odd else 1.0)
    compliance = 4 / np.pi * face.wave_weights / face.waves * sinh**2 / denominator
    raw = (to_waves @ loads).T @ (compliance[:, None] * (to_waves @ freed))
    added = np.triu(raw) + np.triu(raw, 1).T
    known = surface.places > SHORTEST
    skew = np.abs(raw - raw.T)[known][:, known].max()
    return PlaneStrip(added, float(skew / np.abs(raw).max()) + MISSED)


def _stress_on_face(*, odd: bool) -> Floats:
    """T: stress at nodes of the face (rows) under lines at distances X from it (columns)."""
    depth, along = face_of_strips().panels.places[:, None], surface_panels().places
    exponent = -np.pi * (depth - 1j * along)
    power, rest = np.exp(exponent), -np.expm1(exponent)
    if odd:
        root = np.exp(exponent / 2)
        waves, slopes = root / rest, root * (1 + power) / (2 * rest**2)
    else:
        waves, slopes = power / rest, power / rest**2
    return np.asarray(2 * (waves - np.pi * depth * slopes).real)


def _stress_on_surface(*, odd: bool) -> Floats:
    """F: stress at distances X from a face (rows) under lines at its nodes (columns)."""
    face, sign = face_of_strips(), -1.0 if odd else 1.0
    depth, along = face.panels.places, surface_panels().places[:, None]
    near = 2 * depth**2 * along / np.hypot(depth, along) ** 4
    zeta, cosines = face.images(1.0)
    sinh, cosh, denominator, decay = slab(zeta, sign)
    xi = zeta * (1 - along)
    own, other = np.exp(-along * zeta), sign * decay * np.exp(along * zeta)
    half_sum = sinh * (own + other) / denominator
    across = ((sinh + zeta * cosh) * (own + other) - xi * sinh * (own - other)) / denominator
    rest = 2 * half_sum - across - (1 - along * zeta) * own
    if odd:
        # 3 (1 - X)/ζ² of a beam has a finite part, as loads on the faces have no resultant.
        rest -= 3 * (1 - along) * np.exp(-(zeta**2)) / zeta**2
        bent = -np.pi / 2 * depth * scipy.special.erf(depth / 2)
        bent -= np.sqrt(np.pi) * np.exp(-(depth**2) / 4)
        near = near + 3 * (1 - along) * bent
    return np.asarray(2 / np.pi * (near + rest @ cosines.T))
