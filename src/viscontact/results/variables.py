"""What a result holds: its variables, their units and what they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from viscontact.state import Outcome


@dataclass(frozen=True)
class Variable:
    """A variable of the result.

    Attributes
    ----------
    units : str
        Its unit, as CF and UDUNITS write it.
    long_name : str
        What it is.
    kind : str
        NumPy's name of its type.
    comment : str
        What else has to be known of it.
    has_error : bool
        Whether its error is estimated, and kept beside it.
    """

    units: str
    long_name: str
    kind: str = "f8"
    comment: str = ""
    has_error: bool = False

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes the variable carries."""
        attributes = {"units": self.units, "long_name": self.long_name}
        return attributes | ({"comment": self.comment} if self.comment else {})


COORDINATES = {
    "time": Variable("s", "time"),
    "x": Variable("m", "position along the indenter"),
    "y": Variable("m", "position across the indenter"),
}

#: Said of what is not computed beyond the grid of its instant.
_BEYOND = "NaN beyond the grid of an instant before the grid was enlarged (see grid_enlarged)"

FIELDS = {
    "pressure": Variable("Pa", "contact pressure, positive in compression"),
    "gap": Variable("m", "gap, positive when open", comment=_BEYOND),
    "displacement": Variable(
        "m", "surface displacement, positive into the half-space", comment=_BEYOND
    ),
}

SCALARS = {
    "force": Variable("N", "force on the contact", has_error=True),
    "eccentricity_x": Variable("m", "position of the resultant along x", has_error=True),
    "eccentricity_y": Variable("m", "position of the resultant along y", has_error=True),
    "approach": Variable(
        "m", "rigid approach, positive when the bodies come closer", has_error=True
    ),
    "tilt_x": Variable(
        "rad", "rigid slope along x, positive when the +x end is deeper", has_error=True
    ),
    "tilt_y": Variable(
        "rad", "rigid slope along y, positive when the +y end is deeper", has_error=True
    ),
    "contact_area": Variable("m2", "contact area", has_error=True),
    "contact_length": Variable("m", "extent of the contact along x", has_error=True),
    "contact_width": Variable("m", "extent of the contact along y", has_error=True),
    "peak_pressure": Variable("Pa", "largest pressure", has_error=True),
    "mean_pressure": Variable("Pa", "force over contact area", has_error=True),
    "work": Variable("J", "work of the load on the contact since the start", has_error=True),
    "loss_per_cycle": Variable(
        "J", "work that the last whole cycle of the load has cost", has_error=True
    ),
    "time_error": Variable("1", "estimated relative error of pressure owed to the time steps"),
    "iterations": Variable("1", "iterations of the contact solver", "i4"),
    "residual": Variable("1", "relative violation of the contact conditions"),
    "cells_across": Variable("1", "cells across the contact, along its shorter way", "i4"),
    "outcome": Variable("1", "how the instant ended", "i1"),
}

#: CF's way to write an enumeration.
OUTCOME_FLAGS = {
    "flag_values": np.array([outcome.value for outcome in Outcome], dtype="i1"),
    "flag_meanings": " ".join(outcome.name.lower() for outcome in Outcome),
}

_BAR = "half width of the error bar: inf where the value depends on the mesh, NaN where unknown"


def error_name(name: str) -> str:
    """Return what the error of a variable is called in a result.

    Parameters
    ----------
    name : str
        The variable.

    Examples
    --------
    >>> error_name("peak_pressure")
    'peak_pressure_error'
    """
    return f"{name}_error"


#: The errors of scalars, by their own names.
ERRORS = {
    error_name(name): Variable(
        variable.units, f"estimated error of: {variable.long_name}", comment=_BAR
    )
    for name, variable in SCALARS.items()
    if variable.has_error
}


def scalar_attributes(name: str, *, errors: bool) -> dict[str, Any]:
    """Return what a scalar carries, with CF's pointer to its error if it has one.

    Parameters
    ----------
    name : str
        The scalar.
    errors : bool
        Whether the result has errors.

    Examples
    --------
    >>> scalar_attributes("force", errors=True)["ancillary_variables"]
    'force_error'
    """
    attributes = SCALARS[name].attributes
    if errors and SCALARS[name].has_error:
        attributes["ancillary_variables"] = error_name(name)
    return attributes
