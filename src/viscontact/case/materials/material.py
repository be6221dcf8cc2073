"""Material section of a case file: any law, or a name of the library."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    ValidationError,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, ErrorDetails, PydanticCustomError

from viscontact.bodies.laws import Law
from viscontact.bodies.materials import library
from viscontact.bodies.materials.material import Material
from viscontact.case.data_file import DataFile
from viscontact.case.document import read_document, with_section
from viscontact.case.materials.base import Medium
from viscontact.case.materials.measured_laws import CardLaw, FromFile, TableLaw
from viscontact.case.materials.series_laws import CreepSeries, PowerLaw, RelaxationSeries
from viscontact.case.materials.spring_laws import (
    Burgers,
    Elastic,
    FractionalMaxwell,
    FractionalZener,
    Maxwell,
    Zener,
)
from viscontact.case.quantities import Section
from viscontact.case.section_choice import ChosenBy


class LawFile(FromFile):
    """A material section in a file, as a fit writes it; keys given here replace those in it."""

    law: Literal["file"]
    file: DataFile = Field(
        description="YAML or TOML with a section material, or only its keys",
        examples=["law.yaml"],
    )

    @cached_property
    def section(self) -> Medium:
        """The section of the file, with the keys given here."""
        path = Path(self.file)
        document = with_section(read_document(path))
        section = document.data.get("material")
        if not isinstance(section, dict):
            raise ValueError(f"file: {path.name} has no section material: with a law")
        shift = section.get("shift")
        if "file" in section or (isinstance(shift, dict) and "file" in shift):
            raise ValueError(f"file: {path.name} names another file; write its keys into the case")
        try:
            return MaterialAlone.model_validate({"material": section | self._keys}).material
        except ValidationError as error:
            found = "; ".join(map(_problem, error.errors()))
            raise ValueError(f"file: {path.name}: {found}") from error

    def build_law(self) -> Law:
        """Return the law of the file."""
        return self.section.built.law

    def build(self) -> Material:
        """Return the material of the file, at the run's temperature."""
        if self.shift is None:
            return self.section.built
        if self.section.shift is not None:
            raise ValueError(f"shift: is given in {Path(self.file).name}; leave it out")
        return self._at_temperature(self.section.built, self.shift.build())

    @property
    def own_scale(self) -> float:
        """1, as the material of the file has its scale."""
        return 1.0

    @property
    def own_hardness(self) -> None:
        """None, as the material of the file has its hardness."""
        return

    @property
    def own_temperature(self) -> float | None:
        """Temperature of the material, given here or in the file [K]."""
        return self.section.own_temperature if self.temperature is None else self.temperature

    @property
    def lacks_temperature(self) -> bool:
        """True for a shift, here or in the file, without the temperature that a run must give."""
        return super().lacks_temperature or self.section.lacks_temperature

    @property
    def _keys(self) -> dict[str, Any]:
        """Keys that replace those of the file, as in a case file."""
        units = {"bulk_modulus": "Pa", "measured_until": "s", "thickness": "m"}
        units |= {"yield_stress": "Pa", "fatigue_limit": "Pa"}
        if self.shift is None:
            units["temperature"] = "K"
        given = {
            key: f"{value!r} {unit}"
            for key, unit in units.items()
            if (value := getattr(self, key)) is not None
        }
        plain: dict[str, Any] = {"poisson_ratio": self.poisson_ratio, "warning": self.warning}
        plain |= {key: getattr(self, key) for key in ("scale", "shore_a", "shore_d")}
        if self.ageing is not None:
            plain["ageing"] = {"age": f"{self.ageing.age!r} s", "exponent": self.ageing.exponent}
        return given | {key: value for key, value in plain.items() if value is not None}


def _problem(error: ErrorDetails) -> str:
    """Return an error in a file of the material as its key and reason."""
    # The path begins with `material` and the name of the law, which are not keys of the problem.
    key = ".".join(map(str, error["loc"][2:]))
    why = str(error["ctx"]["error"]) if error["type"] == "value_error" else error["msg"]
    return f"{key}: {why}" if key else why


#: Keys of which a material has one.
_VOLUME = {"poisson_ratio", "bulk_modulus"}


def from_library(given: Any) -> Any:
    """Return a section with its law: that of a file, or of a name, where given keys replace it."""
    if isinstance(given, dict) and "file" in given and "law" not in given:
        return {**given, "law": "file"}
    keys = dict(given) if isinstance(given, dict) and "law" not in given else {}
    name = keys.pop("material", None) if keys else given
    if not isinstance(name, str):
        return given
    if name not in library.names():
        raise PydanticCustomError("library", "{why}", {"why": library.unknown_name(name)})
    entry = library.entry(name)
    # A run beyond the measured range issues a warning.
    section = dict(entry.material)
    if entry.measured is not None:
        section["measured_until"] = f"{entry.measured[1]!r} s"
    if entry.limits:
        section["measured_range"] = dict(entry.limits)
    if not _VOLUME.isdisjoint(keys):
        section = {key: value for key, value in section.items() if key not in _VOLUME}
    return section | keys


class OrName:
    """Schema annotation that allows the name of a shipped material in place of the section."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        names = {"enum": list(library.names())}
        changed = {"type": "object", "properties": {"material": names}, "required": ["material"]}
        return {"anyOf": [names, {**changed, "x-shorthand": True}, handler(schema)]}


Laws = (
    Elastic
    | Maxwell
    | Zener
    | Burgers
    | CreepSeries
    | RelaxationSeries
    | PowerLaw
    | FractionalMaxwell
    | FractionalZener
    | TableLaw
    | CardLaw
    | LawFile
)

AnyMaterial = Annotated[Annotated[Laws, ChosenBy("law")], BeforeValidator(from_library), OrName()]


class MaterialAlone(Section):
    """Case file of which only the material is read."""

    model_config = ConfigDict(extra="ignore", frozen=True, strict=True, defer_build=True)

    material: AnyMaterial
