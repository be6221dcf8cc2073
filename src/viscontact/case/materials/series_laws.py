"""Sections of series laws and the power law."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from viscontact.bodies import laws
from viscontact.bodies.laws import Law
from viscontact.case.materials.base import Medium
from viscontact.case.quantities import Compliance, Duration, Exponent, Fluidity, ModulusOrZero

_DATA = "compliances are deviatoric (Phi = 1/(2G)), shear (1/G) or uniaxial (1/E)"


class CreepSeries(Medium):
    """Creep compliance J_0 + sum J_i (1 - exp(-t/tau_i)) + fluidity t."""

    law: Literal["creep-series"]
    instant: Compliance = Field(description="J_0")
    amplitudes: list[Compliance] = Field(description="J_i")
    times: list[Duration] = Field(description="retardation times tau_i")
    fluidity: Fluidity = Field(default=0.0, description="rate of steady flow")
    data: Literal["deviatoric", "shear", "uniaxial"] = Field(description=_DATA)

    def build_law(self) -> Law:
        """Return the law, from deviatoric, shear or uniaxial compliances."""
        terms = (self.instant, self.amplitudes, self.times, self.fluidity)
        if self.data == "deviatoric":
            return laws.CreepSeries(*terms)
        if self.data == "shear":
            return laws.CreepSeries.from_shear(*terms)
        return laws.CreepSeries.from_uniaxial(*terms, **self._in_volume)


class RelaxationSeries(Medium):
    """Relaxation modulus G_inf + sum G_i exp(-t/tau_i), a Prony series."""

    law: Literal["relaxation-series"]
    equilibrium: ModulusOrZero = Field(
        description="modulus at long times, E or G as data says", examples=["100 MPa"]
    )
    moduli: list[ModulusOrZero] = Field(
        description="moduli of the terms, E or G as data says; with equilibrium they add up to the "
        "modulus at first",
        examples=[["50 MPa", "25 MPa"]],
    )
    times: list[Duration] = Field(
        description="relaxation times tau_i, one for each of moduli", examples=[["1 s", "100 s"]]
    )
    data: Literal["shear", "uniaxial"] = Field(
        description="moduli are shear (G) or uniaxial (E)", examples=["uniaxial"]
    )

    def build_law(self) -> Law:
        """Return the law, from shear or uniaxial moduli."""
        terms = (self.equilibrium, self.moduli, self.times)
        if self.data == "shear":
            return laws.RelaxationSeries.from_shear(*terms)
        return laws.RelaxationSeries.from_uniaxial(*terms, **self._in_volume)


class PowerLaw(Medium):
    """Creep compliance instant + compliance (t/reference_time)^exponent."""

    law: Literal["power-law"]
    compliance: Compliance = Field(description="creep compliance reached at the reference time")
    exponent: Exponent = Field(description="power of time")
    reference_time: Duration = Field(description="time at which the creep reaches compliance")
    instant: Compliance = Field(
        default=0.0, description="instantaneous compliance; without it the load cannot jump"
    )
    data: Literal["deviatoric", "shear", "uniaxial"] = Field(description=_DATA)

    def build_law(self) -> Law:
        """Return the law, from deviatoric, shear or uniaxial compliances."""
        terms = (self.compliance, self.exponent, self.reference_time, self.instant)
        if self.data == "deviatoric":
            return laws.PowerLaw(*terms)
        if self.data == "shear":
            return laws.PowerLaw.from_shear(*terms)
        return laws.PowerLaw.from_uniaxial(*terms, **self._in_volume)
