"""Scenarios of a design: the values under which each trial counts, and their scatter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from itertools import product
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.space import Choice, Range, Space, given_scatter
from viscontact.studies.sweep.designs import NOTHING_VARIED, Design, EqualValuesError, grid_design
from viscontact.units.parsing import parse_any_quantity
from viscontact.units.tolerances import read_toleranced

#: Most keys that scatter: each trial takes a run for all corners of their ranges.
MOST_SCATTERED = 3


@dataclass(frozen=True)
class Deviation:
    """Deviation of a parameter from the value that is tried."""

    text: str
    own: str  # value of the case, for the trial without others

    def added_to(self, value: str) -> str:
        """Sum of a value and the deviation, in the SI unit."""
        number, unit = parse_any_quantity(value or self.own)
        amount, _ = parse_any_quantity(self.text)
        return f"{number + amount:.12g} {unit}" if unit != "1" else f"{number + amount:.12g}"


@dataclass(frozen=True)
class Scenario:
    """Values of the case by key, and deviations from the values of the trial by key."""

    name: str
    values: Mapping[str, str] = field(default_factory=dict)
    deviations: Mapping[str, Deviation] = field(default_factory=dict)

    def settings(self, trial: Mapping[str, str]) -> dict[str, str]:
        """Values of the run of a trial."""
        changed = {key: each.added_to(trial.get(key, "")) for key, each in self.deviations.items()}
        return {**self.values, **trial, **changed}


def scenarios_of(
    over: Mapping[str, Sequence[Any]] | None,
    scatter: Mapping[str, Any] | None,
    space: Space,
    own: Mapping[str, str],
) -> list[Scenario]:
    """All scenarios of `design`, those of `over` at every corner of `scatter`; ValueError."""
    given, spread = _plan_of(over), _scattered_ranges(scatter, space, own)
    found = []
    for row, corner in product(range(len(given.rows)), _corners(spread)):
        values = dict(zip(given.keys, given.rows[row], strict=True))
        texts = {key: text for key, text in corner.items() if key not in space.keys}
        deviations = {
            key: Deviation(text, own[key]) for key, text in corner.items() if key in space.keys
        }
        apart = "with " + ", ".join(f"{_short_key(key)} {text}" for key, text in corner.items())
        name = f"{given.name(row)} {apart if corner else ''}".strip()
        found.append(Scenario(name, {**values, **texts}, deviations))
    return found


def _plan_of(over: Mapping[str, Sequence[Any]] | None) -> Design:
    if not over:
        return NOTHING_VARIED
    for key, values in over.items():
        if isinstance(values, str) or not len(values):
            raise ValueError(
                f"over: {key}: must be a list of values, as ['0 mm', '5 mm'], got {values!r}"
            )
    try:
        return grid_design({key: [str(value) for value in values] for key, values in over.items()})
    except EqualValuesError as error:
        raise ValueError(f"over: {error}") from None


def _scattered_ranges(
    scatter: Mapping[str, Any] | None, space: Space, own: Mapping[str, str]
) -> list[Range]:
    """Ranges of the scattered keys: deviations for a parameter, values for any other key."""
    given = scatter or {}
    if len(given) > MOST_SCATTERED:
        raise ValueError(f"scatter: must have {MOST_SCATTERED} keys at most, got {len(given)}")
    choices = {each.key for each in space.parameters if isinstance(each, Choice)}
    found = []
    for key, bounds in given.items():
        if key in space.keys and isinstance(bounds, str) and (own_one := read_toleranced(bounds)):
            bounds = f"± {own_one.deviation}"  # which of a parameter is all
        found.append(given_scatter("scatter", key, bounds, is_sampled=False).bounds)
        if key in choices:
            raise ValueError(f"scatter: {key}: is a choice between values, which cannot deviate")
        if key in space.keys:
            _require_deviations(found[-1], own)
    return found


def _require_deviations(found: Range, own: Mapping[str, str]) -> None:
    low, high = found.value(0.0), found.value(1.0)
    if not found.low <= 0 <= found.high:
        raise ValueError(
            f"scatter: {found.key}: is changed, so that its scatter is a deviation from each value "
            f"that is tried, as ('-0.02 mm', '0.02 mm'), got {low} and {high}"
        )
    if found.key not in own:
        raise ValueError(f"scatter: {found.key}: give the case a value of it, which can deviate")


def _corners(ranges: Sequence[Range]) -> list[dict[str, str]]:
    """Nominal values, which are none, and all combinations of both ends of the ranges."""
    ends = product(*((each.value(0.0), each.value(1.0)) for each in ranges))
    corners = [{each.key: text for each, text in zip(ranges, texts, strict=True)} for texts in ends]
    return [{}, *corners] if ranges else [{}]


def _short_key(key: str) -> str:
    return key.rpartition(".")[2]
