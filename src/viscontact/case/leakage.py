"""Section `leakage` of a case file."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from viscontact.bodies.grid import Grid
from viscontact.case.quantities import POSITIVE, Section, WithUnit

_Length = Annotated[float, WithUnit("length", POSITIVE)]
_Pressure = Annotated[float, WithUnit("pressure", POSITIVE)]
_Viscosity = Annotated[float, WithUnit("viscosity", POSITIVE)]


class Leakage(Section):
    """Fluid that leaks through the gap, at the instants whose fields are kept."""

    viscosity: _Viscosity = Field(description="of the fluid", examples=["1 mPa s"])
    pressure_difference: _Pressure | None = Field(
        default=None, description="of the fluid across the seal", examples=["1 bar"]
    )
    along: Literal["x", "y", "both"] = Field(default="x", description="direction of the flow")
    ends: Literal["period", "pressure"] | None = Field(
        default=None,
        description="pressure that falls evenly over a period, or that is given on both outer "
        "faces; by default the period, if the grid has one along the flow",
    )
    length: _Length | None = Field(
        default=None, description="of the seal along the flow; that of the grid when left out"
    )
    width: _Length | None = Field(
        default=None, description="of the seal across the flow; that of the grid when left out"
    )
    gas: _Pressure | None = Field(
        default=None,
        description="absolute pressure at the outlet of a gas; a liquid when left out",
        examples=["1 bar"],
    )

    @property
    def settings(self) -> dict[str, Any]:
        """The given settings in SI units, by the arguments in Python."""
        return {name: value for name, value in self.model_dump().items() if value is not None}

    def require_fit(self, fields: object, grid: Grid | None) -> None:
        """Raise ValueError where the run keeps no gap, or the grid has no period for the flow."""
        if fields == "none":
            raise ValueError(
                "leakage: it needs the gap, which is kept with the fields only; write "
                "'fields: all', or a list of instants, under output"
            )
        if self.gas is not None and self.pressure_difference is None:
            raise ValueError("leakage.gas: it needs a pressure_difference; add one")
        axes = "xy" if self.along == "both" else self.along
        for axis in axes if self.ends == "period" else "":
            if grid is None or not grid.periodic["xy".index(axis)]:
                raise ValueError(
                    f"leakage.ends: the grid is not periodic along {axis}; leave it out, or write "
                    "'pressure'"
                )
