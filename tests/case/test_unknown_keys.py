"""Unknown keys are refused in each object of the JSON schema, at the key's own place.

The places are found by walking the schema, so that a new section is tested as soon as it exists.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from viscontact.case import CaseError, case_schema, read_case

SCHEMA = case_schema()
UNKNOWN = "no_such_key"

Schema = dict[str, Any]


def _places(schema: Schema, name: str = "", open_names: tuple[str, ...] = ()) -> Iterator[Any]:
    """Yield the name of each object below a schema, and a document whose last object is that one.

    The document holds the keys that choose among alternatives, and the unknown key.
    """
    if "x-shorthand" in schema:  # other spellings of the objects beside it
        return
    if "$ref" in schema:
        name = schema["$ref"].rpartition("/")[2]
        if name not in open_names:
            yield from _places(SCHEMA["$defs"][name], name, (*open_names, name))
    for each in (*schema.get("anyOf", ()), *schema.get("oneOf", ()), *schema.get("allOf", ())):
        yield from _places(each, name, open_names)
    for item in (schema.get("items"), *schema.get("prefixItems", ())):
        if isinstance(item, dict):
            for found, document in _places(item, name, open_names):
                yield found, [document]
    if "properties" in schema:
        chosen = {
            key: value["const"] if "const" in value else value["enum"][0]
            for key, value in schema["properties"].items()
            if key in ("shape", "law", "kind") and ("const" in value or "enum" in value)
        }
        yield name, chosen | {UNKNOWN: 1}
        for key, value in schema["properties"].items():
            for found, document in _places(value, name, open_names):
                yield found, chosen | {key: document}


def _key_of(document: Any) -> str:
    """Place of the unknown key in a document, as messages name it."""
    if isinstance(document, list):
        return f"[1]{_key_of(document[0])}"
    if UNKNOWN in document:
        return f".{UNKNOWN}"
    ((key, inner),) = ((k, v) for k, v in document.items() if isinstance(v, dict | list))
    return f".{key}{_key_of(inner)}"


def _documents() -> Iterator[Any]:
    """Yield the documents as parameters; by default each object is tried in its first place."""
    tried: set[str] = set()
    for name, document in _places(SCHEMA, "case"):
        again = [pytest.mark.slow] if name in tried else []
        tried.add(name)
        place = _key_of(document).removesuffix(UNKNOWN)
        yield pytest.param(document, id=f"{name}{place}", marks=again)


def test_every_object_of_the_schema_is_reached_and_closed() -> None:
    reached = {name for name, _ in _places(SCHEMA, "case")}
    assert reached == {"case", *SCHEMA["$defs"]}
    open_objects = [
        name
        for name, each in {**SCHEMA["$defs"], "case": SCHEMA}.items()
        if each.get("additionalProperties") is not False
    ]
    assert open_objects == []


@pytest.mark.parametrize("document", list(_documents()))
def test_unknown_key_is_refused_at_its_place(document: Any, tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(json.dumps(document), encoding="utf-8")  # JSON is YAML, too
    with pytest.raises(CaseError) as refusal:
        read_case(file)
    key = _key_of(document).lstrip(".")
    refused = [each for each in refusal.value.problems if f" {key}: unknown key" in each]
    assert len(refused) == 1, refusal.value.problems
