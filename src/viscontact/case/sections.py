"""Sections of a case file, and its JSON schema."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Field, model_validator

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.motion import STANDING, Motion
from viscontact.bodies.loads.steady_motion import SteadyMotion, constant_load
from viscontact.bodies.loads.temperature import require_constant
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.bodies.materials.strength import onset_ratio
from viscontact.case.adhesion import AdhesionSection
from viscontact.case.aliases import with_aliases
from viscontact.case.allowable import Allowable
from viscontact.case.friction import FrictionSection
from viscontact.case.indenters.shapes import Roller, Shapes, combined
from viscontact.case.leakage import Leakage
from viscontact.case.loads.load import AnyLoad
from viscontact.case.loads.temperature import AnyTemperature
from viscontact.case.materials.base import INCOMPLETE_END, Medium
from viscontact.case.materials.layers import AnyBody, Layers
from viscontact.case.motion import AnyMotion
from viscontact.case.quantities import Section
from viscontact.case.tangential import AnyTangential
from viscontact.case.time_grid_output import Cells, Output, Time
from viscontact.case.title_block import TitleBlock
from viscontact.mechanics.problem.problem import COARSEST_TOLERANCE, FINEST_TOLERANCE
from viscontact.mechanics.problem.surface import creeps
from viscontact.mechanics.time_integration.moving_times import CellTimes, moving_times
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.units.axis_flags import AxisFlags
from viscontact.units.dimensions import DIMENSIONS


class CaseFile(Section):
    """A viscontact case: indenter, material, load and time."""

    title: str = Field(default="", description="title of the run in tables, figures and reports")
    indenter: Shapes
    material: AnyBody = Field(description="the half-space")
    indenter_material: AnyBody | None = Field(
        default=None, description="the pressed body's material; rigid when left out"
    )
    load: AnyLoad = Field(description="load over time")
    temperature: AnyTemperature | None = Field(
        default=None,
        description="temperature of all bodies, constant or over time, to which the shifts of "
        "their materials take the laws; laws are used as they are when left out",
    )
    adhesion: AdhesionSection | None = Field(
        default=None, description="adhesion between the bodies; without it they do not attract"
    )
    friction: FrictionSection | None = Field(
        default=None, description="friction between the bodies; without it they slip freely"
    )
    tangential: AnyTangential | None = Field(
        default=None, description="load along the surface, carried by friction"
    )
    motion: AnyMotion | None = Field(
        default=None, description="motion of the body over the surface; at rest when left out"
    )
    time: Time | None = Field(
        default=None, description="instants of the run; left out with a steady motion only"
    )
    grid: Cells | None = Field(default=None, description="an automatic grid when left out")
    output: Output = Field(default=Output(), description="results to keep")
    report: TitleBlock = Field(default=TitleBlock(), description="title block of the report")
    allowable: Allowable = Field(
        default=Allowable(), description="limits that the result is compared with"
    )
    leakage: Leakage | None = Field(
        default=None, description="fluid that leaks through the gap; not computed when left out"
    )
    tolerance: Annotated[float, Field(ge=FINEST_TOLERANCE, le=COARSEST_TOLERANCE)] = Field(
        default=1e-6, description="relative error of pressure and balances at every step"
    )

    @model_validator(mode="after")
    def _accepted(self) -> CaseFile:
        if self.load.is_by_pressure and not (self.grid and all(AxisFlags(self.grid.periodic))):
            raise ValueError(
                "load.mean_pressure: it goes with a periodic grid (along both axes), whose area "
                "makes a force of it; write 'periodic: true' under grid, or give the force"
            )
        if self.load.is_by_length and self._line_length is None:
            raise ValueError(
                "load: a force per length goes with a line contact, of a body without end ('shape: "
                "cylinder'), or on a grid that is periodic along one axis; give the force"
            )
        return self

    @model_validator(mode="after")
    def _has_lengths(self) -> CaseFile:
        bodies = {"material": self.material, "indenter_material": self.indenter_material}
        for name, given in bodies.items():
            if not isinstance(given, Medium) or given.ends is None or given.length is not None:
                continue
            if name == "material" or self._roller_length is None:
                raise ValueError(f"{name}.length: {INCOMPLETE_END}")
        return self

    @property
    def _roller_length(self) -> float | None:
        """Total length of a roller that ends [m]; None without one."""
        if len(self.indenter) != 1 or not isinstance(self.indenter[0], Roller):
            return None
        length = self.indenter[0].build().total_length
        return length if math.isfinite(length) else None

    @property
    def indenter_body(self) -> Material | Layered | Body | None:
        """The pressed body; where it ends, that of a roller may leave the length to the roller."""
        given = self.indenter_material
        if isinstance(given, Medium) and given.ends is not None and given.length is None:
            assert self._roller_length is not None  # refused otherwise
            return given.body_of(self._roller_length)
        return None if given is None else given.body

    @model_validator(mode="after")
    def _holds_the_load(self) -> CaseFile:
        if self.adhesion is not None:
            _ = self.adhesion.built
            return self
        try:
            self.load.refuse_pull()
        except ValueError as error:
            raise ValueError(f"load.{error}") from None
        return self

    @property
    def body_motion(self) -> Motion:
        """The motion of the body."""
        return self.motion.built if self.motion else STANDING

    @model_validator(mode="after")
    def _fits_the_leakage(self) -> CaseFile:
        if self.leakage is not None:
            grid = self.grid.build() if self.grid else None
            self.leakage.require_fit(self.output.fields, grid if isinstance(grid, Grid) else None)
        return self

    @model_validator(mode="after")
    def _fits_the_motion(self) -> CaseFile:
        stands, steady = self.body_motion.stands, isinstance(self.body_motion, SteadyMotion)
        if steady and self.time is not None:
            raise ValueError(
                "time: a steady motion has no steps in time, but a row for each speed; leave this "
                "section out"
            )
        if steady:
            constant_load(self.history())
            if self.temperature is not None:
                require_constant(self.temperature.built)
        if steady and self.adhesion is not None:
            raise ValueError(
                "adhesion: it is not supported in steady motion; leave this section out"
            )
        if steady and self.tangential is not None:
            raise ValueError(
                "tangential: a body in steady motion rolls under friction by the creepage of its "
                "motion; leave this section out and write 'creepage: [0.1 %, 1 %]' in motion"
            )
        grips = self.friction is not None
        adheres = self.adhesion is not None
        self.allowable.require_known(
            moving=not stands,
            steady=steady,
            grips=grips,
            adheres=adheres,
            is_line=self._line_length is not None,
        )
        self._require_radius_of_turns()
        if stands and self.time is not None and self.time.spacing == "cells":
            raise ValueError("time.spacing: cells goes with a motion; write 'spacing: uniform'")
        return self

    def _require_radius_of_turns(self) -> None:
        """Refuse two rolls whose material returns after a turn, or whose drive has a torque."""
        joint = [shape for shape in self.indenter if getattr(shape, "turns_with_another", False)]
        own = self.indenter_body
        turns = self.friction is not None or (own is not None and creeps(own))
        if joint and turns and getattr(self.body_motion, "rolling", None):
            raise ValueError(
                "indenter.counter_radius: a roll whose own material creeps, or that is driven by "
                "friction, turns with its own radius, and two rolls are computed as one on a "
                "plane; give the covered roll as material and the other one as indenter_material, "
                "without friction, or leave counter_radius out"
            )

    @property
    def repeats(self) -> bool:
        """True for a load that comes again: in cycles, or with a body that moves."""
        return not self.body_motion.stands or len(self.history().load_cycles) > 1

    @property
    def limits(self) -> dict[str, float]:
        """Allowable values, and where there are none, those of the materials."""
        # The stress below the contact is computed in a half-space without ends; that in the pressed
        # body follows from the pressure, as in a contact of Hertz.
        found: dict[str, float] = {}
        if isinstance(self.material, Medium) and self.material.ends is None:
            stress = self.material.built.strength(repeats=self.repeats)
            found |= {} if stress is None else {"von_mises": stress}
        if isinstance(self.indenter_material, Medium):
            material, is_line = self.indenter_material.built, self._line_length is not None
            stress = material.strength(repeats=self.repeats)
            if stress is not None:
                ratio = onset_ratio(material.instant_poisson_ratio, is_line=is_line)
                found["peak_pressure"] = ratio * stress
        return found | self.allowable.limits

    @property
    def media(self) -> dict[str, Medium]:
        """Sections of the materials, those of layers too, by their keys."""
        media: dict[str, Medium] = {}
        bodies = {"material": self.material, "indenter_material": self.indenter_material}
        for name, body in bodies.items():
            if isinstance(body, Layers):
                media |= {f"{name}.{key}": each for key, each in body.media.items()}
            elif body is not None:
                media[name] = body
        return media

    def instants(self) -> Floats | AdaptiveTimes | CellTimes:
        """Return the instants of the run [s], or the settings of steps that are chosen later."""
        assert self.time is not None  # refused otherwise
        if self.time.spacing != "cells":
            return self.time.instants()
        grid = self.grid.build() if self.grid else None
        if not isinstance(grid, Grid):
            return CellTimes(self.time.end)
        return moving_times(self.body_motion, self.history(), grid.cell_size, self.time.end)

    @property
    def _line_length(self) -> float | None:
        """Length on which a line load acts: the only period, that of automatic grids is 1 m."""
        cells = self.grid.build() if self.grid else None
        if isinstance(cells, Grid):
            return None if cells.has_datum else cells.size[cells.periodic.index(True)]
        along_x, along_y = combined(self.indenter).endless
        return None if along_x == along_y else 1.0

    def history(self) -> LoadHistory:
        """Return the load; a mean pressure acts on the area of the grid, a line load on a line."""
        cells = self.grid.build() if self.grid else None
        if self.load.is_by_pressure and isinstance(cells, Grid):
            return self.load.build(cells.area)
        if self.load.is_by_length and (length := self._line_length) is not None:
            return self.load.build(length)
        return self.load.built


def lacks_time(data: Mapping[str, Any]) -> bool:
    """True if the data of a case, valid or not, lack the section `time`."""
    motion = data.get("motion")
    steady = isinstance(motion, dict) and motion.get("kind") == "steady"
    return data.get("time") is None and not steady


#: A section `time` is required, and with a steady motion refused.
_STEADY = {"properties": {"kind": {"const": "steady"}}, "required": ["kind"]}
_TIME_UNLESS_STEADY = {
    "if": {"properties": {"motion": _STEADY}, "required": ["motion"]},
    "then": {"properties": {"time": False}},
    "else": {"required": ["time"]},
}


def case_schema() -> dict[str, Any]:
    """Return the JSON schema of case files, for completion and hover texts in editors.

    Returns
    -------
    dict
        JSON Schema, draft 2020-12. Beyond the standard, `x-dimension` names the dimension of a
        quantity, or the allowed ones, `x-sign` the allowed sign, `x-units` common units of each
        dimension, and `x-alias-of` the key that an alias stands for.

    Examples
    --------
    >>> schema = case_schema()
    >>> schema["required"], schema["else"]["required"]
    (['indenter', 'material', 'load'], ['time'])
    """
    schema = with_aliases(CaseFile.model_json_schema()) | _TIME_UNLESS_STEADY
    units = {name: list(dimension.units) for name, dimension in DIMENSIONS.items()}
    draft = "https://json-schema.org/draft/2020-12/schema"
    return {"$schema": draft, "x-units": units, **schema}
