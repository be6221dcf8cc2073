"""Arguments of a heat balance, checked in their units."""

from __future__ import annotations

from typing import ClassVar

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.heating.cover import Cover
from viscontact.results.heating.rolling_body import RollingBody
from viscontact.units.numbers import positive


@dataclass(frozen=True)
class HeatArguments:
    """Numbers that a user gives for the cooling of a body, None where left out."""

    cooling: float
    ambient: float
    area: float | None = None
    thickness: float | None = None
    conductivity: float | None = None
    core_temperature: float | None = None
    heat_capacity: float | None = None
    density: float | None = None

    UNITS: ClassVar[dict[str, str]] = {
        "cooling": "W/(m2 K)",
        "ambient": "K",
        "area": "m2",
        "thickness": "m",
        "conductivity": "W/(m K)",
        "core_temperature": "K",
        "heat_capacity": "J/(kg K)",
        "density": "kg/m3",
    }

    def __post_init__(self) -> None:
        for name, unit in self.UNITS.items():
            value = getattr(self, name)
            if value is not None or name in ("cooling", "ambient"):
                object.__setattr__(self, name, positive(name, value, unit))
        if self.core_temperature is not None and self.conductivity is None:
            raise ValueError(
                "core_temperature: needs the conductivity of the cover, through which the core is "
                "felt; give conductivity, e.g. 0.2 W/(m K), or leave core_temperature out"
            )
        if (self.heat_capacity is None) != (self.density is None):
            given = "heat_capacity" if self.density is None else "density"
            missing, example = (
                ("density", "1150 kg/m³")
                if self.density is None
                else ("heat_capacity", "1800 J/(kg K)")
            )
            raise ValueError(
                f"{given}: the heating over time needs {missing}, too; give it, e.g. {example}"
            )

    @property
    def is_over_time(self) -> bool:
        """True if the heating over time is computed."""
        return self.density is not None

    def completed(self, body: RollingBody) -> HeatArguments:
        """Return them with area and thickness of the case where they are needed and left out."""
        area = body.area() if self.area is None else self.area
        thickness = body.thickness() if self.thickness is None else self.thickness
        needs = "conductivity" if self.conductivity is not None else "heat_capacity"
        if thickness is None and getattr(self, needs) is not None:
            raise ValueError(
                f"thickness: must be given with {needs}, in m, e.g. 8e-3: the body that heats up "
                f"({body.part}) has no layers and no thickness in the case"
            )
        given = {name: getattr(self, name) for name in self.UNITS}
        return HeatArguments(**given | {"area": area, "thickness": thickness})

    @property
    def cover(self) -> Cover:
        """The slab that conducts and stores the heat."""
        capacity = (self.heat_capacity or 1.0) * (self.density or 1.0)
        return Cover(
            self.cooling,
            self.ambient,
            self.thickness or 1.0,
            self.conductivity,
            self.core_temperature,
            capacity,
        )
