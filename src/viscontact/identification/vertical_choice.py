"""Choice of the vertical shift with which sets are superposed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.measured_sets import MeasuredSets
from viscontact.identification.shift_uncertainty import relative_to
from viscontact.identification.superposition import Superposition, slower_steps, superposed
from viscontact.identification.vertical_shift import Vertical, VerticalShift, vertical_shift
from viscontact.units.temperatures import in_celsius

# Difference of -2 ln(likelihood) that decides between two vertical shifts: very strong evidence
# after Kass and Raftery, J. Am. Stat. Assoc. 90 (1995) 773-795.
_EVIDENCE = 10.0
_CASES = {
    "rubber": "if the modulus is proportional to the absolute temperature, as that of a rubber",
    "found": "with one that joins them as well",
}
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
    if slower_steps(without.joined) and not slower_steps(found.joined):
        return found
    doubts = _open_question(sets, without, (_choice(sets, "rubber", expansion), found), reference)
    return VerticalChoice("none", without.shift, without.joined, tuple(doubts))


def _open_question(
    sets: MeasuredSets,
    without: VerticalChoice,
    others: tuple[VerticalChoice, ...],
    reference: float,
) -> Iterator[str]:
    """Sentence about a vertical shift that is as likely as none, where it changes a_T."""
    one = _decades(sets, without.joined, reference)
    for other in others:
        if other.joined.cost > without.joined.cost + _EVIDENCE:
            continue
        decades = _decades(sets, other.joined, reference)
        worst = int(np.argmax(np.abs(decades - one)))
        if abs(decades - one)[worst] > _MATTERS:
            yield (
                "no vertical shift is assumed, as one modulus or compliance alone hardly shows "
                f"it, but {_CASES[other.name]}, log10 a_T at "
                f"{round(in_celsius(sets.temperatures[worst]), 6):.4g} °C is {decades[worst]:.2f} "
                f"and not {one[worst]:.2f}; decide with the option vertical: none, rubber or found"
            )
            return


def _choice(sets: MeasuredSets, name: Vertical, expansion: float) -> VerticalChoice:
    shift = vertical_shift(name, sets.temperatures, expansion)
    return VerticalChoice(name, shift, superposed(sets, shift))


def _decades(sets: MeasuredSets, joined: Superposition, reference: float) -> Floats:
    logs = np.array([joined.logs_a, joined.logs_b])
    relative, _ = relative_to(reference, sets.temperatures, logs, joined.covariance)
    return np.asarray(relative[0] / np.log(10.0))
