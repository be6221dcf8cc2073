"""Section `friction` of a case file."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from viscontact.bodies import friction
from viscontact.bodies.friction import LARGEST
from viscontact.case.quantities import POSITIVE, Section, WithUnit
from viscontact.units.numbers import as_real


def _no_percentage(given: Any) -> Any:
    """Refuse what is a percentage, or too large for anything else."""
    number = as_real(given)
    if (isinstance(given, str) and "%" in given) or (number is not None and number > LARGEST):
        raise ValueError(
            f"must be a plain number up to {LARGEST:g}, got {given!r}; write 0.3 for 30 %"
        )
    return given


class FrictionSection(Section):
    """Coulomb friction between the bodies."""

    coefficient: Annotated[float, Field(gt=0), BeforeValidator(_no_percentage)] = Field(
        description="coefficient of friction", examples=[0.3]
    )
    coupling: bool = Field(
        default=True,
        description="false: neglect that tractions change the pressure and pressure moves the "
        "surface along itself; exact for bodies of the same material and of Poisson's ratio 1/2",
    )

    wear: Annotated[float, WithUnit("wear rate", POSITIVE)] | None = Field(
        default=None,
        description="worn volume over normal force and way of slip (Archard), for the wear that "
        "reports state",
        examples=["1e-7 mm^3/(N m)"],
    )

    @property
    def built(self) -> friction.Friction:
        """The friction."""
        return friction.Friction(self.coefficient, self.coupling, self.wear)
