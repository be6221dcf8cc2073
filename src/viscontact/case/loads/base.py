"""Common keys of load sections: level, eccentricity, tilts."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property
from pathlib import Path
from typing import Any

from pydantic import Field, model_validator

from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.history import Control
from viscontact.case.loads.levels import APPROACH_EXAMPLE, Tilt
from viscontact.case.quantities import (
    AnyForce,
    LineLoad,
    Offset,
    Pressure,
    Section,
    StageStiffness,
)
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.formatting import format_quantity

#: Example of a mean pressure; that of a modulus would be too large.
PRESSURE_EXAMPLE = "2 MPa"

_FREE = "prescribed slope along {}, in place of the moment balance; free: no moment"


class Load(Section):
    """A force or an approach over time, its eccentricity, and prescribed tilts."""

    eccentricity_x: Offset = Field(default=0.0, description="position of the force along x")
    eccentricity_y: Offset = Field(default=0.0, description="position of the force along y")
    tilt_x: Tilt = Field(default=None, description=_FREE.format("x"))
    tilt_y: Tilt = Field(default=None, description=_FREE.format("y"))

    stage_stiffness: StageStiffness | None = Field(
        default=None,
        description="with adhesion: the approach is that of a stage on which the body hangs by a "
        "spring of this stiffness, as on a cantilever",
        examples=["0.2 N/m"],
    )

    @abstractmethod
    def build(self, extent: float = 1.0) -> LoadHistory:
        """Return the history; a mean pressure acts on an area [m²], a line load on a length [m]."""

    @cached_property
    def built(self) -> LoadHistory:
        """The history, built once, as is its file; levels per area or length act on 1 m² or 1 m."""
        return self.build()

    @property
    def table(self) -> Path | None:
        """File of the history, if there is one."""
        return None

    @property
    def is_by_pressure(self) -> bool:
        """True if a mean pressure is prescribed, which needs an area."""
        return getattr(self, "mean_pressure", None) is not None

    @property
    def is_by_length(self) -> bool:
        """True if a line load is prescribed, which needs a length."""
        return getattr(self, "line_load", None) is not None

    def refuse_pull(self) -> None:
        """Raise ValueError, with the key, for a force that pulls, which needs adhesion."""
        least = self.built.least_force
        if least < 0:
            raise ValueError(
                f"{self._force_key}: must be zero or more without adhesion, got "
                f"{format_quantity(least, 'N', 6)}; a negative force pulls: give e.g. 'adhesion: "
                "{work: 50 mJ/m2, range: 2 nm}'"
            )

    @property
    def _force_key(self) -> str:
        """Key of the force that pulls."""
        return "force"

    @property
    def _tail(self) -> dict[str, Any]:
        """Arguments that the file gives; the constructor has defaults for the others."""
        given = [name for name in Load.model_fields if name in self.model_fields_set]
        return {name: getattr(self, name) for name in given}

    @model_validator(mode="after")
    def _accepted(self) -> Load:
        # Errors of the constructor are reported among the problems of the file.
        _ = self.built
        return self


class Controlled(Load):
    """History whose level is a force or an approach."""

    force: AnyForce | None = Field(default=None, description="prescribed force")
    approach: Offset | None = Field(
        default=None,
        description="prescribed approach, in place of the force",
        examples=[APPROACH_EXAMPLE],
    )
    mean_pressure: Pressure | None = Field(
        default=None,
        description="on a periodic grid, in place of the force: force over the grid's area",
        examples=[PRESSURE_EXAMPLE],
    )

    line_load: LineLoad | None = Field(
        default=None,
        description="of a line contact, in place of the force: force per unit length",
    )

    def _height(self, extent: float) -> dict[Control, float]:
        per_extent = {"mean_pressure": self.mean_pressure, "line_load": self.line_load}
        given = [name for name, level in per_extent.items() if level is not None]
        if not given:
            return force_or_approach(self.approach, "force", self.force)
        for name in (*given[1:], "force", "approach"):
            if getattr(self, name) is not None:
                raise ValueError(f"{given[0]} and {name} exclude each other; give one of them")
        return {"force": (per_extent[given[0]] or 0.0) * extent}


def force_or_approach(approach: float | None, name: str, value: float | None) -> dict[Any, float]:
    """Argument that is given, the level by its name or the approach; both are refused."""
    if approach is not None and value is not None:
        raise ValueError(f"{name} and approach exclude each other; give one of them")
    if approach is not None:
        return {"approach": approach}
    if value is not None:
        return {name: value}
    force = DIMENSIONS["force"].example
    raise ValueError(
        f"{name} is missing; write e.g. '{name}: {force}', or 'approach: {APPROACH_EXAMPLE}'"
    )
