"""Values of ``--set`` in place of those in the file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from copy import deepcopy
from dataclasses import replace
from typing import Any

from viscontact.bodies.materials import library
from viscontact.case import yaml_source
from viscontact.case.aliases import CanonicalData, canonical_path, resolved, value_at
from viscontact.case.document import Document
from viscontact.case.errors import CaseError, KeyPath, SourceError, dotted
from viscontact.case.tolerances import nominal

_STEP = re.compile(r"\.?([^.\[\]=]+)|\[(\d+)\]")


def override(document: Document, settings: Iterable[str]) -> Document:
    """Put the values of ``--set`` into a document."""
    values = dict(_setting(text) for text in settings)
    if not values:
        return document
    data = deepcopy(document.data)
    problems = [why for path, value in values.items() if (why := _set_value(data, path, value))]
    if problems:
        raise CaseError(*problems)
    for path in values:
        canonical = canonical_path(data, path)
        if canonical and canonical not in values and value_at(data, canonical) is not None:
            del value_at(data, canonical[:-1])[canonical[-1]]
    plain = nominal(data)
    found = resolved(plain.data)
    # A setting of a key, or of its section, replaces the alias in the file.
    kept = [key for key in document.aliases if not any(key[: len(path)] == path for path in values)]
    aliases = {key: document.aliases[key] for key in kept}
    return replace(
        document,
        data=found.data,
        overrides=_canonical(document, found, values),
        aliases={**aliases, **found.typed},
        of_aliases={**document.of_aliases, **found.values},
        misused=(*document.misused, *plain.problems, *found.problems),
        tolerances={**_tolerances(document, data, values), **plain.tolerances},
    )


def _tolerances(document: Document, data: Any, values: Iterable[KeyPath]) -> dict[KeyPath, str]:
    """Tolerances of the file whose keys, as typed or canonical, no setting replaces."""
    typed = {alias: key for key, alias in document.aliases.items()}
    replaced = {*values, *(canonical_path(data, path) for path in values)}
    return {
        path: text
        for path, text in document.tolerances.items()
        if not any(
            path[:length] in replaced or typed.get(path, ())[:length] in replaced
            for length in range(1, len(path) + 1)
        )
    }


def key_path(name: str) -> KeyPath:
    """Steps of a dotted key, with entries of lists numbered from 0; empty if it is none."""
    steps = _STEP.findall(name.strip())
    rebuilt = "".join(f"[{index}]" if index else f".{key}" for key, index in steps)
    if rebuilt.removeprefix(".") != name.strip():
        return ()
    return tuple(int(index) - 1 if index else key for key, index in steps)


def _canonical(
    before: Document, found: CanonicalData, values: Iterable[KeyPath]
) -> dict[KeyPath, Any]:
    """Values of ``--set`` in the resolved data, under canonical keys."""
    canonical, settings = {old: new for new, old in found.typed.items()}, {}
    for path in values:
        key = canonical.get(path, path)
        if path in canonical and not isinstance(value_at(before.data, key[:-1]), dict):
            key = key[:-1]  # a profile that was a name, or missing
        key = _from_name_on(before.data, key)
        if (value := value_at(found.data, key)) is not None or path not in canonical:
            settings[key] = value
    return settings


def _setting(text: str) -> tuple[KeyPath, Any]:
    name, equals, value = text.partition("=")
    path = key_path(name)
    if not (equals and path):
        raise CaseError(f"--set {text}: write KEY=VALUE, e.g. --set load.force=20kN")
    try:
        return path, yaml_source.parse_value(value)
    except SourceError as problem:
        raise CaseError(f"--set {name}: cannot read the value {value!r}: {problem}") from problem


def _set_value(data: Any, path: KeyPath, value: Any) -> str | None:
    """Set a value; return the reason if that is impossible."""
    root = data
    if whole := len(path) > 1 and _in_section(data, path):
        return f"--set {dotted(path)}: did you mean {dotted(whole)}?"
    for position, step in enumerate(path):
        if position and _is_name(data, path[position - 1]) and step != "material":
            # A key of a material that is a name: {material: NAME} with this key.
            data = value_at(root, path[: position - 1])
            data[path[position - 1]] = {"material": data[path[position - 1]]}
            data = data[path[position - 1]]
        if not (_takes_keys(data, step) or _has_entry(data, step)):
            return f"--set {dotted(path)}: {_why_not(data, step, path[:position])}"
        if position == len(path) - 1:
            data[step] = value
        elif isinstance(data, dict) and data.get(step) is None:  # also an empty section
            data[step] = {}
        data = data[step]
    return None


def _takes_keys(data: Any, step: str | int) -> bool:
    return isinstance(data, dict) and isinstance(step, str)


def _from_name_on(data: Any, path: KeyPath) -> KeyPath:
    """Path up to a material that was a name, all of which the settings replace."""
    lengths = range(1, len(path))
    return next((path[:n] for n in lengths if isinstance(value_at(data, path[:n]), str)), path)


def _is_name(value: Any, key: str | int) -> bool:
    """True for a name of the library in place of a material."""
    return key in ("material", "indenter_material", "base") and value in library.names()


def _in_section(data: Any, path: KeyPath) -> KeyPath:
    """Path within the section of a case that has it, where it was left out; else empty."""
    sections = [(name,) for name in data if isinstance(name, str)] if path[0] not in data else []
    found = [
        (*name, *path)
        for name in sections
        if isinstance(value_at(data, (*name, *path[:-1])), dict | list)
    ]
    return found[0] if len(found) == 1 else ()


def _why_not(data: Any, step: str | int, path: KeyPath) -> str:
    where = dotted(path) or "the case file"
    if isinstance(data, list):
        return f"{where} is a list, its entries are [1] to [{len(data)}]"
    if isinstance(step, int):
        return f"{where} is not a list; leave [{step + 1}] out"
    return f"{where} is {str(data)[:40]!r}, without keys"


def _has_entry(data: Any, step: str | int) -> bool:
    if isinstance(data, list):
        return isinstance(step, int) and 0 <= step < len(data)
    return isinstance(data, dict) and step in data
