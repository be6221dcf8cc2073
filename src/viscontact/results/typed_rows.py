"""Values of a section of a case file as they were typed: names and texts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

#: Keys that say what a section is: within a section it goes by its own name.
_KINDS = ("shape", "law", "kind")
#: Longer lists are shown by their ends.
_MOST_LISTED = 8


def typed_rows(section: Any, owner: str = "") -> Iterator[tuple[str, str]]:
    """Yield names, as those of `argument_rows`, and texts of the values of a nested section."""
    if isinstance(section, str):  # the name of a material in the library
        yield owner or "name", section
    elif isinstance(section, list):
        for index, each in enumerate(section, 1):
            yield from typed_rows(each, f"{owner} part {index}".strip())
    elif isinstance(section, dict):
        for key, value in section.items():
            yield from _rows(str(key), value, owner)


def _rows(key: str, value: Any, owner: str) -> Iterator[tuple[str, str]]:
    words = key.replace("_", " ").replace("poisson", "Poisson's")
    name = owner if owner and key in _KINDS else f"{owner} {words}".strip()
    if isinstance(value, dict):
        yield from typed_rows(value, name)
    elif isinstance(value, list) and value and all(isinstance(each, dict) for each in value):
        one = "layer" if key == "layers" else "part"
        for index, each in enumerate(value, 1):
            yield from typed_rows(each, f"{owner} {one} {index}".strip())
    elif value is not None:
        yield name, _text(value)


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, list):
        return str(value)
    texts = [f"({_text(each)})" if isinstance(each, list) else _text(each) for each in value]
    if len(texts) > _MOST_LISTED:
        return f"{len(texts)} values, from {texts[0]} to {texts[-1]}"
    return ", ".join(texts)
