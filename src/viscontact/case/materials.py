"""The `material` and `indenter_material` of a case file."""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from viscontact import laws
from viscontact.case.library import MATERIALS
from viscontact.case.quantities import (
    Compliance,
    Duration,
    Fluidity,
    Modulus,
    ModulusOrZero,
    PoissonRatio,
    Section,
    Viscosity,
)
from viscontact.laws import SeriesLaw
from viscontact.material import Material


class Medium(Section):
    """A creep law in shear, and how the body gives in volume."""

    poisson_ratio: PoissonRatio | None = Field(default=None, description="constant in time")
    bulk_modulus: Modulus | None = Field(
        default=None, description="elastic; Poisson's ratio then varies in time"
    )
    measured_until: Duration | None = Field(
        default=None, description="last time the law is known for; a run that goes beyond warns"
    )

    @abstractmethod
    def law_noun(self) -> SeriesLaw:
        """Return the creep law that is described."""

    def noun(self) -> Material:
        """Return the material that is described."""
        if (self.poisson_ratio is None) == (self.bulk_modulus is None):
            raise ValueError(
                "give poisson_ratio (e.g. 0.38) or bulk_modulus (e.g. '4 GPa'), and only one"
            )
        return Material(
            self.law_noun(),
            self.poisson_ratio,
            bulk_modulus=self.bulk_modulus,
            measured_until=self.measured_until,
        )

    @property
    def _in_volume(self) -> dict[str, Any]:
        return {"poisson_ratio": self.poisson_ratio, "bulk_modulus": self.bulk_modulus}

    @model_validator(mode="after")
    def _accepted(self) -> Medium:
        # What the nouns refuse belongs among the problems of the file.
        self.noun()
        return self


class Springs(Medium):
    """A law of springs and dashpots, by shear moduli, or with `data: uniaxial` by tensile ones."""

    built: ClassVar[Any]  # the law's class; from_shear and from_uniaxial differ in arguments

    shear_modulus: Modulus | None = None
    youngs_modulus: Modulus | None = Field(
        default=None, description="instead of shear_modulus, with data: uniaxial"
    )
    data: Literal["shear", "uniaxial"] | None = Field(
        default=None, description="what all moduli and viscosities mean; shear when left out"
    )

    def law_noun(self) -> SeriesLaw:
        """Return the law, from shear or from tensile moduli."""
        others = {name: getattr(self, name) for name in self._others()}
        if self._is_uniaxial():
            law = self.built.from_uniaxial(self.youngs_modulus, **others, **self._in_volume)
        else:
            law = self.built.from_shear(self.shear_modulus, **others)
        assert isinstance(law, SeriesLaw)
        return law

    def _is_uniaxial(self) -> bool:
        uniaxial = self.data == "uniaxial"
        wanted, unwanted = ("youngs_modulus", "shear_modulus")[:: 1 if uniaxial else -1]
        if getattr(self, unwanted) is not None:
            hint = "" if uniaxial else "; tensile moduli need data: uniaxial"
            raise ValueError(
                f"{unwanted} does not go with data: {self.data or 'shear'}; give {wanted}{hint}"
            )
        if getattr(self, wanted) is None:
            raise ValueError(f"{wanted} is missing; write e.g. '{wanted}: 1800 MPa'")
        return uniaxial

    def _others(self) -> list[str]:
        shared = {*Springs.model_fields, "law"}
        return [name for name in type(self).model_fields if name not in shared]


class Elastic(Springs):
    """A spring."""

    built = laws.Elastic

    law: Literal["elastic"]


class Maxwell(Springs):
    """A spring and a dashpot in series."""

    built = laws.Maxwell

    law: Literal["maxwell"]
    viscosity: Viscosity


class Zener(Springs):
    """A spring in series with a Kelvin unit, the standard linear solid."""

    built = laws.Zener

    law: Literal["zener"]
    delayed_modulus: Modulus
    viscosity: Viscosity


class Burgers(Springs):
    """A Maxwell and a Kelvin unit in series."""

    built = laws.Burgers

    law: Literal["burgers"]
    viscosity: Viscosity
    delayed_modulus: Modulus
    delayed_viscosity: Viscosity


class CreepSeries(Medium):
    """Creep compliance J_0 + sum J_i (1 - exp(-t/tau_i)) + fluidity t."""

    law: Literal["creep-series"]
    instant: Compliance = Field(description="J_0")
    amplitudes: list[Compliance] = Field(description="J_i")
    times: list[Duration] = Field(description="retardation times tau_i")
    fluidity: Fluidity = 0.0
    data: Literal["deviatoric", "shear", "uniaxial"] = Field(
        description="compliances are deviatoric (Phi = 1/(2G)), shear (1/G) or uniaxial (1/E)"
    )

    def law_noun(self) -> SeriesLaw:
        """Return the law, whatever test the compliances are from."""
        terms = (self.instant, self.amplitudes, self.times, self.fluidity)
        if self.data == "deviatoric":
            return laws.CreepSeries(*terms)
        if self.data == "shear":
            return laws.CreepSeries.from_shear(*terms)
        return laws.CreepSeries.from_uniaxial(*terms, **self._in_volume)


class RelaxationSeries(Medium):
    """Relaxation modulus G_inf + sum G_i exp(-t/tau_i), a Prony series."""

    law: Literal["relaxation-series"]
    equilibrium: ModulusOrZero = Field(description="G_inf")
    moduli: list[ModulusOrZero] = Field(description="G_i")
    times: list[Duration] = Field(description="relaxation times tau_i")
    data: Literal["shear", "uniaxial"] = Field(description="moduli are shear (G) or uniaxial (E)")

    def law_noun(self) -> SeriesLaw:
        """Return the law, from shear or from tensile moduli."""
        terms = (self.equilibrium, self.moduli, self.times)
        if self.data == "shear":
            return laws.RelaxationSeries.from_shear(*terms)
        return laws.RelaxationSeries.from_uniaxial(*terms, **self._in_volume)


def _from_library(given: Any) -> Any:
    if not isinstance(given, str):
        return given
    if given not in MATERIALS:
        names = ", ".join(MATERIALS)
        why = f"no shipped material is called {given!r}; there are {names}"
        raise PydanticCustomError("library", "{why}", {"why": why})
    return MATERIALS[given]


class _OrName:
    """Tells editors that the name of a shipped material may stand in the section's place."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {"anyOf": [{"enum": list(MATERIALS)}, handler(schema)]}


AnyMaterial = Annotated[
    Annotated[
        Elastic | Maxwell | Zener | Burgers | CreepSeries | RelaxationSeries,
        Field(discriminator="law"),
    ],
    BeforeValidator(_from_library),
    _OrName(),
]
