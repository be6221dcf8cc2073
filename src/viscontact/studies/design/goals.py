"""Goals of a design: the scalar or parameter that is to be least or largest, and constraints."""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Literal

import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.sweep_axes import key_label
from viscontact.results.variables import SCALARS
from viscontact.studies.scalars import At, Value, known_scalar, magnitude
from viscontact.studies.space import Choice, Space
from viscontact.units.formatting import format_quantity, typed_unit
from viscontact.units.parsing import parse_any_quantity

#: Scalars or parameters that are to be least, or largest.
Names = str | Sequence[str] | None
#: Most goals of a trade-off.
MOST_GOALS = 3
#: Value of what has none.
NONE = Value(math.nan, math.nan)

_CONSTRAINT = re.compile(r"\s*(\w+)\s*(<=|>=)\s*(.+?)\s*")


@dataclass(frozen=True)
class Goal(ABC):
    """What is to be least, or largest, by its name."""

    name: str
    least: bool
    at: At = "worst"  # instant of a scalar

    @property
    @abstractmethod
    def units(self) -> str:
        """SI unit."""

    @property
    def label(self) -> str:
        """Name in words."""
        return key_label(self.name)

    @property
    def entries(self) -> tuple[str, ...]:
        """Names of the values that are taken from a run."""
        return ()

    def taken(self, results: xr.Dataset) -> dict[str, Value]:
        """Values that are taken from a run, by the names of `entries`."""
        return {}

    @abstractmethod
    def value(self, settings: Mapping[str, str], values: Mapping[str, Value]) -> Value:
        """Value of a trial with settings in a run that gave values; NaN if it gave none."""

    def cost(self, value: float) -> float:
        """Number that is smaller for a better value."""
        return value if self.least else -value

    def __str__(self) -> str:
        return f"{'least' if self.least else 'largest'} {self.name}"


@dataclass(frozen=True)
class ScalarGoal(Goal):
    """Scalar of a result that is to be least, or largest, at an instant."""

    @property
    def units(self) -> str:
        """SI unit."""
        return SCALARS[self.name].units

    @property
    def label(self) -> str:
        """Name in words."""
        return SCALARS[self.name].label

    @property
    def entries(self) -> tuple[str, ...]:
        """Name of the scalar at its instant."""
        return (f"{self.name} at {self.at}",)

    def taken(self, results: xr.Dataset) -> dict[str, Value]:
        """Magnitude of the scalar in a run, at its instant: for "worst", the one farthest off."""
        found = magnitude(results, self.name, self.at, largest=self.least)
        return dict.fromkeys(self.entries, found)

    def value(self, settings: Mapping[str, str], values: Mapping[str, Value]) -> Value:
        """Value that was taken from the run."""
        return values.get(self.entries[0], NONE)


@dataclass(frozen=True)
class ParameterGoal(Goal):
    """Parameter that is to be least, or largest, which is known without a run."""

    si: str = "1"  # unit
    own: str = ""  # value of the case; empty where it has none

    @property
    def units(self) -> str:
        """SI unit."""
        return self.si

    def value(self, settings: Mapping[str, str], values: Mapping[str, Value]) -> Value:
        """Value of the parameter, without error; NaN if the run failed."""
        return Value(self.number(settings), 0.0) if values else NONE

    def number(self, settings: Mapping[str, str]) -> float:
        """Value of the parameter with settings [SI]; NaN if there is none."""
        text = settings.get(self.name, self.own)
        return parse_any_quantity(text)[0] if text else math.nan


@dataclass(frozen=True)
class Constraint:
    """Bound on the magnitude of a scalar at all instants of all scenarios."""

    scalar: str
    upper: bool  # the bound is the largest allowed magnitude, else the least
    bound: float  # SI

    def value(self, results: xr.Dataset) -> Value:
        """The magnitude that comes closest to the bound, or exceeds it most."""
        return magnitude(results, self.scalar, "worst", largest=self.upper)

    def violation(self, value: float) -> float:
        """Excess over the bound, relative to it; below zero if the bound is kept."""
        scale = abs(self.bound) or 1.0
        excess = (value - self.bound) / scale
        return math.inf if math.isnan(value) else excess if self.upper else -excess

    @property
    def units(self) -> str:
        """SI unit."""
        return SCALARS[self.scalar].units

    def __str__(self) -> str:
        sign = "<=" if self.upper else ">="
        return f"{self.scalar} {sign} {format_quantity(self.bound, self.units)}"


def goals_of(
    minimise: Names, maximise: Names, at: At, space: Space, own: Mapping[str, str]
) -> tuple[Goal, ...]:
    """Return the goals of `design`; ValueError if an argument does not fit.

    `own` are the values of the parameters in the case.
    """
    least, largest = _names(minimise), _names(maximise)
    if not least and not largest:
        raise ValueError("give minimise or maximise, e.g. minimise='peak_pressure'")
    if isinstance(at, str) and at not in ("worst", "end"):
        raise ValueError(f"at: must be 'worst', 'end' or a time [s], got {at!r}")
    goals = [_goal("minimise", name, at, space, own) for name in least]
    goals += [_goal("maximise", name, at, space, own) for name in largest]
    names = [each.name for each in goals]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise ValueError(f"{twice}: is given twice, in minimise or maximise; give it once")
    if len(goals) > MOST_GOALS:
        raise ValueError(f"minimise, maximise: {MOST_GOALS} scalars at most, got {len(goals)}")
    if at != "worst" and not any(isinstance(each, ScalarGoal) for each in goals):
        raise ValueError(
            "at: is the place of a scalar that is to be least or largest; constraints are kept at "
            "all of them; leave it out"
        )
    return tuple(goals)


def require_bounds(goals: Sequence[Goal], constraints: Sequence[Constraint]) -> None:
    """Raise ValueError for a parameter that nothing but its range bounds."""
    if constraints or not all(isinstance(each, ParameterGoal) for each in goals):
        return
    goal = goals[0]
    raise ValueError(
        f"{'minimise' if goal.least else 'maximise'}: {goal.name}: is a parameter, and nothing but "
        "its range bounds it; give a constraint, as 'peak_pressure<=1.2MPa'"
    )


def _goal(
    argument: Literal["minimise", "maximise"],
    name: str,
    at: At,
    space: Space,
    own: Mapping[str, str],
) -> Goal:
    """Goal of a scalar, or of a parameter, whose key has a dot."""
    least = argument == "minimise"
    if name not in space.keys and "." not in name:
        return ScalarGoal(known_scalar(argument, name), least, at)
    if name not in space.keys:
        raise ValueError(
            f"{argument}: {name}: is a key that is not changed, so that its value stays the same; "
            f"give it a range among the parameters ({', '.join(space.keys)}), or name a scalar of "
            "the result"
        )
    parameter = space.parameters[space.keys.index(name)]
    texts = parameter.values if isinstance(parameter, Choice) else (parameter.value(0.0),)
    try:
        units = {parse_any_quantity(text)[1] for text in texts}
    except ValueError:
        units = set()
    if len(units) != 1:
        raise ValueError(
            f"{argument}: {name}: its values are no quantities of one unit, of which one could be "
            f"the {'least' if least else 'largest'}; name a scalar of the result"
        )
    return ParameterGoal(name, least, si=units.pop(), own=own.get(name, ""))


def _names(given: Names) -> list[str]:
    return [given] if isinstance(given, str) else list(given or ())


def constraints_of(texts: Sequence[str]) -> tuple[Constraint, ...]:
    """Read constraints, as ``contact_length<=18mm``; ValueError names the fault."""
    found = tuple(given_constraint("constraints", text) for text in texts)
    for upper in found:
        for lower in found:
            same = upper.scalar == lower.scalar and upper.upper and not lower.upper
            if same and lower.bound > upper.bound:
                raise ValueError(f"constraints: {upper} and {lower} contradict each other")
    return found


def with_limits(texts: Sequence[str], limits: Mapping[str, float]) -> list[str]:
    """Constraints with numbers for ``<=allowable``: the limits of the case [SI], by name."""
    if isinstance(texts, str):
        raise ValueError(f"constraints: must be a list, as [{texts!r}]")
    found = list(texts)
    for place, text in enumerate(found):
        name, sign, bound = text.partition("<=")
        scalar = name.strip()
        if not sign or bound.strip() != "allowable":
            continue
        if scalar not in limits or scalar not in SCALARS:
            known = ", ".join(each for each in limits if each in SCALARS) or "none of a scalar"
            raise ValueError(
                f"constraints: {text}: the case has no allowable {scalar}; it has {known}; write "
                "a value"
            )
        found[place] = f"{scalar}<={limits[scalar]!r} {SCALARS[scalar].units}"
    return found


def given_constraint(argument: str, text: str) -> Constraint:
    """Bound of a scalar, as ``contact_length<=18mm``; ValueError begins with the argument."""
    match = _CONSTRAINT.fullmatch(text)
    if match is None:
        raise ValueError(
            f"{argument}: write SCALAR<=VALUE or SCALAR>=VALUE, as 'contact_length<=18mm', got "
            f"{text!r}"
        )
    name, sign, quantity = match.groups()
    scalar = known_scalar(argument, name)
    unit = SCALARS[scalar].units
    try:
        bound, given = parse_any_quantity(quantity)
    except ValueError as error:
        raise ValueError(f"{argument}: {text}: {error}") from None
    if given != typed_unit(unit):
        raise ValueError(f"{argument}: {text}: must have a unit of [{unit}], got {quantity!r}")
    return Constraint(scalar, sign == "<=", bound)
