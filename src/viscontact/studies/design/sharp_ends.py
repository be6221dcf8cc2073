"""Sharp ends of rollers, where the pressure of a contact has no limit."""

from __future__ import annotations

import xarray as xr

from viscontact.bodies.indenters import (
    Chamfer,
    CylindricalProfile,
    FullCrown,
    Indenter,
    PartialCrown,
    Roller,
    TwoRadiiCrown,
)
from viscontact.simulation.checks.half_space_theory import AT_THE_END

_SHARP = (CylindricalProfile, PartialCrown, FullCrown, TwoRadiiCrown, Chamfer)


def reaches_sharp_end(indenter: Indenter, found: xr.Dataset) -> bool:
    """True if the contact of a run reaches an edge at the end of a roller, by its warnings."""
    # The end of a logarithmic profile has a finite pressure, which the error bars cover.
    has_edge = isinstance(indenter, Roller) and isinstance(indenter.line, _SHARP)
    return has_edge and AT_THE_END in str(found.attrs.get("warnings", ""))
