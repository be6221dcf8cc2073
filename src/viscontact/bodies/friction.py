"""Friction between the bodies: Coulomb's law."""

from __future__ import annotations

from dataclasses import field
from typing import Any

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.numbers import as_real, check_fields

#: Largest coefficient of friction: larger ones are taken for percentages.
LARGEST = 10.0


@dataclass(frozen=True)
class Friction:
    """Coulomb friction: a cell under the pressure p carries tractions up to μ p, then it slips.

    Parameters
    ----------
    coefficient : float
        Coefficient of friction μ, positive, at most 10 [-].
    coupling : bool, optional
        False: normal contact does not feel tractions along the surface, and the surface does not
        move along itself under pressure. That is exact for two bodies of the same material, and for
        bodies of Poisson's ratio 1/2 where the other is rigid or the same; it is chosen by itself
        there. For other bodies it is an approximation, which costs a third of the time or less.
    wear : float, optional
        Specific wear rate k of Archard's law: worn volume over normal force and way of slip
        [m³/(N m)]. It changes no contact; reports state the wear that the run would cause.

    Raises
    ------
    ValueError
        If the coefficient is not a positive number up to 10, coupling is neither true nor false, or
        the wear rate is not positive.

    Examples
    --------
    >>> Friction(0.3)
    Friction(coefficient=0.3, coupling=True, wear=None)
    """

    coefficient: float = field(metadata={"unit": "1"})
    coupling: bool = True
    wear: float | None = field(default=None, metadata={"unit": "m^3/(N m)"})

    def __post_init__(self) -> None:
        number = as_real(self.coefficient)
        if isinstance(self.coefficient, str) or (number is not None and number > LARGEST):
            raise ValueError(
                f"Friction: coefficient must be a plain number up to {LARGEST:g}, got "
                f"{self.coefficient!r}; write 0.3 for 30 %"
            )
        check_fields(self, "coefficient")
        if self.wear is not None:
            check_fields(self, "wear")
        if not isinstance(self.coupling, bool | np.bool_):
            raise ValueError(f"Friction: coupling must be true or false, got {self.coupling!r}")


def as_friction(given: Any) -> Friction | None:
    """Return the friction of an argument: a number is its coefficient."""
    if given is None or isinstance(given, Friction):
        return given
    if as_real(given) is None and not isinstance(given, str):
        raise ValueError(f"friction must be a Friction or a coefficient, got {given!r}")
    return Friction(given)
