"""Aliases of the keys of a case file: a designer's words, resolved to the canonical keys."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from copy import deepcopy
from dataclasses import field
from decimal import Decimal
from typing import Any

from pydantic import BaseModel
from pydantic_core import PydanticCustomError

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case.errors import KeyPath
from viscontact.case.indenters.shapes import AnyShape
from viscontact.case.loads.load import AnyLoad
from viscontact.case.motion import AnyMotion
from viscontact.case.quantities import POSITIVE, WithUnit
from viscontact.case.section_choice import alternatives
from viscontact.units.parsing import parse_quantity

_LENGTH = WithUnit("length", POSITIVE)
_FREQUENCY = WithUnit("frequency", POSITIVE)

#: Sections with aliases: the key that names their kind, and the kinds.
_SECTIONS: dict[str, tuple[str, dict[str | int, type[BaseModel]]]] = {
    "indenter": ("shape", alternatives(AnyShape)),
    "load": ("kind", alternatives(AnyLoad)),
    "motion": ("kind", alternatives(AnyMotion)),
}
_SHAPES = _SECTIONS["indenter"][1]

#: Profiles of a roller whose half length is that of the straight part only.
_CONTINUED = ("partial", "two-radii")

_NUMBER = re.compile(r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?P<unit>.*)")


@dataclass(frozen=True)
class Alias:
    """Key that may stand in place of the canonical one, which it determines."""

    name: str
    canonical: str
    description: str
    example: str
    dimension: str = "length"


_FREQUENT = Alias("frequency", "period", "cycles per time, in place of period", "1 Hz", "frequency")

#: Aliases by the section in which they stand.
ALIASES: dict[str, tuple[Alias, ...]] = {
    "indenter": (
        Alias("diameter", "radius", "twice the radius, in place of radius", "10 mm"),
        Alias(
            "counter_diameter",
            "counter_radius",
            "diameter of a second roll, in place of counter_radius",
            "120 mm",
        ),
        Alias(
            "straight_length",
            "half_length",
            "length of the straight part, which a circular crown continues, in place of "
            "half_length",
            "18 mm",
        ),
        Alias(
            "length",
            "half_length",
            "total length, from end to end: in place of half_length; with a circular crown in "
            "place of profile.end_length, beside the length of the straight part",
            "20 mm",
        ),
    ),
    "load": (
        _FREQUENT,
        Alias(
            "misalignment",
            "tilt_x",
            "prescribed tilt along a roller, in place of tilt_x",
            "0.5 mrad",
            "angle",
        ),
    ),
    "motion": (_FREQUENT,),
}
#: Aliases that are lengths of a roller.
_OF_ROLLERS = ("straight_length", "length")


@dataclass
class CanonicalData:
    """Data of a case with canonical keys only."""

    data: dict[str, Any]
    typed: dict[KeyPath, KeyPath] = field(default_factory=dict)  # alias, by canonical key
    values: dict[KeyPath, Any] = field(default_factory=dict)  # as typed, by alias
    problems: list[tuple[KeyPath, str]] = field(default_factory=list)

    def rename(self, old: KeyPath, new: KeyPath, value: Any) -> None:
        """Put a value under a canonical key, at the place of the alias."""
        parent, target = value_at(self.data, old[:-1]), value_at(self.data, new[:-1])
        self.values[old] = parent[old[-1]]
        if parent is target and new[-1] not in parent:
            items = list(parent.items())
            parent.clear()
            parent.update(
                (new[-1], value) if key == old[-1] else (key, each) for key, each in items
            )
        else:
            del parent[old[-1]]
            target[new[-1]] = value
        self.typed[new] = old


def resolved(data: dict[str, Any]) -> CanonicalData:
    """Replace the aliases in the data of a case."""
    if not any(True for _ in _aliases_in(data)):
        return CanonicalData(data)
    found = CanonicalData(deepcopy(data))
    for path, alias in list(_aliases_in(data)):
        _resolve(found, path, alias)
    return found


def canonical_path(data: dict[str, Any], path: KeyPath) -> KeyPath | None:
    """Path of the canonical key that an alias stands for; None for any other key."""
    for found, alias in _aliases_in(data):
        if found == path:
            return (*path[:-1], *_target(value_at(data, path[:-1]), alias))
    return None


def known_aliases(model: type[BaseModel]) -> list[Alias]:
    """Aliases of the keys of a section."""
    return [
        alias
        for name, (_, models) in _SECTIONS.items()
        if model in models.values()
        for alias in ALIASES[name]
        if _is_known(alias, model)
    ]


def aliases_of(model: type[BaseModel], key: str) -> list[Alias]:
    """Aliases of a key of a section."""
    return [alias for alias in known_aliases(model) if alias.canonical == key]


def value_at(data: Any, path: KeyPath) -> Any:
    """Value at a path, None where there is none."""
    for step in path:
        try:
            data = data[step]
        except (KeyError, IndexError, TypeError):
            return None
    return data


def _aliases_in(data: Mapping[str, Any]) -> Iterator[tuple[KeyPath, Alias]]:
    """Yield the aliases in the sections of a case; shapes of a sum one by one."""
    for name, (kind, models) in _SECTIONS.items():
        section = data.get(name)
        parts: list[tuple[KeyPath, Any]] = [((name,), section)]
        if isinstance(section, list):
            parts = [((name, place), part) for place, part in enumerate(section)]
        for path, part in parts:
            if not isinstance(part, dict):
                continue
            model = models.get(str(part.get(kind)))
            for alias in ALIASES[name]:
                # In a section of an unknown kind any alias is accepted.
                if alias.name in part and (model is None or _is_known(alias, model)):
                    yield (*path, alias.name), alias


def _is_known(alias: Alias, model: type[BaseModel]) -> bool:
    """True if an alias stands for a key of a section; lengths are those of a roller."""
    if alias.name in _OF_ROLLERS and model is not _SHAPES["roller"]:
        return False
    return alias.canonical in model.model_fields and alias.name not in model.model_fields


def _resolve(found: CanonicalData, path: KeyPath, alias: Alias) -> None:
    section = value_at(found.data, path[:-1])
    target = _target(section, alias)
    canonical = (*path[:-1], *target)
    if value_at(found.data, canonical) is not None:
        other = found.typed.get(canonical, canonical)[len(path) - 1 :]
        same = ".".join(map(str, other))
        found.problems.append((path, f"{alias.name} and {same} exclude each other; give one"))
        del section[alias.name]
        return
    refusal = _refusal(found.data, section, alias)
    value, why = _canonical_value(alias, section[alias.name])
    if refusal or why:
        found.problems.append((path, refusal or why))
    if len(target) == 2:
        profile = section.get("profile") or "partial"
        section["profile"] = profile if isinstance(profile, dict) else {"kind": profile}
    found.rename(path, canonical, value)


def _target(section: Mapping[str, Any], alias: Alias) -> tuple[str, ...]:
    """Canonical key of an alias: the end of a crowned roller is a key of its profile."""
    if alias.name == "length" and _is_continued(section):
        return ("profile", "end_length")
    return (alias.canonical,)


def _is_continued(section: Mapping[str, Any]) -> bool:
    """True for a roller whose straight part is continued by circular crowns."""
    profile = section.get("profile")
    kind = profile.get("kind") if isinstance(profile, dict) else profile
    return kind in _CONTINUED or (profile is None and section.get("crown_radius") is not None)


def _refusal(data: Mapping[str, Any], section: Mapping[str, Any], alias: Alias) -> str:
    """Reason why an alias does not apply to the case; empty if it does."""
    if alias.name == "straight_length" and not _is_continued(section):
        return (
            "goes with circular crowns (crown_radius, or the profiles partial and two-radii); "
            "give length, the total length"
        )
    if alias.name == "misalignment":
        shapes = data.get("indenter")
        shapes = shapes if isinstance(shapes, list) else [shapes]
        known = [each for each in shapes if isinstance(each, dict) and each.get("shape") in _SHAPES]
        rollers = [each for each in known if each["shape"] == "roller"]
        if known and not rollers:
            return "is the tilt along a roller, and there is none; give tilt_x or tilt_y"
        if any("rotation" in each for each in rollers):
            return "is the tilt along a roller that lies along x; give tilt_x and tilt_y"
    return ""


def _canonical_value(alias: Alias, given: Any) -> tuple[Any, str]:
    """Value of the canonical key, and a problem; an invalid length is left to the canonical key."""
    if alias.dimension == "angle":
        return given, ""
    try:
        value = (_FREQUENCY if alias.dimension == "frequency" else _LENGTH).read(given)
    except PydanticCustomError as error:
        return ("1 s", error.message()) if alias.dimension == "frequency" else (given, "")
    return (f"{1 / value!r} s" if alias.dimension == "frequency" else _half(given, value)), ""


def _half(text: str, value: float) -> str:
    """Half of a length [m], in the unit of its text and without rounding."""
    match = _NUMBER.fullmatch(text)
    if match is not None:
        half = f"{Decimal(match['number']) / 2:f}{match['unit']}"
        if abs(parse_quantity(half, "length") - value / 2) <= 1e-15 * value:
            return half
    return f"{value / 2!r} m"


def with_aliases(schema: dict[str, Any]) -> dict[str, Any]:
    """Return the JSON schema of case files with the aliases, each with `x-alias-of`."""
    whole = deepcopy(schema)
    for name, (key, models) in _SECTIONS.items():
        for definition in whole["$defs"].values():
            chosen = definition.get("properties", {}).get(key, {}).get("const")
            if chosen in models and definition["title"] == models[chosen].__name__:
                known = [each for each in ALIASES[name] if _is_known(each, models[chosen])]
                _add(definition, known)
    return whole


def _add(definition: dict[str, Any], aliases: list[Alias]) -> None:
    """Add aliases to the schema of a section: one of them, or the canonical key."""
    properties, required = definition["properties"], definition.get("required", [])
    for alias in aliases:
        properties[alias.name] = {
            "type": ["string", "number"] if alias.dimension == "angle" else "string",
            "description": alias.description,
            "examples": [alias.example],
            "x-alias-of": alias.canonical,
        }
    for key in dict.fromkeys(alias.canonical for alias in aliases):
        names = [key, *(alias.name for alias in aliases if alias.canonical == key)]
        choice = [{"required": [name]} for name in names]
        if key in required:
            required.remove(key)
            # The total length of a crowned roller is given beside that of its straight part.
            rule: dict[str, Any] = {"anyOf" if len(names) > 2 else "oneOf": choice}
        else:
            rule = {"not": {"required": names}}
        definition.setdefault("allOf", []).append(rule)
