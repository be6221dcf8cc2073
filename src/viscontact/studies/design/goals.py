"""Goals of a design: the scalar that is to be least or largest, and constraints."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

import xarray as xr

from viscontact.results.variables import SCALARS
from viscontact.studies.scalars import At, Value, known_scalar, magnitude
from viscontact.units.formatting import format_quantity, typed_unit
from viscontact.units.parsing import parse_any_quantity

#: Scalars that are to be least, or largest.
Names = str | Sequence[str] | None
#: Most scalars of a trade-off.
MOST_GOALS = 3

_CONSTRAINT = re.compile(r"\s*(\w+)\s*(<=|>=)\s*(.+?)\s*")


@dataclass(frozen=True)
class Goal:
    """Scalar that is to be least, or largest, at an instant."""

    scalar: str
    least: bool
    at: At = "worst"

    def value(self, results: xr.Dataset) -> Value:
        """Magnitude of the scalar in a run, at its instant: for "worst", the one farthest off."""
        return magnitude(results, self.scalar, self.at, largest=self.least)

    def cost(self, value: float) -> float:
        """Number that is smaller for a better value."""
        return value if self.least else -value

    def __str__(self) -> str:
        return f"{'least' if self.least else 'largest'} {self.scalar}"


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


def goals_of(minimise: Names, maximise: Names, at: At) -> tuple[Goal, ...]:
    """Return the goals of `design`; ValueError if an argument does not fit."""
    least, largest = _names(minimise), _names(maximise)
    if not least and not largest:
        raise ValueError("give minimise or maximise, e.g. minimise='peak_pressure'")
    if isinstance(at, str) and at not in ("worst", "end"):
        raise ValueError(f"at: must be 'worst', 'end' or a time [s], got {at!r}")
    goals = [Goal(known_scalar("minimise", name), True, at) for name in least]
    goals += [Goal(known_scalar("maximise", name), False, at) for name in largest]
    names = [each.scalar for each in goals]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise ValueError(f"{twice}: is given twice, in minimise or maximise; give it once")
    if len(goals) > MOST_GOALS:
        raise ValueError(f"minimise, maximise: {MOST_GOALS} scalars at most, got {len(goals)}")
    return tuple(goals)


def _names(given: Names) -> list[str]:
    return [given] if isinstance(given, str) else list(given or ())


def constraints_of(texts: Sequence[str]) -> tuple[Constraint, ...]:
    """Read constraints, as ``contact_length<=18mm``; ValueError names the fault."""
    if isinstance(texts, str):
        raise ValueError(f"constraints: must be a list, as [{texts!r}]")
    found = tuple(given_constraint("constraints", text) for text in texts)
    for upper in found:
        for lower in found:
            same = upper.scalar == lower.scalar and upper.upper and not lower.upper
            if same and lower.bound > upper.bound:
                raise ValueError(f"constraints: {upper} and {lower} contradict each other")
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
