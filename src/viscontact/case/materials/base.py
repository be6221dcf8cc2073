"""Common keys of material sections: volume, temperature, ageing, known range."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from viscontact.bodies.laws import Law, Shift
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.hardness import HardnessEstimate, modulus_from_shore
from viscontact.bodies.materials.material import Material
from viscontact.case.materials.ageing import Ageing
from viscontact.case.materials.measured_range import MeasuredRange
from viscontact.case.materials.shifts import AnyShift
from viscontact.case.quantities import (
    Duration,
    Length,
    Modulus,
    Offset,
    PoissonRatio,
    Scale,
    Section,
    ShoreA,
    ShoreD,
    Temperature,
)

#: What a body that ends lacks without one of its keys.
INCOMPLETE_END = (
    "a body that ends has a length and ends; write e.g. 'length: 60 mm' and 'ends: [free, null]', "
    "or leave both out"
)


def _not_over_time(given: Any) -> Any:
    """Refuse a section, which describes a temperature over time."""
    if isinstance(given, dict):
        why = (
            "a temperature over time is that of all bodies; write it at the top of the case, and "
            "leave this one out"
        )
        raise PydanticCustomError("quantity", "{why}", {"why": why})
    return given


#: Kind of an end of a body, and of both its ends.
End = Literal["free", "held"]
Ends = End | Annotated[list[End | None], Field(min_length=2, max_length=2)]


class Medium(Section):
    """Creep law in shear, and the behaviour in volume."""

    poisson_ratio: PoissonRatio | None = Field(default=None, description="constant in time")
    bulk_modulus: Modulus | None = Field(
        default=None, description="elastic; Poisson's ratio then varies in time"
    )
    measured_until: Duration | None = Field(
        default=None,
        description="last time for which the law is known; a longer run issues a warning",
    )
    warning: str | None = Field(
        default=None,
        description="warning about the law, such as that of a fit which misses its data; every run "
        "issues it",
    )
    scale: Scale | None = Field(
        default=None,
        description="factor on all moduli and viscosities of the law, by which its compliance is "
        "divided; a bulk modulus stays as it is given",
        examples=[1.5],
    )
    shore_a: ShoreA | None = Field(
        default=None,
        description="hardness of a rubber, from which its stiffness is estimated: the modulus of "
        "an elastic law, or that of a law that creeps 3 s after a step, which is scaled to it; "
        "every run warns of the spread",
        examples=[70],
    )
    shore_d: ShoreD | None = Field(
        default=None, description="likewise, of a hard elastomer", examples=[45]
    )
    thickness: Length | None = Field(
        default=None,
        description="of the body; it is computed as a half-space, and a run whose contact has a "
        "half width beyond a fifth of it warns",
    )
    length: Length | None = Field(
        default=None,
        description="of the body along x, where it ends; goes with ends. That of a roller when "
        "left out under indenter_material",
    )
    centre: Offset | None = Field(
        default=None, description="position x of the middle of a body that ends; 0 when left out"
    )
    ends: Ends | None = Field(
        default=None,
        description="planes across x at which the body ends: free of stress, or held by a wall "
        "without friction; one kind for both, or a pair, that at -x first, where null goes on",
        examples=[["free", None]],
    )
    temperature: Annotated[Temperature, BeforeValidator(_not_over_time)] | None = Field(
        default=None,
        description="temperature of this material, to which its shift takes the law; write that of "
        "all bodies at the top of the case",
    )
    shift: AnyShift | None = Field(
        default=None, description="change of all times of the law with temperature"
    )
    ageing: Ageing | None = Field(
        default=None, description="physical ageing of a glassy polymer from time 0 of the run on"
    )
    yield_stress: Modulus | None = Field(
        default=None,
        description="in tension, or another stress that the material bears; the result on a "
        "half-space, or of the pressed body, is compared with it, unless allowable has the value",
        examples=["250 MPa"],
    )
    fatigue_limit: Modulus | None = Field(
        default=None,
        description="stress that it bears under loads that repeat: in cycles, or of a moving body",
        examples=["120 MPa"],
    )
    measured_range: MeasuredRange | None = Field(
        default=None,
        description="strain, stress, first time and temperatures of the tests; a run beyond them "
        "issues a warning",
    )

    @abstractmethod
    def build_law(self) -> Law:
        """Return the creep law."""

    @cached_property
    def body(self) -> Material | Body:
        """The material, or a body of it that ends."""
        if self.ends is None:
            return self.built
        assert self.length is not None  # refused otherwise, or that of a roller
        return self.body_of(self.length)

    def body_of(self, length: float) -> Body:
        """A body of the material that ends, of a length along x [m]."""
        return Body(self.built, length, centre=self.centre or 0.0, ends=self.ends or "free")

    @cached_property
    def built(self) -> Material:
        """The material, built once: its file is read once."""
        return self.build()

    def build(self) -> Material:
        """Return the material at the temperature of the run."""
        if (self.poisson_ratio is None) == (self.bulk_modulus is None):
            raise ValueError(
                "give poisson_ratio (e.g. 0.38) or bulk_modulus (e.g. '4 GPa'), and only one"
            )
        material = Material(
            self.build_law(),
            self.poisson_ratio,
            bulk_modulus=self.bulk_modulus,
            measured_until=self.fitted_until,
            notes=self.notes,
            warning=self.warning or self.misfit,
            measured_range=self.measured_range.build() if self.measured_range else None,
            ageing=self.ageing.build() if self.ageing else None,
        )
        return self._at_temperature(material, self.shift.build() if self.shift else None)

    @property
    def own_temperature(self) -> float | None:
        """Temperature that the section gives for this material [K]."""
        return self.temperature

    @property
    def own_scale(self) -> float:
        """Factor on the stiffness of the law that the section describes."""
        return 1.0 if self.scale is None else self.scale

    @property
    def own_hardness(self) -> HardnessEstimate | None:
        """Modulus that the hardness of the section stands for."""
        if self.shore_a is not None:
            return modulus_from_shore(self.shore_a, "A")
        return None if self.shore_d is None else modulus_from_shore(self.shore_d, "D")

    @property
    def lacks_temperature(self) -> bool:
        """True for a shift without the temperature that a run must give."""
        return self.shift is not None and not self.shift.is_referred and self.temperature is None

    @property
    def files(self) -> Mapping[tuple[str, ...], Path]:
        """Files of the material, by the keys that name them."""
        found = {} if self.shift is None else self.shift.files
        return {("shift", *key): path for key, path in found.items()}

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on contents of the files that are not used."""
        return ()

    @property
    def misfit(self) -> str | None:
        """Warning of a fit to the file of the law that misses it."""
        return None

    @property
    def fitted_until(self) -> float | None:
        """Last time of the data that the law was fitted to [s]; None where it was not."""
        return None

    def _at_temperature(self, material: Material, shift: Shift | None) -> Material:
        """Return the scaled material at the temperature of the run, with its known range."""
        material = material.scaled(self.own_scale)
        if self.own_hardness is not None:
            material = material.with_hardness(self.own_hardness)
        names = ("measured_until", "thickness", "yield_stress", "fatigue_limit")
        keys = {name: getattr(self, name) for name in names}
        given: dict[str, Any] = {key: value for key, value in keys.items() if value is not None}
        if self.temperature is None:
            return replace(material, shift=shift, **given)
        if shift is None:
            raise ValueError(
                "temperature: needs a shift, e.g. '{kind: wlf, reference_temperature: "
                "25 degC, c1: 17.44, c2: 51.6 K}'"
            )
        # The given range is that of the unshifted law.
        return replace(material, shift=shift, **given).at(self.temperature)

    @property
    def _in_volume(self) -> dict[str, Any]:
        return {"poisson_ratio": self.poisson_ratio, "bulk_modulus": self.bulk_modulus}

    @model_validator(mode="after")
    def _accepted(self) -> Medium:
        # Errors of the constructors are reported among the problems of the file.
        if self.ends is None and self.length is not None:
            raise ValueError(f"ends: {INCOMPLETE_END}")
        given = [key for key in ("scale", "shore_a", "shore_d") if getattr(self, key) is not None]
        if len(given) > 1:
            raise ValueError(f"give {' or '.join(given)}: each determines the stiffness of the law")
        if self.centre is not None and self.ends is None:
            raise ValueError("centre: is that of a body that ends; give 'length' and 'ends', too")
        _ = self.built if self.ends is None else self.body_of(self.length or 1.0)
        return self
