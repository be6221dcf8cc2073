"""Resistance of a half-space against a body in steady motion, by slope and by dissipation."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.mechanics.contact.moving_domain import MovingDomain
from viscontact.mechanics.contact.resistance import reaches_end, resistance_by_slope
from viscontact.mechanics.halfspace.moving_load import MovingCompliance

#: Retardation lengths beyond so many half lengths of the contact: the dissipation is the more
#: accurate form.
LONG = 5.0

#: At lengths below a cell the forms err to opposite sides, the slope by less: errors of both on
#: grids of 20 to 130 cells are in the ratio of J(inf)/J(0) - 1 to about this power (1.0 at a ratio
#: of compliances of 2, 3.6 at 10).
SHORT_EXPONENT = 0.6


@dataclass(frozen=True)
class Resistance:
    """Force against the motion along an axis [N], by the slope and by the dissipation."""

    by_slope: float
    by_dissipation: float
    slope_weight: float  # weight of the first form in the value
    #: The body ends in the contact, where its slope has no limit, or repeats itself as a map.
    at_end: bool
    #: Loss over the modulus of the compliance of waves as long as the contact, sin(loss angle) [-].
    loss_share: float = 1.0

    @property
    def value(self) -> float:
        """The more accurate form, or a mean of both [N]."""
        weight = 0.0 if self.at_end else self.slope_weight
        return weight * self.by_slope + (1 - weight) * self.by_dissipation

    @property
    def difference(self) -> float:
        """Difference of both forms, which is zero on an infinitely fine grid [N]."""
        return abs(self.by_slope - self.by_dissipation)


def resistance(
    indenter: Indenter,
    domain: MovingDomain,
    pressure: Floats,
    tilts: tuple[float, float],
    half_length: float,
) -> Resistance:
    """Resistance along the motion; pressure [Pa], tilts along x and y, half length of spots [m]."""
    whole = domain.expand_by_symmetry(pressure)
    by_slope = resistance_by_slope(whole, domain.grid, indenter, tilts)[domain.axis]
    lost = float((pressure * domain.loss.apply(pressure)).sum())
    lost *= domain.grid.cell_area * domain.symmetry_count
    # The slope of a map is that of chords between its points: of the second order, where the
    # dissipation of waves is exact up to the length of two cells.
    is_map = min(indenter.sample_spacing) > 0 and domain.grid.periodic[domain.axis]
    at_end = is_map or reaches_end(whole, domain.grid, indenter)[domain.axis]
    waves = domain.surface.at_length(1 / half_length).at_wave_number(np.array(1 / half_length))
    share = float(waves.imag / abs(waves))
    return Resistance(by_slope, lost, _slope_weight(domain, half_length), at_end, share)


def _slope_weight(domain: MovingDomain, half_length: float) -> float:
    """Weight of the form by the slope in the resistance."""
    moving = domain.surface.at_length(1 / half_length)
    length = _lossy_length(moving, half_length)
    if moving.instant == 0:  # the loss where the surface is loaded first is not resolved
        return 1.0
    if length > LONG * half_length:
        return 0.0
    if length > domain.grid.cell_size[domain.axis]:
        return 1.0
    growth = float(max(moving.relaxed / moving.instant - 1, 0.0) ** SHORT_EXPONENT)
    return growth / (1 + growth)


def _lossy_length(moving: MovingCompliance, half_length: float) -> float:
    """Mean retardation length by weights of the loss in a wave as long as the contact [m]."""
    wave = 1 / half_length
    turn = wave * moving.lengths
    loss = moving.amplitudes * turn / (1 + turn**2)
    total = float(loss.sum())
    return float(np.exp(loss @ np.log(moving.lengths) / total)) if total else 0.0
