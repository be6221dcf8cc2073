"""Section of the physical ageing of a material."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from viscontact.bodies import laws
from viscontact.bodies.laws.ageing import LARGEST_EXPONENT
from viscontact.case.quantities import Duration, Section


class Ageing(Section):
    """Physical ageing (Struik): all times of the law grow as (1 + t/age)^exponent."""

    age: Duration = Field(
        description="at time 0 of the run, since the quench from above the glass transition; the "
        "law is that at this age",
        examples=["1 h"],
    )
    exponent: Annotated[float, Field(gt=0, le=LARGEST_EXPONENT)] = Field(
        description="shift rate, 0.7 to 1 for most glassy polymers", examples=[0.8]
    )

    def build(self) -> laws.Ageing:
        """Return the ageing."""
        return laws.Ageing(self.age, self.exponent)
