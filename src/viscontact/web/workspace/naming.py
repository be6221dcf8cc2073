"""Titles and labels that distinguish cases and runs."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import count
from typing import Any

from viscontact.results.argument_table import PEOPLE
from viscontact.runs.directory.differences import differences

#: Keys that identify a shape and a law; the first one present is used.
_SIZES = ("radius", "radius_x", "half_angle", "semi_axis_x", "ring_radius", "amplitude", "file")
_MODULI = ("shear_modulus", "youngs_modulus", "file")
#: Keys of the load's level.
_LEVELS = ("force", "line_load", "approach", "mean_pressure", "mean")
_SECTIONS = ("indenter", "indenter_material", "material", "load", "time")
#: Words for keys that are ambiguous without their section.
_KEYS = {"grid.shape": "cells", "grid.size": "extents", "time.end": "until"}
#: Longest value in a label, and largest number of differences.
_LONGEST, _MOST = 24, 2


def suggested_title(case: Mapping[str, Any]) -> str:
    """Return a title for a case without one."""
    given = case.get("indenter")
    shapes = given if isinstance(given, list) else [given]
    body = ", with ".join(_shape(each) for each in shapes)
    below = _material(case.get("material"))
    parts = [f"{body}, on {below}" if body and below else body or below, _load(case.get("load"))]
    title = ", ".join(part for part in parts if part)
    return title[:1].upper() + title[1:]


def label_of(title: str, case: Any, first: Any, taken: Collection[str]) -> str:
    """Return a label for a run among others whose cases have the same title."""
    changes = () if first is None else differences(first, case)
    # A list is one value; the physical sections come before the numerical ones.
    places = dict.fromkeys(each.where.partition("[")[0] for each in changes)
    places.pop("title", None)
    words = [_difference(place, case) for place in sorted(places, key=_rank)]
    more = [f"and {len(words) - _MOST} more"] if len(words) > _MOST else []
    label = " ".join([", ".join([title, *words[:_MOST]]), *more])
    numbered = (f"{label} ({number})" for number in count(2))
    return label if label not in taken else next(each for each in numbered if each not in taken)


def file_stem(label: str, quality: str) -> str:
    """Return a name for downloaded files."""
    words = re.findall(r"\w+", label.lower())
    stem = "-".join(words) or "case"
    if len(stem) > 80:  # the end distinguishes it from others
        stem = f"{stem[:40].strip('-')}-{stem[-39:].strip('-')}"
    return f"{stem}-coarse" if quality == "coarse" else stem


def _shape(given: Any) -> str:
    if not isinstance(given, Mapping):
        return _words(given)
    size = next(_sizes(given, _SIZES), None)
    if size is None:
        return _words(given.get("shape"))
    key, value = size
    return f"{_words(given.get('shape'))}, {_words(key)} {value}"


def _material(given: Any) -> str:
    if not isinstance(given, Mapping):
        return _text(given)  # a name of the library
    if isinstance(given.get("layers"), list):
        return _layers(given["layers"])
    law = _words(given.get("law"))
    for name in PEOPLE:
        law = re.sub(rf"\b{name}\b", name, law, flags=re.IGNORECASE)
    modulus = next((value for _, value in _sizes(given, _MODULI)), "")
    return f"{law} {modulus}".strip()


def _layers(given: Sequence[Any]) -> str:
    """The uppermost layer, and how many there are."""
    first = given[0] if given and isinstance(given[0], Mapping) else {}
    of = f"{_text(first.get('thickness'))} {_material(first.get('material', first))}".strip()
    return f"{len(given)} layers, {of}" if len(given) > 1 else of


def _load(given: Any) -> str:
    if not isinstance(given, Mapping):
        return ""
    level = next((value for _, value in _sizes(given, _LEVELS)), "")
    kind, amplitude = _words(given.get("kind")), _text(given.get("amplitude"))
    to = {"step": level, "ramp": f"ramp to {level}", "triangle": f"triangle to {level}"}
    words = to.get(kind, f"{kind} {level}".strip()) if level else kind
    duration, aside = _text(given.get("duration")), _text(given.get("eccentricity_x"))
    words += f" in {duration}" if duration else ""
    words += f" ± {amplitude}" if amplitude else ""
    return f"{words} off centre by {aside}" if re.match(r"-?[\d.]*[1-9]", aside) else words


def _sizes(given: Mapping[Any, Any], keys: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    return ((key, text) for key in keys if (text := _text(given.get(key))))


def _rank(place: str) -> int:
    section = place.partition(".")[0]
    return _SECTIONS.index(section) if section in _SECTIONS else len(_SECTIONS)


def _difference(place: str, case: Any) -> str:
    """Difference in a few words: the last key and its value."""
    key, now = _KEYS.get(place) or _words(place.rpartition(".")[2]), case
    for step in place.split("."):
        now = now.get(step) if isinstance(now, Mapping) else None
    if now is None:
        return f"without {key}"
    value = _text(" × ".join(map(_text, now)) if isinstance(now, list) else now)
    return f"{key} {value}" if value.strip("× ") else f"other {key}"


def _text(value: Any) -> str:
    """Text of a short value; empty for any other."""
    text = str(value) if isinstance(value, str | int | float) else ""
    return text if len(text) <= _LONGEST else ""


def _words(value: Any) -> str:
    return re.sub(r"[-_]", " ", _text(value))
