"""Section of the range of the tests that a law rests on."""

from __future__ import annotations

from pydantic import Field

from viscontact.bodies.materials.measured_range import MeasuredRange as Range
from viscontact.case.quantities import Instant, Modulus, Section, Strain, Temperature


class MeasuredRange(Section):
    """Range of the tests; what their source does not state is left out."""

    strain: Strain | None = Field(default=None, description="largest one of a uniaxial test")
    shear_strain: Strain | None = Field(default=None, description="largest one of a test in shear")
    stress: Modulus | None = Field(default=None, description="largest one of a uniaxial test")
    first: Instant = Field(
        default=0.0, description="first time after a change of load; 0 s: also at once"
    )
    temperatures: list[Temperature] | None = Field(
        default=None, description="lowest and highest", min_length=2, max_length=2
    )

    def build(self) -> Range:
        """Return the range."""
        pair = self.temperatures and (self.temperatures[0], self.temperatures[1])
        return Range(self.strain, self.shear_strain, self.stress, self.first, pair or None)
