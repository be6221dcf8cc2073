"""Fluid that leaks, and the direction of its flow."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.results.leakage.channels import Ends, FlowAxis
from viscontact.units.numbers import positive


@dataclass(frozen=True)
class Fluid:
    """Fluid, what drives it, and the seal that it leaks through."""

    viscosity: float  # [Pa s]
    pressure_difference: float | None  # [Pa]
    gas: float | None  # pressure at the outlet of a gas [Pa]
    length: float | None  # of the seal along the flow [m]
    width: float | None  # across it [m]

    def rate(self, transmissivity: Floats, length: float, width: float) -> Floats:
        """Leak rate of a period of some length and width, or of the seal [m³/s]."""
        if self.pressure_difference is None:
            return np.full(transmissivity.shape, np.nan)
        drop = self.pressure_difference
        if self.gas is not None:  # (p1² - p2²)/(2 p2), at the pressure of the outlet
            drop *= 1 + self.pressure_difference / (2 * self.gas)
        shape = (self.width or width) / (self.length or length)
        return np.asarray(transmissivity * drop * shape / self.viscosity)


def fluid_of(settings: Mapping[str, Any]) -> Fluid:
    """Fluid of the arguments of `leakage`; ValueError for an invalid one."""
    units = {"pressure_difference": "Pa", "gas": "Pa", "length": "m", "width": "m"}
    given = {name: settings.get(name) for name in units}
    checked = {
        name: None if value is None else positive(name, value, units[name])
        for name, value in given.items()
    }
    if checked["gas"] is not None and checked["pressure_difference"] is None:
        raise ValueError("gas: needs pressure_difference=, as its flow is not proportional to it")
    return Fluid(positive("viscosity", settings["viscosity"], "Pa s"), **checked)


def flow_axis(along: str, ends: Ends | None, grid: Grid) -> FlowAxis:
    """Direction of a flow on a grid, with the ends that it has by default."""
    axis = "xy".index(along)
    return FlowAxis(axis, _ends(ends, grid, axis), _pair(grid))


def _pair(grid: Grid) -> tuple[bool, bool]:
    return bool(grid.periodic[0]), bool(grid.periodic[1])


def _ends(given: Ends | None, grid: Grid, axis: int) -> Ends:
    if given not in (None, "period", "pressure"):
        raise ValueError(f"ends must be 'period' or 'pressure', got {given!r}")
    if given == "period" and not grid.periodic[axis]:
        raise ValueError(
            f"ends: the grid is not periodic along {'xy'[axis]}; leave ends out, or give "
            "ends='pressure'"
        )
    return given or ("period" if grid.periodic[axis] else "pressure")
