"""Tractions of a body that rolls in steady motion, over its creepage."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np

from viscontact.backend.arrays import Flags, Floats
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True, eq=False)
class RollingTraction:
    """Scalars and fields at each creepage, by their names in the result.

    Fields have the shape (creepages, nx, ny), and scalars (creepages,).
    """

    creepage: Floats  # surface speed of the body over its travel, less 1 [-]
    tangential_force_x: Floats  # [N]
    tangential_force_y: Floats  # [N]
    drive_torque: Floats  # force against the motion times the radius; NaN without one [N m]
    stick_area: Floats  # [m²]
    slip_fraction: Floats  # part of the cells in contact that slip [-]
    friction_power: Floats  # [W]
    traction_dissipation: Floats  # power lost in the bodies under the tractions [W]
    slip_residual: Floats  # largest deviation from the friction law over the largest slip [-]
    traction_x: Floats  # of the body on the half-space [Pa]
    traction_y: Floats  # [Pa]
    slip_x: Floats  # of the surface under the body since its contact began [m]
    slip_y: Floats  # [m]
    slip_state: Flags  # 0 open, 1 stick, 2 slip
    friction_work: Floats  # per area since the contact began, also behind it [J/m²]

    def without_fields(self) -> RollingTraction:
        """The same with empty fields."""
        nothing: dict[str, Any] = {
            each.name: np.empty((self.creepage.size, 0, 0), getattr(self, each.name).dtype)
            for each in fields(self)
            if getattr(self, each.name).ndim > 1
        }
        return replace(self, **nothing)
