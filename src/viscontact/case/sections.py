"""The whole case file: which sections there are, and their JSON schema."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field, model_validator

from viscontact.case.indenters.shapes import Shapes
from viscontact.case.loads.load import AnyLoad
from viscontact.case.materials.material import AnyMaterial
from viscontact.case.quantities import Section
from viscontact.case.time_grid_output import Cells, Output, Time
from viscontact.grid import Grid
from viscontact.loads import LoadHistory
from viscontact.units.dimensions import DIMENSIONS


class CaseFile(Section):
    """A viscontact case: what is pressed on what, how, for how long."""

    title: str = Field(default="", description="what tables, figures and reports call the run")
    indenter: Shapes
    material: AnyMaterial = Field(description="the half-space")
    indenter_material: AnyMaterial | None = Field(
        default=None, description="the pressed body's material; rigid when left out"
    )
    load: AnyLoad = Field(description="what presses, over time")
    time: Time = Field(description="the instants that are computed")
    grid: Cells | None = Field(default=None, description="an automatic grid when left out")
    output: Output = Field(default=Output(), description="what is kept of them")
    tolerance: Annotated[float, Field(ge=1e-13, le=1e-2)] = Field(
        default=1e-6, description="relative error of pressure and balances at every step"
    )

    @model_validator(mode="after")
    def _accepted(self) -> CaseFile:
        if self.load.is_by_pressure and not (self.grid and self.grid.periodic):
            raise ValueError(
                "load.mean_pressure: it goes with a periodic grid, whose area makes a force of it; "
                "write 'periodic: true' under grid, or give the force"
            )
        return self

    def history(self) -> LoadHistory:
        """Return the load; a mean pressure acts on the area of the grid."""
        cells = self.grid.build() if self.grid else None
        return self.load.build(cells.area if isinstance(cells, Grid) else 1.0)


def case_schema() -> dict[str, Any]:
    """Return the JSON schema of case files, for completion and hover texts in editors.

    Returns
    -------
    dict
        JSON Schema, draft 2020-12. Beyond the standard, `x-dimension` says what kind of quantity a
        text is, or which kinds it may be, `x-sign` which values make sense, and `x-units` which
        units each kind is often written in.

    Examples
    --------
    >>> sorted(case_schema()["required"])
    ['indenter', 'load', 'material', 'time']
    """
    schema = CaseFile.model_json_schema()
    units = {name: list(dimension.units) for name, dimension in DIMENSIONS.items()}
    draft = "https://json-schema.org/draft/2020-12/schema"
    return {"$schema": draft, "x-units": units, **schema}
