"""What every material of a case file says besides its law: volume, temperature, range."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import Field, model_validator

from viscontact.case.materials.shifts import AnyShift
from viscontact.case.quantities import (
    Duration,
    Length,
    Modulus,
    PoissonRatio,
    Section,
    Temperature,
)
from viscontact.laws import Law, Shift
from viscontact.materials.material import Material


class Medium(Section):
    """A creep law in shear, and how the body gives in volume."""

    poisson_ratio: PoissonRatio | None = Field(default=None, description="constant in time")
    bulk_modulus: Modulus | None = Field(
        default=None, description="elastic; Poisson's ratio then varies in time"
    )
    measured_until: Duration | None = Field(
        default=None, description="last time the law is known for; a run that goes beyond warns"
    )
    thickness: Length | None = Field(
        default=None,
        description="of the body; it is computed as a half-space, and a run whose contact has a "
        "half width beyond a fifth of it warns",
    )
    temperature: Temperature | None = Field(
        default=None, description="of the run; the law is shifted to it by shift"
    )
    shift: AnyShift | None = Field(
        default=None, description="how all times of the law change with temperature"
    )

    @abstractmethod
    def build_law(self) -> Law:
        """Return the creep law that is described."""

    def build(self) -> Material:
        """Return the material that is described, at its temperature."""
        if (self.poisson_ratio is None) == (self.bulk_modulus is None):
            raise ValueError(
                "give poisson_ratio (e.g. 0.38) or bulk_modulus (e.g. '4 GPa'), and only one"
            )
        material = Material(self.build_law(), self.poisson_ratio, bulk_modulus=self.bulk_modulus)
        return self._at_temperature(material, self.shift.build() if self.shift else None)

    @property
    def files(self) -> Mapping[tuple[str, ...], Path]:
        """Files that the material is read from, by the keys that name them."""
        found = {} if self.shift is None else self.shift.files
        return {("shift", *key): path for key, path in found.items()}

    @property
    def notes(self) -> tuple[str, ...]:
        """What stands in those files and is not used."""
        return ()

    def _at_temperature(self, material: Material, shift: Shift | None) -> Material:
        """Return the material at the run's temperature, with what is said of its range."""
        factor = 1.0
        if self.temperature is not None:
            if shift is None:
                raise ValueError(
                    "temperature: needs a shift, e.g. '{kind: wlf, reference_temperature: "
                    "25 degC, c1: 17.44, c2: 51.6 K}'"
                )
            factor = shift.factor(self.temperature)
        elif self.shift is not None:
            raise ValueError("shift: needs a temperature to shift to, e.g. 'temperature: 60 degC'")
        until = self.measured_until
        return Material(
            material.law if factor == 1.0 else material.law.slowed(factor),
            material.poisson_ratio,
            bulk_modulus=material.bulk_modulus,
            # What is known of the law as it is written shifts with it.
            measured_until=None if until is None else factor * until,
            thickness=self.thickness,
        )

    @property
    def _in_volume(self) -> dict[str, Any]:
        return {"poisson_ratio": self.poisson_ratio, "bulk_modulus": self.bulk_modulus}

    @model_validator(mode="after")
    def _accepted(self) -> Medium:
        # What the nouns refuse belongs among the problems of the file.
        self.build()
        return self
