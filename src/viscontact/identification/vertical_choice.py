"""Choice of the vertical shift with which sets are superposed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.identification.measured_sets import MeasuredSets
from viscontact.identification.shift_uncertainty import relative_to
from viscontact.identification.superposition import Superposition, superposed
from viscontact.identification.vertical_shift import Vertical, VerticalShift, vertical_shift
from viscontact.units.temperatures import in_celsius

# Decrease of -2 ln(likelihood) by a vertical shift for which one modulus or compliance alone is
# taken to have one.
_EVIDENCE = 12.0
_MATTERS = 0.1  # change of log10 a_T by the choice that is reported [decades]


@dataclass(frozen=True, eq=False)
class VerticalChoice:
    """Superposition with the vertical shift that was chosen."""

    name: Vertical
    shift: VerticalShift
    joined: Superposition
    doubts: tuple[str, ...] = ()


def chosen_vertical(
    sets: MeasuredSets, name: Vertical | None, expansion: float, reference: float
) -> VerticalChoice:
    """Superposition with a vertical shift of this name; None: as the sets tell."""
    # Storage and loss have a ratio that no vertical shift touches, so they determine it. One
    # response hardly does: it has none unless the sets are much more likely with one.
    if name is not None or sets.columns > 1:
        return _choice(sets, name or "found", expansion)
    without, found = _choice(sets, "none", expansion), _choice(sets, "found", expansion)
    if without.joined.cost - found.joined.cost > _EVIDENCE:
        return found
    rubber = _choice(sets, "rubber", expansion)
    if without.joined.cost < rubber.joined.cost - _EVIDENCE:
        return without
    one, other = (_decades(sets, each.joined, reference) for each in (without, rubber))
    worst = int(np.argmax(np.abs(other - one)))
    if not abs(other - one)[worst] > _MATTERS:
        return without
    doubt = (
        "a vertical shift is not assumed, as one modulus or compliance alone hardly shows it; if "
        "the modulus is proportional to the absolute temperature, as that of a rubber, log10 a_T "
        f"at {in_celsius(sets.temperatures[worst]):.4g} °C is {other[worst]:.2f} and not "
        f"{one[worst]:.2f}; decide with the option vertical: none, rubber or found"
    )
    return VerticalChoice("none", without.shift, without.joined, (doubt,))


def _choice(sets: MeasuredSets, name: Vertical, expansion: float) -> VerticalChoice:
    shift = vertical_shift(name, sets.temperatures, expansion)
    return VerticalChoice(name, shift, superposed(sets, shift))


def _decades(sets: MeasuredSets, joined: Superposition, reference: float) -> Floats:
    logs = np.array([joined.logs_a, joined.logs_b])
    relative, _ = relative_to(reference, sets.temperatures, logs, joined.covariance)
    return np.asarray(relative[0] / np.log(10.0))
