"""Section `adhesion` of a case file."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from viscontact.bodies import adhesion
from viscontact.case.quantities import POSITIVE, Section, WithUnit


class AdhesionSection(Section):
    """Adhesion between the bodies."""

    work: Annotated[float, WithUnit("work of adhesion", POSITIVE)] = Field(
        description="work that separating the surfaces takes, per area"
    )
    range: Annotated[float, WithUnit("length", POSITIVE)] | None = Field(
        default=None,
        description="range of the attraction, work over strength; when range and strength are left "
        "out, the shortest one that the cells resolve, for elastic bodies",
        examples=["2 nm"],
    )
    strength: Annotated[float, WithUnit("pressure", POSITIVE)] | None = Field(
        default=None,
        description="largest attraction, in place of the range",
        examples=["25 MPa"],
    )
    law: Literal["exponential", "dugdale", "lennard-jones"] = Field(
        default="exponential", description="attraction over the gap"
    )

    @property
    def built(self) -> adhesion.Adhesion:
        """The adhesion."""
        return adhesion.Adhesion(self.work, range=self.range, strength=self.strength, law=self.law)
