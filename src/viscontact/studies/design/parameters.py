"""Parameters of a design: the space that it searches."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from viscontact.studies.space import Space, given_parameter

#: Most parameters of a design.
MOST_PARAMETERS = 8


def space_of(change: Mapping[str, Any]) -> Space:
    """Return the space of the parameters of `design`; ValueError names the fault."""
    if not isinstance(change, Mapping) or not change:
        raise ValueError(
            "change: name a key, as {'indenter.crown_radius': ('20 mm', '2 m', 'log')}"
        )
    if len(change) > MOST_PARAMETERS:
        raise ValueError(
            f"change: must have {MOST_PARAMETERS} parameters at most, got {len(change)}"
        )
    for key in change:
        if key.partition(".")[0] in ("grid", "output", "time"):
            raise ValueError(
                f"change: {key}: the cells and steps of a case are no parameters of a design"
            )
    return Space(tuple(given_parameter("change", key, given) for key, given in change.items()))
