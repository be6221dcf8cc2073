"""Names of runs that differ in one number, such as those of a sweep over one key."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from viscontact.drawing.content.panel import Ink
from viscontact.units.parsing import parse_any_quantity

_Run = TypeVar("_Run")

_NUMBER = re.compile(r"(?:(?<![\w.])-)?\d+\.?\d*(?:e[+-]?\d+)?\s?(?:[A-Za-zµ°%]+(?:/[A-Za-z]+)?)?")
#: Least number of runs with colours from a scale.
_FEW = 3


def ordered_values(names: Iterable[str]) -> list[float] | None:
    """SI values of the only number in which names differ; None for other names."""
    texts = list(names)
    numbers = [_NUMBER.findall(text) for text in texts]
    if len({_NUMBER.sub("#", text) for text in texts}) != 1 or len(texts) < 2:
        return None
    varied = [column for column in zip(*numbers, strict=True) if len(set(column)) > 1]
    if len(varied) != 1:
        return None
    try:
        found = [parse_any_quantity(text) for text in varied[0]]
    except ValueError:
        return None
    return [value for value, _ in found] if len({unit for _, unit in found}) == 1 else None


def in_order(runs: Mapping[str, _Run]) -> dict[str, _Run]:
    """Runs in the order of the number in which their names differ; unchanged for other names."""
    values = ordered_values(runs)
    if values is None:
        return dict(runs)
    return {name: runs[name] for _, name in sorted(zip(values, runs, strict=True))}


def inks_of(names: Sequence[str]) -> list[Ink]:
    """Colours of a scale for three or more runs that differ in a number, else distinct ones."""
    values = ordered_values(names)
    if values is None or len(names) < _FEW:
        return [Ink(place=number) for number in range(len(names))]
    ranks = {value: rank for rank, value in enumerate(sorted(set(values)))}
    last = max(1, *ranks.values())
    return [Ink("ordered", ranks[value] / last) for value in values]
