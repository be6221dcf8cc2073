"""Conversion of validation errors to messages, each at its key."""

from __future__ import annotations

import re
from copy import deepcopy
from typing import Any, get_args

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from viscontact.case import time_grid_output
from viscontact.case.adhesion import AdhesionSection
from viscontact.case.aliases import aliases_of, known_aliases
from viscontact.case.allowable import Allowable
from viscontact.case.document import Document, as_written
from viscontact.case.errors import KeyPath, dotted
from viscontact.case.friction import FrictionSection
from viscontact.case.indenters.profiles import AnyProfile, Logarithmic
from viscontact.case.indenters.shapes import AnyShape
from viscontact.case.leakage import Leakage
from viscontact.case.loads.load import AnyLoad
from viscontact.case.loads.temperature import AnyTemperature
from viscontact.case.materials.layers import AnyBody, Layer
from viscontact.case.materials.material import AnyMaterial
from viscontact.case.materials.shifts import AnyShift
from viscontact.case.motion import AnyMotion, SpeedRange
from viscontact.case.section_choice import alternatives
from viscontact.case.sections import CaseFile
from viscontact.case.tangential import AnyTangential
from viscontact.case.title_block import TitleBlock
from viscontact.case.unknown_words import meanings, nearest_word, unknown_word
from viscontact.units.dimensions import DIMENSIONS

# Sections by name, or by the value of shape, law or kind.
_SECTIONS: dict[str | int, type[BaseModel]] = {
    "time": time_grid_output.Time,
    "grid": time_grid_output.Cells,
    "output": time_grid_output.Output,
    "report": TitleBlock,
    "allowable": Allowable,
    "leakage": Leakage,
    "friction": FrictionSection,
    "adhesion": AdhesionSection,
}
# Shifts and motions, like loads, are identified by `kind`.
_SHIFTS, _PROFILES = alternatives(AnyShift), alternatives(AnyProfile)
_MOTIONS = alternatives(AnyMotion)
# Histories and harmonic temperatures have the names of loads.
_TEMPERATURES = alternatives(AnyTemperature)
_TANGENTIAL = alternatives(AnyTangential)
_NO_SHIFTS = alternatives(AnyShape) | alternatives(AnyBody) | alternatives(AnyLoad)
_SINGLE = alternatives(AnyMaterial)  # of a layer, which has no layers of its own
_ALTERNATIVES = _NO_SHIFTS | _SHIFTS | _MOTIONS | {"range": SpeedRange}
# Values of these keys are identified by `kind`.
_WITHIN: dict[str | int, dict[str | int, Any]] = {
    "shift": _SHIFTS,
    "profile": _PROFILES,
    "motion": _MOTIONS,
    "temperature": _TEMPERATURES,
    "tangential": _TANGENTIAL,
}


def problem(document: Document, error: ErrorDetails) -> str:
    """Return a validation error as one line: place, key, reason and remedy."""
    key = _key_path(document.data, error)
    model = _model_at(error["loc"])
    if error["type"] == "value_error":
        why = str(error["ctx"]["error"])
        return object_problem(document, key, why)
    if error["type"].startswith("union_tag"):
        key = (*key, _union_key(error))
    return document.problem(key, _reason(key, model, error))


def corrected(data: dict[str, Any], errors: list[ErrorDetails]) -> dict[str, Any] | None:
    """Return the data with misspelt shapes, laws and kinds corrected, None without any."""
    # Further errors in a section can be found only when its kind is known.
    changed = None
    for error in errors:
        if error["type"] != "union_tag_invalid":
            continue
        near = nearest_word(error["ctx"]["tag"], _choices(error))
        if near is not None:
            changed = deepcopy(data) if changed is None else changed
            path = _key_path(data, error)
            # A name may replace the section.
            if isinstance(_value_at(changed, path), dict):
                path = (*path, _union_key(error))
            _value_at(changed, path[:-1])[path[-1]] = near
    return changed


def _value_at(data: Any, path: KeyPath) -> Any:
    for step in path:
        data = data[step]
    return data


def object_problem(document: Document, section: KeyPath, why: str) -> str:
    """Return an error of a constructor or of the run as one line, at the key that it names."""
    if missing := re.match(r"(\w+) (?=is missing)", why):
        return document.problem((*section, missing[1]), why[missing.end() :])
    key = _named_key(document.data, section, why)
    # "Roller: radius must be" and "load.force: ..." name the key a second time.
    why = re.sub(r"^(?:[A-Z]\w+[:.]|harmonic:) ?", "", why)
    names = [dotted(key[start:]) for start in range(len(key))]
    for name in names:
        behind = r"(\[\d+\])*(: |, | (?=must|has|is|stands|does|goes))"
        why = re.sub(f"^{re.escape(name)}{behind}", "", why)
    # A key that the file leaves out is named once too, at the line of its section.
    if key and (left_out := re.match(rf"{re.escape(dotted(key))}((?:\.\w+)+): ", why)):
        key, why = (*key, *left_out[1].split(".")[1:]), why[left_out.end() :]
    return document.problem(key, why)


def _named_key(data: Any, section: KeyPath, why: str) -> KeyPath:
    """First key that a message names, if it is in the file."""
    lead = re.match(r"\w[\w.\[\]]*(?=:)", why)
    steps = re.findall(r"\[(\d+)\]|([^.\[\]]+)", lead[0]) if lead else []
    named = tuple(int(place) - 1 if place else name for place, name in steps)
    for length in range(len(named), 0, -1):
        for path in (named[:length], (*section, *named[:length])):
            if _has_key(data, path):
                return path
    words = re.findall(r"\w+", why) if section else ()
    return next(((*section, word) for word in words if _has_key(data, (*section, word))), section)


def _has_key(data: Any, path: KeyPath) -> bool:
    for step in path:
        known = isinstance(data, dict) and step in data
        if not (known or (isinstance(data, list) and isinstance(step, int) and step < len(data))):
            return False
        data = data[step]
    return True


def _key_path(data: Any, error: ErrorDetails) -> KeyPath:
    """Location of a validation error with keys only, without names of alternatives."""
    path = as_written(data, error["loc"])
    return (*path, error["loc"][-1]) if error["type"] == "missing" else path


def _model_at(loc: tuple[str | int, ...]) -> type[BaseModel]:
    """Section to which the last key of a location belongs."""
    if loc[-3:-2] == ("layers",) and isinstance(loc[-2], int):
        return Layer
    # Section names count at the top level only: `load.time` is a key of the load.
    section = _SECTIONS.get(loc[0], CaseFile) if len(loc) > 1 else CaseFile
    within = reversed(loc[1:-1])
    # Both a profile and a law can be a table.
    named = _PROFILES if "profile" in loc[:-2] else _ALTERNATIVES
    if loc[:1] == ("temperature",):
        named = _TEMPERATURES
    if loc[:1] == ("tangential",):
        named = _TANGENTIAL
    return next((named[step] for step in within if step in named), section)


def _union_key(error: ErrorDetails) -> str:
    return str(error["ctx"]["discriminator"]).strip("'")


def _reason(key: KeyPath, model: type[BaseModel], error: ErrorDetails) -> str:
    kind, context = error["type"], error.get("ctx", {})
    if kind == "extra_forbidden":
        return _unknown_key(model, key[-1])
    if kind == "missing":
        return f"is missing{_example(model, str(key[-1]))}{_in_place(model, str(key[-1]))}"
    if kind == "union_tag_not_found":
        return f"is missing; choose one of: {', '.join(_choices(error))}"
    if kind == "union_tag_invalid":
        return unknown_word("value", context["tag"], _choices(error))
    if kind == "literal_error":
        choices = re.findall(r"'([^']*)'", context["expected"])
        return unknown_word("value", error["input"], choices)
    if kind == "quantity":
        return _with_own_example(error["msg"], model, str(key[-1]))
    return _plain_words(error)


def _choices(error: ErrorDetails) -> list[str]:
    """Allowed values of the key that identifies a section."""
    others = _SINGLE if "layered" in error["loc"] else _NO_SHIFTS
    models = _WITHIN.get(error["loc"][-1], others)
    fields = {tag: model.model_fields.get(_union_key(error)) for tag, model in models.items()}
    return [
        str(tag) for tag, field in fields.items() if field and tag in get_args(field.annotation)
    ]


def _unknown_key(model: type[BaseModel], given: object) -> str:
    """Message with the allowed keys, or the other kinds, laws or shapes that have the key."""
    allowed = sorted([*_names(model), *(each.name for each in known_aliases(model))])
    unknown = unknown_word("key", given, allowed)
    alike = next((each for each in _WITHIN.values() if model in each.values()), _NO_SHIFTS)
    if "Allowed:" not in unknown or ("did you mean" in unknown and meanings(given)):
        return unknown
    discriminators = [each for each in ("kind", "law", "shape") if each in model.model_fields]
    for word in (str(given), *meanings(given)):
        for discriminator in discriminators:
            others = [
                str(tag)
                for tag, other in alike.items()
                if word in other.model_fields and discriminator in other.model_fields
            ]
            if others:
                named = "It" if word == given else word
                return f"{unknown}. {named} goes with {discriminator}: {' or '.join(others)}"
    return unknown if "did you mean" in unknown else f"{unknown}{_elsewhere(model, str(given))}"


def _elsewhere(model: type[BaseModel], given: str) -> str:
    """Section that has an unknown key; empty if none has it."""
    loads = alternatives(AnyLoad).values()
    sections: dict[str, list[type[BaseModel]]] = {
        "the case file": [CaseFile],
        "indenter": list(alternatives(AnyShape).values()),
        "material": list(alternatives(AnyBody).values()),
        "load": list(loads),
        **{str(name): [section] for name, section in _SECTIONS.items()},
        "motion": list(_MOTIONS.values()),
        "temperature": list(_TEMPERATURES.values()),
        "tangential": list(_TANGENTIAL.values()),
    }
    for word in (given, *meanings(given)):
        for name, models in sections.items():
            known = {key for each in models for key in _names(each)}
            known |= {alias.name for each in models for alias in known_aliases(each)}
            if model not in models and word in known:
                return f". {'It' if word == given else word} is a key of {name}"
    return ""


def _names(model: type[BaseModel]) -> list[str]:
    return [each.alias or name for name, each in model.model_fields.items()]


def _example(model: type[BaseModel], key: str) -> str:
    """Example for a missing key."""
    fields = {each.alias or name: each for name, each in model.model_fields.items()}
    if key not in fields:
        return ""
    for annotation in fields[key].metadata:
        if dimension := getattr(annotation, "dimension", None):
            examples = fields[key].examples or [DIMENSIONS[dimension].example]
            return f"; write e.g. '{key}: {examples[0]}'"
    described, [example, *_] = fields[key].description, fields[key].examples or [None]
    if example is not None:
        written = f"[{', '.join(example)}]" if isinstance(example, list) else example
        described = f"{f'{described}; ' if described else ''}write e.g. '{key}: {written}'"
    return f"; {described}" if described else ""


def _with_own_example(message: str, model: type[BaseModel], key: str) -> str:
    """Message with the size that is usual for the key, in place of any of its dimension."""
    field = next(
        (each for name, each in model.model_fields.items() if key in (name, each.alias)), None
    )
    [example, *_] = (field.examples if field else None) or [None]
    if not isinstance(example, str):
        return message
    return re.sub(r"(?<=write e\.g\. )'[^']*'", repr(example), message)


def _in_place(model: type[BaseModel], key: str) -> str:
    """Aliases and other profiles that may stand in place of a missing key."""
    if model is Logarithmic and key == "amplitude":
        return (
            "; or choose the profile lundberg or johns-gohar, which need the design force and "
            "effective_modulus"
        )
    words = [f"'{alias.name}: {alias.example}'" for alias in aliases_of(model, key)]
    return f", or {' or '.join(words)}" if words else ""


def _plain_words(error: ErrorDetails) -> str:
    given = error["input"]
    shown = repr(given) if len(repr(given)) <= 40 else repr(given)[:37] + "..."
    words = {
        "int_type": "must be a whole number",
        "float_type": "must be a plain number, without a unit",
        "string_type": "must be a text",
        "list_type": "must be a list",
        "tuple_type": "must be a list",
        "model_type": "must be a section with keys of its own",
        "model_attributes_type": "must be a section with keys of its own",
        "dict_type": "must be a section with keys of its own",
        "finite_number": "must be a finite number",
        "too_short": "has too few entries",
        "too_long": "has too many entries",
    }
    if error["type"] in words:
        return f"{words[error['type']]}, got {shown}"
    if error["type"] == "library":
        return error["msg"]
    bounds = error["msg"].removeprefix("Input should be ")
    return f"must be {bounds}, got {shown}"
