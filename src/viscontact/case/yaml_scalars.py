"""Values of a YAML text, written over in their places: all other characters stay."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any

from ruamel.yaml import YAML, MappingNode, Node, ScalarNode, SequenceNode
from ruamel.yaml.error import ReusedAnchorWarning

from viscontact.case.errors import KeyPath

# Number and unit, a text in any place. A letter right behind a number may belong to it, as in 1e3
# or 0x10.
_QUANTITY = re.compile(
    r"[+-]?\d+\.?\d*(?:[eE][+-]?\d+)?(?: [A-Za-zµμΩ°%/]|[A-DF-WYZacdf-np-wyzµμΩ°])"
    r"[\wµμΩ°%/*^-]*"
)


def written_over(text: str, values: Mapping[KeyPath, Any]) -> str | None:
    """Return the text with other numbers and quantities; None if the whole has to be written anew.

    Examples
    --------
    >>> written_over("load: {force: 1 N}  # on top", {("load", "force"): "2 N"})
    'load: {force: 2 N}  # on top'
    >>> written_over("load: {force: 1 N}", {("load", "kind"): "step"})
    """
    places = _places(text)
    if not all(path in places and _is_plain(value) for path, value in values.items()):
        return None
    for path in sorted(values, key=places.__getitem__, reverse=True):
        start, end = places[path]
        text = f"{text[:start]}{values[path]}{text[end:]}"
    return text


def _is_plain(value: Any) -> bool:
    """Whether a value is read again as what it is, wherever it is written."""
    if isinstance(value, str):
        return _QUANTITY.fullmatch(value) is not None
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


@lru_cache(maxsize=4)  # a study writes other values into the same text again and again
def _places(text: str) -> dict[KeyPath, tuple[int, int]]:
    """First and last character of each scalar that stands in one place of a valid text."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ReusedAnchorWarning)
        document = YAML(typ="rt", pure=True).compose(text)
    return dict(_places_in(document, (), text))


def _places_in(node: Node | None, path: KeyPath, text: str) -> Iterator[tuple[KeyPath, Any]]:
    if node is None or node.anchor is not None:  # it may stand in other places, too
        return
    if isinstance(node, MappingNode):
        for key, value in node.value:
            yield from _places_in(value, (*path, str(key.value)), text)
    elif isinstance(node, SequenceNode):
        for number, value in enumerate(node.value):
            yield from _places_in(value, (*path, number), text)
    elif isinstance(node, ScalarNode):
        start, end = node.start_mark.index, node.end_mark.index
        if node.value and text[start:end] == node.value:  # neither tagged, quoted nor folded
            yield path, (start, end)
