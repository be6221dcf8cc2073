"""Sections of laws of springs, dashpots and spring-pots."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

from pydantic import Field

from viscontact.bodies import laws
from viscontact.bodies.laws import Law
from viscontact.case.materials.base import Medium
from viscontact.case.quantities import Duration, Exponent, Modulus, ModulusOrZero, Viscosity


class Springs(Medium):
    """Law of elements with shear moduli, or with uniaxial ones beside `youngs_modulus`."""

    law_name: ClassVar[str]  # of its class in `laws`, which is imported when it is built

    shear_modulus: Modulus | None = Field(default=None, description="instantaneous shear modulus")
    youngs_modulus: Modulus | None = Field(
        default=None, description="instead of shear_modulus; all other moduli are then uniaxial"
    )
    data: Literal["shear", "uniaxial"] | None = Field(
        default=None,
        description="kind of all moduli and viscosities; uniaxial beside youngs_modulus, and shear "
        "beside shear_modulus, when left out",
    )

    def build_law(self) -> Law:
        """Return the law, from shear or uniaxial moduli."""
        others = {name: getattr(self, name) for name in self._other_keys()}
        law_class: Any = getattr(laws, self.law_name)  # their methods differ in arguments
        if self._is_uniaxial():
            law = law_class.from_uniaxial(self.youngs_modulus, **others, **self._in_volume)
        else:
            law = law_class.from_shear(self.shear_modulus, **others)
        assert isinstance(law, Law)
        return law

    def _is_uniaxial(self) -> bool:
        if self.shear_modulus is not None and self.youngs_modulus is not None:
            raise ValueError("give shear_modulus or youngs_modulus, and only one")
        uniaxial = self.data == "uniaxial" or (
            self.data is None and self.youngs_modulus is not None
        )
        wanted, unwanted = ("youngs_modulus", "shear_modulus")[:: 1 if uniaxial else -1]
        if getattr(self, unwanted) is not None:
            raise ValueError(f"{unwanted} does not go with data: {self.data}; give {wanted}")
        if getattr(self, wanted) is None:
            other = ", or 'youngs_modulus: 1800 MPa'" if self.data is None else ""
            raise ValueError(f"{wanted} is missing; write e.g. '{wanted}: 1800 MPa'{other}")
        return uniaxial

    def _other_keys(self) -> list[str]:
        shared = {*Springs.model_fields, "law"}
        return [name for name in type(self).model_fields if name not in shared]


class Elastic(Springs):
    """A spring."""

    law_name = "Elastic"

    law: Literal["elastic"]

    def build_law(self) -> Law:
        """Return the law, from a modulus or from the estimate of a hardness."""
        if self.own_hardness is None:
            return super().build_law()
        for key in ("youngs_modulus", "shear_modulus"):
            if getattr(self, key) is not None:
                raise ValueError(f"{key}: a hardness stands for the modulus; give one of them")
        return laws.Elastic.from_uniaxial(self.own_hardness.youngs_modulus, **self._in_volume)


class Maxwell(Springs):
    """A spring and a dashpot in series."""

    law_name = "Maxwell"

    law: Literal["maxwell"]
    viscosity: Viscosity = Field(description="of the dashpot")


class Zener(Springs):
    """A spring in series with a Kelvin unit, the standard linear solid."""

    law_name = "Zener"

    law: Literal["zener"]
    delayed_modulus: Modulus = Field(description="of the Kelvin unit's spring")
    viscosity: Viscosity = Field(description="of the Kelvin unit's dashpot")


class Burgers(Springs):
    """A Maxwell and a Kelvin unit in series."""

    law_name = "Burgers"

    law: Literal["burgers"]
    viscosity: Viscosity = Field(description="of the Maxwell unit, the steady flow")
    delayed_modulus: Modulus = Field(description="of the Kelvin unit's spring")
    delayed_viscosity: Viscosity = Field(description="of the Kelvin unit's dashpot")


class FractionalMaxwell(Springs):
    """A spring (or a spring-pot) in series with a spring-pot."""

    law_name = "FractionalMaxwell"

    law: Literal["fractional-maxwell"]
    time: Duration = Field(description="time at which both elements have the same strain")
    exponent: Exponent = Field(description="of the spring-pot: 0 is a spring, 1 a dashpot")
    second_exponent: float = Field(
        default=0.0, ge=0, lt=1, description="of the other element; a spring when left out"
    )


class FractionalZener(Springs):
    """The standard linear solid with a spring-pot in place of its dashpot."""

    law_name = "FractionalZener"

    law: Literal["fractional-zener"]
    equilibrium_modulus: ModulusOrZero = Field(
        examples=["100 MPa"],
        description="modulus at long times, of the same kind as the other one",
    )
    time: Duration = Field(description="relaxation time")
    exponent: Exponent = Field(description="of the spring-pot: 0 is a spring, 1 a dashpot")
