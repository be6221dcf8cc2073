"""Section `allowable` of a case file."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from viscontact.case.quantities import POSITIVE, Section, WithUnit

_Force = Annotated[float, WithUnit("force", POSITIVE)]
_Length = Annotated[float, WithUnit("length", POSITIVE)]
_Angle = Annotated[float, WithUnit("angle", POSITIVE)]
_Area = Annotated[float, WithUnit("area", POSITIVE)]
_Stress = Annotated[float, WithUnit("pressure", POSITIVE)]
_LineLoad = Annotated[float, WithUnit("line load", POSITIVE)]
_Energy = Annotated[float, WithUnit("energy", POSITIVE)]
_PowerPerLength = Annotated[float, WithUnit("power per length", POSITIVE)]
_Power = Annotated[float, WithUnit("power", POSITIVE)]
_Torque = Annotated[float, WithUnit("torque", POSITIVE)]
_Stiffness = Annotated[float, WithUnit("stiffness", POSITIVE)]
_Ratio = Annotated[float, Field(gt=0)]

#: Quantities that only moving contacts have, only those under friction, only those with adhesion,
#: and those that steady motion does not have.
MOVING = (
    *("resistance_x", "resistance_y", "friction_coefficient", "motion_work"),
    *("dissipation", "heat"),
)
GRIPPING = (
    *("tangential_force_x", "tangential_force_y", "torque", "rotation", "stick_area"),
    *("tangential_displacement_x", "tangential_displacement_y", "slip_fraction"),
    *("friction_heat", "friction_power", "tangential_stiffness_x", "tangential_stiffness_y"),
    *("creepage", "drive_torque"),
)
#: Quantities per unit length, of line contacts only; those of moving ones.
OF_LINES = ("line_load", "force_per_length", "strip_width")
OF_MOVING_LINES = (
    *("resistance_x_per_length", "resistance_y_per_length", "dissipation_per_length"),
)
ADHERING = ("least_pressure", "tensile_area", "adhesion_energy")
NOT_STEADY = ("work", "loss_per_cycle", "motion_work", "heat")


class Allowable(Section):
    """Largest allowable magnitudes; the result states whether each one passed or failed."""

    peak_pressure: _Stress | None = Field(
        default=None, description="largest pressure", examples=["65 MPa"]
    )
    von_mises: _Stress | None = Field(
        default=None,
        description="stress in the half-space below the largest pressure",
        examples=["40 MPa"],
    )
    max_shear: _Stress | None = Field(
        default=None, description="shear stress in the half-space below the largest pressure"
    )
    mean_pressure: _Stress | None = Field(default=None, description="force over contact area")
    peak_line_load: _LineLoad | None = Field(default=None, description="line load along x")
    approach: _Length | None = Field(default=None, description="of the bodies")
    contact_area: _Area | None = Field(default=None, description="of the contact")
    contact_length: _Length | None = Field(
        default=None, description="extent of the contact along x"
    )
    contact_width: _Length | None = Field(default=None, description="extent of the contact along y")
    force: _Force | None = Field(default=None, description="on the contact")
    eccentricity_x: _Length | None = Field(
        default=None, description="position of the resultant along x"
    )
    eccentricity_y: _Length | None = Field(
        default=None, description="position of the resultant along y"
    )
    tilt_x: _Angle | None = Field(default=None, description="rigid slope along x")
    tilt_y: _Angle | None = Field(default=None, description="rigid slope along y")
    work: _Energy | None = Field(default=None, description="of the load since the start")
    loss_per_cycle: _Energy | None = Field(
        default=None, description="work lost in the last complete cycle"
    )
    resistance_x: _Force | None = Field(
        default=None, description="of the half-space against a motion along x"
    )
    resistance_y: _Force | None = Field(
        default=None, description="of the half-space against a motion along y"
    )
    friction_coefficient: _Ratio | None = Field(default=None, description="resistance over force")
    motion_work: _Energy | None = Field(default=None, description="of the motion since the start")
    dissipation: _Power | None = Field(default=None, description="power lost in the bodies")
    heat: _Energy | None = Field(
        default=None, description="energy lost in the bodies since the start"
    )
    tangential_force_x: _Force | None = Field(default=None, description="along x")
    tangential_force_y: _Force | None = Field(default=None, description="along y")
    torque: _Torque | None = Field(default=None, description="of the tractions about the axis")
    tangential_displacement_x: _Length | None = Field(
        default=None, description="shift of the body along x"
    )
    tangential_displacement_y: _Length | None = Field(
        default=None, description="shift of the body along y"
    )
    rotation: _Angle | None = Field(default=None, description="of the body about its axis")
    stick_area: _Area | None = Field(default=None, description="where the bodies stick")
    slip_fraction: _Ratio | None = Field(default=None, description="part of the contact that slips")
    friction_heat: _Energy | None = Field(
        default=None, description="heat of friction since the start"
    )
    friction_power: _Power | None = Field(default=None, description="heat of friction over time")
    tangential_stiffness_x: _Stiffness | None = Field(default=None, description="along x")
    tangential_stiffness_y: _Stiffness | None = Field(default=None, description="along y")
    creepage: _Ratio | None = Field(
        default=None, description="surface speed of the body over its travel, less 1"
    )
    drive_torque: _Torque | None = Field(default=None, description="of the drive of a roller")
    least_pressure: _Stress | None = Field(default=None, description="largest tension")
    tensile_area: _Area | None = Field(
        default=None, description="area outside the contact that pulls"
    )
    adhesion_energy: _Energy | None = Field(
        default=None, description="work that separating the surfaces would take"
    )

    line_load: _LineLoad | None = Field(
        default=None, description="force per unit length of a line contact"
    )
    force_per_length: _LineLoad | None = Field(
        default=None, description="the same by its name in the result"
    )
    strip_width: _Length | None = Field(default=None, description="of a line contact")
    resistance_x_per_length: _LineLoad | None = Field(
        default=None, description="of a line contact against a motion along x"
    )
    resistance_y_per_length: _LineLoad | None = Field(
        default=None, description="of a line contact against a motion along y"
    )
    dissipation_per_length: _PowerPerLength | None = Field(
        default=None, description="power lost in the bodies of a line contact"
    )

    @property
    def limits(self) -> dict[str, float]:
        """The given limits, by name, in SI units."""
        given = {name: limit for name, limit in self.model_dump().items() if limit is not None}
        if (line_load := given.pop("line_load", None)) is not None:
            given["force_per_length"] = line_load
        return given

    def require_known(
        self, *, moving: bool, steady: bool, grips: bool, adheres: bool, is_line: bool
    ) -> None:
        """Raise ValueError for a quantity that a run lacks, by its motion and its surfaces."""
        if self.line_load is not None and self.force_per_length is not None:
            raise ValueError("allowable.line_load: is force_per_length; give one of them")
        for name in self.limits:
            if name in (*OF_LINES, *OF_MOVING_LINES) and not is_line:
                typed = "line_load" if self.line_load is not None else "force_per_length"
                shown = typed if name == "force_per_length" else name
                raise ValueError(
                    f"allowable.{shown}: only a line contact has it, of a body without end or on a "
                    "grid that is periodic along one axis; leave it out"
                )
            if name in (*MOVING, *OF_MOVING_LINES) and not moving:
                raise ValueError(
                    f"allowable.{name}: only a moving contact has it; add a motion, or leave it out"
                )
            if name in GRIPPING and not grips:
                raise ValueError(
                    f"allowable.{name}: only a contact under friction has it; add friction and a "
                    "tangential load, or leave it out"
                )
            if name in ADHERING and not adheres:
                raise ValueError(
                    f"allowable.{name}: only a contact with adhesion has it; add adhesion, or "
                    "leave it out"
                )
            if name in NOT_STEADY and steady:
                raise ValueError(f"allowable.{name}: steady motion does not have it; leave it out")
