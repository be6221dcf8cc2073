"""Body that heats up in a result over speed: its shift, cooled area and thickness."""

from __future__ import annotations

import math
from dataclasses import fields

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Roller
from viscontact.bodies.laws import Elastic, Shift
from viscontact.bodies.materials.layers import Layered, named_parts
from viscontact.bodies.materials.material import Material
from viscontact.results.heating.power_curve import FEWEST, PowerCurve
from viscontact.results.recorded_case import case_of
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.stated_errors import errors_of
from viscontact.units.axis_flags import AxisFlags
from viscontact.units.formatting import format_quantity

#: Two shifts are equal if their numbers differ by less: they are referred by rounded arithmetic.
_EQUAL = 1e-9
_BODIES = ("material", "indenter_material")


@dataclass(frozen=True)
class RollingBody:
    """What a result over speed tells about the body that heats up."""

    results: xr.Dataset
    creeping: dict[str, Material]  # parts of the bodies that creep, by their keys
    shift: Shift

    @classmethod
    def of(cls, results: xr.Dataset) -> RollingBody:
        """Return the body of a result; ValueError without a single shift of all that creeps."""
        if not isinstance(results, xr.Dataset) or "speed" not in results.dims:
            raise ValueError(
                "curve: must be the result of a steady motion over speed, as steady() or "
                "open_results() return it (in a case motion: {kind: steady, speed: {from: ..., "
                f"to: ...}}}}), got {_kind_of(results)}"
            )
        creeping = _creeping_parts(results)
        if not creeping:
            raise ValueError(
                "curve: neither body creeps, so that nothing heats up; give a viscoelastic material"
            )
        return cls(results, creeping, _common_shift(creeping))

    @property
    def heats_both(self) -> bool:
        """True if both bodies creep, so that each takes a part of the heat."""
        return len({name.split(".")[0] for name in self.creeping}) > 1

    @property
    def part(self) -> str:
        """Key of the body that heats up; of both the half-space."""
        return next(iter(self.creeping)).split(".")[0]

    @property
    def curve(self) -> PowerCurve:
        """Resistance over V a_T; ValueError for one that cannot be interpolated."""
        results = self.results.sortby("speed")
        name = f"resistance_{results.attrs.get('along', 'y')}"
        speeds, resistance = results["speed"].values, results[name].values
        known = np.isfinite(resistance)
        if known.sum() < FEWEST:
            raise ValueError(
                f"curve: needs the resistance at {FEWEST} speeds or more, got {known.sum()}; "
                "compute it at speeds over several decades, e.g. numpy.geomspace(1e-3, 10, 13)"
            )
        if not (resistance[known] > 0).all():
            least = format_quantity(float(resistance[known].min()), "N")
            raise ValueError(f"curve: the resistance must be positive, got {least}")
        errors = np.nan_to_num(errors_of(results, name))
        return PowerCurve(speeds[known], resistance[known], errors[known], self.shift)

    def area(self) -> float:
        """Circumference of a covered roll times its length [m²]; ValueError where not known."""
        case = case_of(self.results)
        is_roll = self.part == "indenter_material" and not self.heats_both
        if not (is_roll and (case.get("motion") or {}).get("rolling")):
            raise ValueError(
                "area: must be given, in m², e.g. 0.1: it follows from the case only if the "
                "cover is the indenter_material of a roll with rolling: true"
            )
        along = str(self.results.attrs.get("along", "y"))
        roll = recorded_object(self.results, "indenter", "area")
        curvature = float(roll.curvatures["xy".index(along)])
        length = _length(case, roll, "yx".index(along))
        if not (curvature > 0 and math.isfinite(length)):
            raise ValueError(
                "area: must be given, in m², e.g. 0.1: radius and length of the roll do not "
                "follow from this indenter"
            )
        return 2 * math.pi / curvature * length

    def thickness(self) -> float | None:
        """Thickness of the body that heats up [m]; None where the case has none."""
        body = recorded_object(self.results, self.part, "thickness")
        return body.thickness if isinstance(body, Material | Layered) else None


def _kind_of(results: object) -> str:
    if not isinstance(results, xr.Dataset):
        return type(results).__name__
    return f"one over {', '.join(map(str, results.dims))}"


def _creeping_parts(results: xr.Dataset) -> dict[str, Material]:
    """Materials of both bodies that creep, by their keys."""
    found = {}
    for body in _BODIES:
        recorded = recorded_object(results, body, "curve")
        if not isinstance(recorded, Material | Layered):
            continue
        for part, material in named_parts(recorded).items():
            if not isinstance(material.law, Elastic):
                found[f"{body}.{part}".rstrip(".")] = material
    return found


def _common_shift(creeping: dict[str, Material]) -> Shift:
    """Shift of all parts that creep; ValueError if one has none, or they differ."""
    for name, material in creeping.items():
        if material.shift is None:
            raise ValueError(
                f"{name}: has no shift, which tells how its law changes with temperature; give "
                "it one, e.g. shift: {kind: wlf, reference_temperature: 25 degC, c1: 8.86, c2: "
                "101.6 K} and temperature: 25 degC in the case, or Material(..., shift=WLF(...)) "
                "in Python, and compute the curve again"
            )
    (first, material), *others = creeping.items()
    assert material.shift is not None  # checked above
    for name, other in others:
        if not _are_equal(material.shift, other.shift):
            raise ValueError(
                f"{first} and {name}: both creep, with shifts that differ: {material.shift!r} and "
                f"{other.shift!r}, each referred to the temperature of its law; a curve over speed "
                "holds at other temperatures only if all that creeps has one shift"
            )
    return material.shift


def _are_equal(one: Shift, other: Shift | None) -> bool:
    """True if the fields that shifts are compared by differ by rounding only."""
    if type(one) is not type(other):
        return False
    mine, its = (
        [
            np.ravel(getattr(each, item.name)).astype(float)
            for item in fields(each)  # type: ignore[arg-type]  # every shift is a dataclass
            if item.compare and getattr(each, item.name) is not None
        ]
        for each in (one, other)
    )
    return len(mine) == len(its) and all(
        a.shape == b.shape and np.allclose(a, b, rtol=_EQUAL, atol=0)
        for a, b in zip(mine, its, strict=True)
    )


def _length(case: dict[str, object], roll: object, axis: int) -> float:
    """Length of a roll along its axis [m]; inf if it is not known."""
    if isinstance(roll, Roller):
        return 2 * roll.end
    grid = case.get("grid") or {}
    assert isinstance(grid, dict)
    if AxisFlags(grid.get("periodic", False))[axis] and "size" in grid:
        return float(grid["size"][axis])
    return math.inf
