"""The table of a result's variables: units, names, labels, errors, and where each is shown.

A new scalar is one entry of `SCALARS`, with an attribute of the same name in `ContactState` and,
if it has an error bar, its model in `viscontact.simulation.accuracy.error_models.ERROR_MODELS`. The
dataset, the netCDF and CSV files, the tables, cards, pages and figures read the table.
"""

from __future__ import annotations

import math
from collections.abc import Container, Hashable, Iterable, Mapping
from dataclasses import replace
from enum import Flag, auto
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.state import (
    ADHESION,
    FRICTION,
    LEAKAGE,
    LEAKAGE_Y,
    MOTION,
    OVER_CREEPAGE,
    ROLLING,
    STAGE,
    ContactState,
    Outcome,
)


class Place(Flag):
    """Places that show a scalar. The summary and the report's table list all that have an error."""

    NOWHERE = 0
    #: The history table of the command line.
    TABLE = auto()
    #: A column of the table of several runs, and a panel of an animation.
    KEY = auto()
    #: The card of a result in a notebook.
    CARD = auto()
    #: The results at the head of the report and of the page.
    FACTS = auto()
    #: Histories of the report and of the page: load and motion, and the contact's response.
    LOAD = auto()
    RESPONSE = auto()
    #: The history figure.
    FIGURE = auto()
    #: Curves on the page while a run is at work.
    LIVE = auto()


@dataclass(frozen=True)
class Variable:
    """A variable of the result."""

    units: str  # as CF and UDUNITS write it
    long_name: str
    kind: str = "f8"  # NumPy's name of its type
    comment: str = ""
    label: str = ""  # on axes and pages
    has_error: bool = False  # estimated and stored with it
    places: Place = Place.NOWHERE
    rank: float = 0  # on pages, cards and figures; tables keep the order of `SCALARS`
    per_length_of: str = ""  # scalar of a period, of which it is the part on a unit of length
    of: str = ""  # part that only some results have, as in `ContactState.parts`
    flags: tuple[str, ...] = ()  # meanings of the values 0, 1, ... of an enumeration
    beyond: float = math.nan  # value of a field where a grid that was enlarged had no cells yet

    @property
    def moving(self) -> bool:
        """True if only results of moving contacts have it."""
        return self.of in (MOTION, along_line(MOTION))

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes the variable carries."""
        attributes: dict[str, Any] = {"units": self.units, "long_name": self.long_name}
        if self.comment:
            attributes["comment"] = self.comment
        if self.flags:  # CF's way to write an enumeration
            attributes["flag_values"] = np.arange(len(self.flags), dtype=self.kind)
            attributes["flag_meanings"] = " ".join(self.flags)
        return attributes


#: Quantities in which the states of a run differ: time, or speed in steady motion.
AXES = {
    "time": Variable("s", "time"),
    "speed": Variable("m s-1", "speed of the body"),
}

COORDINATES = {
    "time": AXES["time"],
    "x": Variable("m", "position along the indenter"),
    "y": Variable("m", "position across the indenter"),
}

#: Of fields that are not computed beyond the grid of their instant.
_BEYOND = "NaN beyond the grid of an instant before the grid was enlarged (see grid_enlarged)"

FIELDS = {
    "pressure": Variable("Pa", "contact pressure, positive in compression", beyond=0.0),
    "gap": Variable("m", "gap, positive when open", comment=_BEYOND),
    "displacement": Variable(
        "m", "surface displacement, positive into the half-space", comment=_BEYOND
    ),
    "in_contact": Variable(
        "1", "cells where the bodies touch", "i1", flags=("open", "in_contact"), beyond=False
    ),
}

#: Further fields of results under friction.
FRICTION_FIELDS = {
    "traction_x": Variable("Pa", "traction of the body on the half-space along x", beyond=0.0),
    "traction_y": Variable("Pa", "traction of the body on the half-space along y", beyond=0.0),
    "slip_x": Variable("m", "slip of the surface under the body along x", beyond=0.0),
    "slip_y": Variable("m", "slip of the surface under the body along y", beyond=0.0),
    "slip_state": Variable(
        *("1", "cells where the bodies stick or slip", "i1"),
        flags=("open", "stick", "slip"),
        beyond=0,
    ),
    "friction_work": Variable("J m-2", "work of friction per area since the start", beyond=0.0),
}
EVERY_FIELD = FIELDS | FRICTION_FIELDS

#: Fields along x, integrated over y.
LINES = {"line_load": Variable("N/m", "line load along x: pressure integrated over y")}


def _scalar(
    units: str,
    long_name: str,
    label: str,
    rank: int,
    places: Place = Place.NOWHERE,
    *,
    of: str = "",
) -> Variable:
    """A scalar that has an error bar."""
    return Variable(units, long_name, label=label, has_error=True, places=places, rank=rank, of=of)


def _position(axis: str, rank: int) -> Variable:
    """Position of a moving body along an axis, which is prescribed."""
    name, label = f"position of the body's axis along {axis}", f"Position along {axis}"
    return Variable("m", name, label=label, places=Place.LOAD, rank=rank, of=MOTION)


#: Places of the scalars of a contact under friction.
_GRIPPING = Place.CARD | Place.RESPONSE | Place.FIGURE


def _shear(
    units: str, long_name: str, label: str, rank: int, places: Place = _GRIPPING
) -> Variable:
    """A scalar of a contact under friction."""
    return _scalar(units, long_name, label, rank, places, of=FRICTION)


def _leak(
    units: str, long_name: str, rank: int = 0, label: str = "", places: Place = Place.NOWHERE
) -> Variable:
    """A scalar of the flow through the gap, whose error is found with it."""
    return Variable(units, long_name, label=label, places=places, rank=rank, of=LEAKAGE)


def _leaks_along_y() -> dict[str, Variable]:
    """Scalars of a flow along y, of a fluid that leaks along both axes."""
    shown = Place.KEY | Place.CARD | Place.FACTS
    found = {
        "transmissivity_y": Variable(
            "m3", "transmissivity along y", label="Transmissivity along y", rank=44
        ),
        "leak_rate_y": Variable(
            *("m3 s-1", "volume of fluid that leaks along y in a unit of time"),
            label="Leak rate along y",
            places=shown,
            rank=45,
        ),
        "critical_gap_y": Variable(
            *("m", "gap at the narrowest place of the widest channel along y"),
            label="Critical gap along y",
            places=shown,
            rank=46,
        ),
    }
    errors = {
        f"{name}_error": Variable(each.units, f"error of the {each.label.lower()}")
        for name, each in found.items()
    }
    return {name: replace(each, of=LEAKAGE_Y) for name, each in (found | errors).items()}


#: Places of the scalars of bodies that adhere.
_ADHERING = Place.CARD | Place.RESPONSE


def _sticking(
    units: str, long_name: str, label: str, rank: int, places: Place = _ADHERING
) -> Variable:
    """A scalar of a contact of bodies that adhere."""
    return _scalar(units, long_name, label, rank, places, of=ADHESION)


def along_line(part: str = "") -> str:
    """Part of the scalars per unit length of a line contact, with those of another part."""
    return f"line {part}".rstrip()


#: Units of a period, and those of a unit of its length.
_PER_LENGTH = {"N": "N/m", "m2": "m", "J": "J/m", "W": "W/m", "N m": "N m/m"}
#: Scalars of a period that a line contact has per unit length.
_OF_A_PERIOD = (
    *("force", "work", "loss_per_cycle", "resistance_x", "resistance_y"),
    *("motion_work", "dissipation", "heat", "tangential_force_x", "tangential_force_y"),
    *("stick_area", "friction_heat", "friction_power", "drive_torque"),
    *("contact_area", "tensile_area", "adhesion_energy"),
)


#: Those of them at the head of the report and of the page, in place of the peak line load.
_AT_HEAD = ("force", "dissipation")
#: Extents of a contact, and the largest line load, which a line contact has everywhere.
_OF_ENDS = ("contact_length", "contact_width", "peak_line_load")


def per_length(name: str) -> str:
    """Name of a scalar per unit length of a line contact."""
    return "strip_width" if name == "contact_area" else f"{name}_per_length"


def _per_unit_length(name: str, variable: Variable) -> Variable:
    """The scalar per unit length of a line contact, shown where that of a period is otherwise."""
    return replace(
        variable,
        units=_PER_LENGTH[variable.units],
        places=variable.places | (Place.FACTS if name in _AT_HEAD else Place.NOWHERE),
        long_name=f"{variable.long_name}, per unit length of a line contact",
        label="Width of the strip" if name == "contact_area" else f"{variable.label} per length",
        rank=variable.rank + 0.5,
        of=along_line(variable.of),
        per_length_of=name,
    )


_EXTENT = Place.TABLE | Place.CARD | Place.RESPONSE
_MOTION = _EXTENT | Place.FIGURE
_RESULT = _MOTION | Place.KEY | Place.FACTS | Place.LIVE
_LINE_LOAD = Place.KEY | Place.CARD | Place.FACTS | Place.RESPONSE | Place.FIGURE
_RESISTANCE = Place.CARD | Place.RESPONSE | Place.FIGURE
_LOST = Place.RESPONSE | Place.FIGURE
_FORCE = Place.TABLE | Place.KEY | Place.CARD | Place.LOAD | Place.FIGURE

SCALARS = {
    "force": _scalar("N", "force on the contact", "Force", 1, _FORCE),
    "eccentricity_x": _scalar(
        "m", "position of the resultant along x", "Eccentricity along x", 2, Place.LOAD
    ),
    "eccentricity_y": _scalar(
        "m", "position of the resultant along y", "Eccentricity along y", 3, Place.LOAD
    ),
    "approach": _scalar(
        "m", "rigid approach, positive when the bodies come closer", "Approach", 5, _RESULT
    ),
    "tilt_x": _scalar(
        "rad", "rigid slope along x, positive when the +x end is deeper", "Tilt along x", 6, _MOTION
    ),
    "tilt_y": _scalar(
        "rad", "rigid slope along y, positive when the +y end is deeper", "Tilt along y", 7, _MOTION
    ),
    "contact_area": _scalar("m2", "contact area", "Contact area", 4, _RESULT),
    "contact_length": _scalar(
        "m", "extent of the contact along x", "Contact length, along x", 11, _EXTENT
    ),
    "contact_width": _scalar(
        "m", "extent of the contact along y", "Contact width, along y", 12, _EXTENT
    ),
    "peak_pressure": _scalar("Pa", "largest pressure", "Peak pressure", 8, _RESULT),
    "mean_pressure": _scalar(
        "Pa", "force over contact area", "Mean pressure", 9, Place.CARD | Place.FACTS
    ),
    "peak_line_load": _scalar(
        "N/m",
        "largest mean line load over a twentieth of the contact's length along x",
        "Peak line load",
        10,
        _LINE_LOAD,
    ),
    "work": _scalar("J", "work of the load on the contact since the start", "Work", 13),
    "loss_per_cycle": _scalar(
        "J", "work lost in the last complete cycle of the load", "Loss per cycle", 14
    ),
    "position_x": _position("x", 21),
    "position_y": _position("y", 22),
    "resistance_x": _scalar(
        *("N", "force of the half-space on the body against +x", "Resistance along x", 15),
        *(_RESISTANCE,),
        of=MOTION,
    ),
    "resistance_y": _scalar(
        *("N", "force of the half-space on the body against +y", "Resistance along y", 16),
        *(_RESISTANCE,),
        of=MOTION,
    ),
    "friction_coefficient": _scalar(
        *("1", "resistance against the motion over force", "Friction coefficient", 17),
        *(_RESISTANCE | Place.KEY | Place.FACTS | Place.LIVE,),
        of=MOTION,
    ),
    "motion_work": _scalar(
        "J",
        "work of the motion against the resistance since the start",
        "Motion work",
        18,
        _LOST,
        of=MOTION,
    ),
    "dissipation": _scalar("W", "power lost in the bodies", "Dissipation", 19, _LOST, of=MOTION),
    "heat": _scalar("J", "energy lost in the bodies since the start", "Heat", 20, _LOST, of=MOTION),
    "tangential_force_x": _shear("N", "tangential force along x", "Tangential force along x", 27),
    "tangential_force_y": _shear("N", "tangential force along y", "Tangential force along y", 28),
    "torque": _shear("N m", "torque of the tractions about the axis", "Torque", 29),
    "tangential_displacement_x": _shear(
        "m", "rigid shift of the body along x", "Tangential displacement along x", 30
    ),
    "tangential_displacement_y": _shear(
        "m", "rigid shift of the body along y", "Tangential displacement along y", 31
    ),
    "rotation": _shear("rad", "rotation of the body about its axis", "Rotation", 32),
    "stick_area": _shear("m2", "area where the bodies stick", "Stick area", 33),
    "slip_fraction": _shear(
        *("1", "part of the contact that slips", "Slip fraction", 34),
        Place.CARD | Place.RESPONSE,
    ),
    "friction_heat": _shear(
        *("J", "heat of friction since the start", "Friction heat", 35), _GRIPPING | Place.KEY
    ),
    "friction_power": _shear("W", "heat of friction over time", "Friction power", 36),
    "tangential_stiffness_x": _shear(
        "N/m",
        "change of the tangential force over that of the shift, along x",
        "Tangential stiffness along x",
        37,
        Place.NOWHERE,
    ),
    "tangential_stiffness_y": _shear(
        "N/m",
        "change of the tangential force over that of the shift, along y",
        "Tangential stiffness along y",
        38,
        Place.NOWHERE,
    ),
    "duality_gap": Variable(
        *("1", "bound of the energy of the error of the tractions"),
        of=FRICTION,
    ),
    "creepage": _scalar(
        *("1", "surface speed of the body over its travel, less 1", "Creepage", 39),
        *(Place.CARD | Place.RESPONSE | Place.FIGURE,),
        of=ROLLING,
    ),
    "drive_torque": _scalar(
        *("N m", "torque of the drive that the tractions balance", "Drive torque", 40),
        *(Place.KEY | Place.CARD | Place.RESPONSE | Place.FIGURE,),
        of=ROLLING,
    ),
    "transmissivity": _leak(
        "m3", "transmissivity of the gap: h³/12 between parallel plates", 41, "Transmissivity"
    ),
    "transmissivity_error": _leak("m3", "error of the transmissivity, by two discretisations"),
    "leak_rate": _leak(
        *("m3 s-1", "volume of fluid that leaks in a unit of time", 42, "Leak rate"),
        Place.KEY | Place.CARD | Place.FACTS,
    ),
    "leak_rate_error": _leak("m3 s-1", "error of the leak rate"),
    "critical_gap": _leak(
        *("m", "gap at the narrowest place of the widest channel", 43, "Critical gap"),
        Place.KEY | Place.CARD | Place.FACTS,
    ),
    "critical_gap_error": _leak("m", "error of the critical gap"),
    **_leaks_along_y(),
    "temperature": Variable(
        "K",
        "temperature of the bodies",
        label="Temperature",
        places=Place.LOAD,
        rank=23,
        of="temperature",
    ),
    "reduced_time": Variable(
        "s",
        "reduced time of the half-space: time at the reference temperature and age",
        label="Reduced time",
        rank=24,
        of="reduced_time",
    ),
    "reduced_time_indenter": Variable(
        "s",
        "reduced time of the indenter: time at the reference temperature and age",
        label="Reduced time, indenter",
        rank=25,
        of="reduced_time_indenter",
    ),
    "thickening": Variable(
        "m",
        "growth of the thickness of all layers by thermal expansion",
        label="Thermal expansion",
        rank=26,
        of="thickening",
    ),
    "least_pressure": _sticking(
        "Pa", "least pressure, negative in tension", "Least pressure", 51, _ADHERING | Place.FIGURE
    ),
    "tensile_area": _sticking("m2", "area outside the contact that pulls", "Cohesive zone", 52),
    "adhesion_energy": _sticking(
        "J", "work that separating the surfaces would take", "Adhesion energy", 53
    ),
    "stability": Variable(
        "1",
        "factor by which a small change of the attraction returns; below 1 if stable",
        label="Stability",
        rank=54,
        of=ADHESION,
    ),
    "stage_position": Variable(
        "m",
        "position of the stage on whose spring the body hangs",
        label="Stage position",
        places=Place.LOAD,
        rank=55,
        of=STAGE,
    ),
    "time_error": Variable("1", "estimated relative error of pressure due to the time steps"),
    "iterations": Variable("1", "iterations of the contact solver", "i4"),
    "residual": Variable("1", "relative violation of the contact conditions"),
    "cells_across": Variable("1", "cells across the contact, along its shorter direction", "i4"),
    "outcome": Variable(
        *("1", "how the instant ended", "i1"),
        flags=tuple(outcome.name.lower() for outcome in Outcome),
    ),
}
SCALARS = {
    each: variable
    for name, found in SCALARS.items()
    for each, variable in (
        (name, found),
        *(((per_length(name), _per_unit_length(name, found)),) if name in _OF_A_PERIOD else ()),
    )
}


#: Coordinate of the tractions of a body that rolls in steady motion.
CREEPAGE = Variable("1", "surface speed of the body over its travel, less 1")


def _curves() -> dict[str, Variable]:
    """Values over the creepage, those per unit length of a line contact after each."""
    names = ("tangential_force_x", "tangential_force_y", "drive_torque", "stick_area")
    found = {name: SCALARS[name] for name in (*names, "slip_fraction", "friction_power")}
    found["traction_dissipation"] = _scalar(
        *("W", "power lost in the bodies under the tractions", "Dissipation under tractions", 0)
    )
    found["slip_residual"] = Variable("1", "relative violation of the friction law")
    curves = {}
    for name, variable in found.items():
        curves[name] = replace(variable, of=OVER_CREEPAGE)
        if name in (*_OF_A_PERIOD, "traction_dissipation"):
            curves[per_length(name)] = _per_unit_length(name, curves[name])
    return curves


#: Values at each creepage of a body that rolls in steady motion. Some have the names of scalars.
CURVES = _curves()


def curves_of(parts: Container[str] = ()) -> dict[str, Variable]:
    """Values over the creepage of a result with some parts."""
    return {name: each for name, each in CURVES.items() if each.of in parts}


def curves_with_error() -> list[str]:
    """Names of the values over the creepage whose error is estimated, of a period."""
    return [name for name, each in CURVES.items() if each.has_error and not each.per_length_of]


def curve_of(state: ContactState, name: str) -> Floats:
    """Values of a state over the creepage."""
    period, length = CURVES[name].per_length_of, state.grid.line_length
    values: Floats = getattr(state.rolling_traction, period or name)
    return values / length if period and length else values


def scalars_in(results: Any, names: Iterable[str] | None = None) -> list[str]:
    """Names of the scalars that a result has over its run, in their order.

    Not those that it has over the creepage, or of one instant only.
    """
    names = SCALARS if names is None else names
    over = [(name, results[name].dims) for name in names if name in results]
    return [name for name, dims in over if dims and "creepage" not in dims]


#: Scalars of the flow through the gap, of runs whose case names a fluid.
OF_LEAKAGE = tuple(name for name, each in SCALARS.items() if each.of == LEAKAGE and each.label)

#: Those along y, of a fluid that leaks along both axes.
OF_LEAKAGE_Y = tuple(f"{name}_y" for name in OF_LEAKAGE)

#: Scalars that add up over time, belong to steps in time, or are the origin of coordinates.
NOT_STEADY = (
    *("work", "loss_per_cycle", "motion_work", "heat", "time_error", "position_x", "position_y"),
    *("reduced_time", "reduced_time_indenter"),
    *map(per_length, ("work", "loss_per_cycle", "motion_work", "heat")),
)


def scalars_of(parts: Container[str] = (), over: str = "time") -> dict[str, Variable]:
    """Scalars of a result over time or speed: those that all have, and those of its parts."""
    left_out = NOT_STEADY if over == "speed" else ()
    return {
        name: each
        for name, each in SCALARS.items()
        if name not in left_out and (not each.of or each.of in parts)
    }


def value_of(state: ContactState, name: str) -> float:
    """Scalar of a state."""
    period = SCALARS[name].per_length_of
    if period and (length := state.grid.line_length):
        return float(getattr(state, period)) / length
    return float(getattr(state, name))


def parts_on(grid: Grid, parts: Iterable[str]) -> frozenset[str]:
    """Parts of the scalars of contacts on a grid: of a line contact also those per unit length."""
    found = frozenset(parts)
    if grid.line_length is None:
        return found
    return found | {along_line(each) for each in ("", *found)}


def parts_of(state: ContactState) -> frozenset[str]:
    """Parts of the scalars of a state, as a result has them."""
    return parts_on(state.grid, state.parts)


def with_errors_per_length(errors: Mapping[str, Floats], grid: Grid) -> dict[str, Floats]:
    """Errors of scalars, of a line contact also of those per unit length, which follow."""
    length, found = grid.line_length, dict(errors)
    if length is None:
        return found
    known = {name: each.per_length_of for name, each in (CURVES | SCALARS).items()}
    return found | {
        name: errors[period] / length for name, period in known.items() if period in errors
    }


def fields_of(parts: Container[str] = ()) -> dict[str, Variable]:
    """Fields over the cells of a result: those that all have, and those of its parts."""
    return EVERY_FIELD if FRICTION in parts else FIELDS


def fields_over_creepage(parts: Container[str] = ()) -> dict[str, Variable]:
    """Fields over the cells at each creepage of a result with some parts."""
    return FRICTION_FIELDS if OVER_CREEPAGE in parts else {}


def field_axis_attributes(over: str) -> dict[str, Any]:
    """Attributes of the times or speeds of the stored fields."""
    return AXES[over].attributes | {"long_name": f"{over} of the stored fields"}


#: Scalars that tables, figures and warnings read by name. A result without one of the others was
#: written before that scalar existed, and is shown without it.
REQUIRED = (
    *("force", "eccentricity_x", "eccentricity_y", "approach", "tilt_x", "tilt_y"),
    *("contact_area", "contact_length", "contact_width", "peak_pressure", "mean_pressure"),
    *("loss_per_cycle", "time_error", "iterations", "residual", "cells_across", "outcome"),
)


def is_of_period(name: str, stored: Container[Hashable]) -> bool:
    """Test for a scalar of a period of a line contact, which is shown per unit length."""
    if name in _OF_ENDS:
        return per_length("force") in stored
    return name in _OF_A_PERIOD and per_length(name) in stored


def shown_name(name: str, stored: Container[Hashable]) -> str:
    """Name under which a result shows a scalar: that per unit length in a line contact."""
    return per_length(name) if is_of_period(name, stored) else name


def shown_in(place: Place, stored: Container[Hashable] | None = None) -> list[str]:
    """Names of the scalars shown in a place, in its order; of those of a result, if given."""
    names = [name for name, variable in SCALARS.items() if place & variable.places]
    names = [name for name in names if stored is None or not is_of_period(name, stored)]
    in_table = place in Place.TABLE | Place.KEY
    names = names if in_table else sorted(names, key=lambda name: SCALARS[name].rank)
    if stored is None:
        return names
    # Progress logs are names, without dimensions.
    return (
        scalars_in(stored, names) if hasattr(stored, "dims") else [n for n in names if n in stored]
    )


def labels_in(place: Place, stored: Container[Hashable] | None = None) -> dict[str, str]:
    """Labels of the scalars that `shown_in` names, in its order."""
    return {name: SCALARS[name].label for name in shown_in(place, stored)}


#: Values of a whole run of bodies that adhere, which are attributes of its result.
RUN_VALUES = {
    "pull_off_force": Variable(
        *("N", "largest pull before contact is lost"),
        label="Pull-off force",
        has_error=True,
        places=Place.KEY,
        of=ADHESION,
    ),
    "pull_off_time": Variable(
        *("s", "instant of the largest pull before contact is lost"),
        label="Pull-off time",
        has_error=True,
        of=ADHESION,
    ),
}


def variable_of(name: str) -> Variable:
    """Variable of a scalar, or of a value of a whole run."""
    return RUN_VALUES[name] if name in RUN_VALUES else SCALARS[name]


#: Parts of all results whose scalars have errors.
_PARTS = (MOTION, FRICTION, ROLLING, ADHESION)
ALL_PARTS = (*_PARTS, *map(along_line, ("", *_PARTS)))


def scalars_with_error(parts: Container[str] = ALL_PARTS, over: str = "time") -> list[str]:
    """Names of the scalars whose error is estimated, of contacts with some parts."""
    found = scalars_of(parts, over)
    return [name for name, variable in found.items() if variable.has_error]


#: Said of a value whose stated error is infinite.
MESH_DEPENDENT = "depends on the mesh"

#: Attribute of a result with the allowable values and the verdicts on them.
ALLOWABLE = "allowable"

#: Stresses that may be limited, by name, and what they are.
STRESSES = {"von_mises": "von Mises stress", "max_shear": "Largest shear stress"}

_BAR = "half width of the error bar: inf where the value depends on the mesh, NaN where unknown"


def error_name(name: str) -> str:
    """Name of a variable's error in a result."""
    return f"{name}_error"


#: The errors of scalars, by their own names.
ERRORS = {
    error_name(name): Variable(
        variable.units, f"estimated error of: {variable.long_name}", comment=_BAR
    )
    for name, variable in (CURVES | SCALARS).items()
    if variable.has_error
}


def scalar_attributes(name: str, *, errors: bool) -> dict[str, Any]:
    """Attributes of a scalar, with CF's pointer to its error if the result has errors."""
    variable = (CURVES | SCALARS)[name]
    attributes = variable.attributes
    if (errors and variable.has_error) or error_name(name) in SCALARS:
        attributes["ancillary_variables"] = error_name(name)
    return attributes
