"""Friction between the bodies: Coulomb's law."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from viscontact.units.numbers import as_real, check_fields


@dataclass(frozen=True)
class Friction:
    """Coulomb friction: a cell under the pressure p carries tractions up to μ p, then it slips.

    Parameters
    ----------
    coefficient : float
        Coefficient of friction μ, positive [-].
    coupling : bool, optional
        False: normal contact does not feel tractions along the surface, and the surface does not
        move along itself under pressure. That is exact for two bodies of the same material, and for
        bodies of Poisson's ratio 1/2 where the other is rigid or the same.

    Raises
    ------
    ValueError
        If the coefficient is not a positive number, or coupling is neither true nor false.

    Examples
    --------
    >>> Friction(0.3)
    Friction(coefficient=0.3, coupling=True)
    """

    coefficient: float = field(metadata={"unit": "1"})
    coupling: bool = True

    def __post_init__(self) -> None:
        if isinstance(self.coefficient, str) and self.coefficient.strip().endswith("%"):
            raise ValueError(
                f"Friction: coefficient must be a plain number, got {self.coefficient!r}; write "
                "0.3 for 30 %"
            )
        check_fields(self, "coefficient")
        if not isinstance(self.coupling, bool | np.bool_):
            raise ValueError(f"Friction: coupling must be true or false, got {self.coupling!r}")


def as_friction(given: Friction | float | None) -> Friction | None:
    """Return the friction of an argument: a number is its coefficient."""
    if given is None or isinstance(given, Friction):
        return given
    if as_real(given) is None:
        raise ValueError(f"friction must be a Friction or a coefficient, got {given!r}")
    return Friction(given)
