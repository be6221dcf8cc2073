"""Reference of the keys of a case file, generated from its JSON schema."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

Schema = Mapping[str, Any]

#: A key that at least this number of kinds have in common is described once, above them.
ALIKE = 4

_BOUNDS = (
    ("exclusiveMinimum", "above"),
    ("minimum", "at least"),
    ("ge", "at least"),
    ("maximum", "at most"),
    ("le", "at most"),
)


def case_file_reference(schema: Schema) -> str:
    """Return a table of keys for each section of a case file, and for each kind of it.

    Parameters
    ----------
    schema : mapping
        As `viscontact schema` prints it.

    Returns
    -------
    str
        Markdown.

    Examples
    --------
    >>> schema = {"properties": {"title": {"type": "string"}}, "required": [], "$defs": {}}
    >>> print(case_file_reference(schema).splitlines()[-1])
    | `title` |  | text | – |
    """
    keys = schema["properties"]
    lines = ["## The whole file", "", *_table(keys, schema["required"])]
    named = [name for name, value in keys.items() if any(_references(value))]
    sections = [f"[`{name}`](#{_label(name)})" for name in named]
    if sections:
        lines += ["", f"Sections of this page: {', '.join(sections)}."]
    described: dict[tuple[str, ...], str] = {}
    for name, value in keys.items():
        kinds = tuple(_references(value))
        if kinds and kinds in described:  # the indenter's material is described with the material
            lines += ["", _target(name), f"## `{name}`", "", _sentence(value["description"])]
            lines += [f"Same keys as [`{described[kinds]}`](#{_label(described[kinds])})."]
        else:
            lines += _section(schema["$defs"], name, value, depth=2, within={})
            described[kinds] = name
    return "\n".join([*lines, *_units(schema.get("x-units", {}))])


def _units(units: Mapping[str, list[str]]) -> Iterator[str]:
    if not units:
        return
    yield from ("", "## Units", "", "These and their multiples, among others:", "")
    yield from ("| quantity | units |", "|---|---|")
    for dimension, names in units.items():
        yield f"| {dimension} | {', '.join(f'`{name}`' for name in names)} |"


def _section(
    defs: Schema, path: str, value: Schema, depth: int, within: Mapping[str, list[str]]
) -> Iterator[str]:
    """Section of a key whose value has keys: of one kind, or of several.

    `within` has the kinds of the sections around it, such as the laws, which a layer has too.
    """
    names = list(dict.fromkeys(_references(value)))
    if not names:
        return
    around = next((each for each, kinds in within.items() if {*names} < {*kinds}), None)
    if around and len(names) > 1:
        yield from (
            "",
            _target(path),
            f"{'#' * depth} `{path}`",
            "",
            _sentence(value["description"]),
        )
        yield f"One of the kinds of [`{around}`](#{_label(around)})."
        return
    within = {**within, path: names}
    yield from ("", _target(path), f"{'#' * depth} `{path}`", "")
    # For a single kind, its own description is sufficient.
    if len(names) > 1 and "description" in value:
        yield from (_sentence(value["description"]), "")
    if len(names) == 1:
        only = defs[names[0]]
        yield from (_sentence(only["description"]), "")
        yield from _table(only["properties"], _required(only))
        yield from _below(defs, path, only["properties"], depth, within)
        return
    kinds = {name: defs[name] for name in names}
    shipped = _names_of_no_kind(value, kinds)
    if shipped:
        names = ", ".join(f"`{name}`" for name in shipped)
        yield from (f"A name, one of {names}; or one of the kinds below.", "")
    apart = [kind for kind in kinds.values() if _is_apart(kind, kinds)]
    alike = _alike({name: kind for name, kind in kinds.items() if kind not in apart})
    yield from _jumps(path, kinds)
    if alike:
        but = "".join(f" but `{_chosen(kind)}`" for kind in apart)
        yield from (f"Keys of every kind{but}:", "", *_table(alike, []))
    for kind in kinds.values():
        yield from _kind(path, kind, alike, depth + 1)
    nested = {key: each for kind in kinds.values() for key, each in kind["properties"].items()}
    yield from _below(defs, path, nested, depth, within)


def _jumps(path: str, kinds: Mapping[str, Schema]) -> Iterator[str]:
    """Table of links to several kinds, with the first sentence on each."""
    if len(kinds) < ALIKE:
        return
    yield from ("| kind | description |", "|---|---|")
    for kind in kinds.values():
        first = _sentence(kind["description"]).split(". ")[0].rstrip(".")
        yield f"| [`{_chosen(kind)}`](#{_label(_anchor(path, kind))}) | {_cell(first)} |"
    yield ""


def _anchor(path: str, kind: Schema) -> str:
    consts = (value["const"] for value in kind["properties"].values() if "const" in value)
    return "-".join([path, *consts])


def _kind(path: str, kind: Schema, alike: Schema, depth: int) -> Iterator[str]:
    properties = kind["properties"]
    chosen = {key: value["const"] for key, value in properties.items() if "const" in value}
    own = {
        key: value for key, value in properties.items() if key not in alike and key not in chosen
    }
    yield from ("", _target(_anchor(path, kind)), f"{'#' * depth} `{_chosen(kind)}`", "")
    yield _sentence(kind["description"])
    if own:
        yield from ("", *_table(own, _required(kind)))


def _chosen(kind: Schema) -> str:
    """Keys and values that choose a kind, as a case has them."""
    consts = (
        (key, value["const"]) for key, value in kind["properties"].items() if "const" in value
    )
    return ", ".join(f"{key}: {value}" for key, value in consts)


def _is_apart(kind: Schema, kinds: Mapping[str, Schema]) -> bool:
    """True for one of many kinds that has no key in common with any other."""
    own = {key for key, value in kind["properties"].items() if "const" not in value}
    others = (each for each in kinds.values() if each is not kind)
    return len(kinds) > ALIKE and all(own.isdisjoint(each["properties"]) for each in others)


def _below(
    defs: Schema, path: str, properties: Schema, depth: int, within: Mapping[str, list[str]]
) -> Iterator[str]:
    for key, value in properties.items():
        yield from _section(defs, f"{path}.{key}", value, depth + 1, within)


def _names_of_no_kind(value: Schema, kinds: Mapping[str, Schema]) -> list[str]:
    """Allowed names that are not names of the kinds described below."""
    consts = {each.get("const") for kind in kinds.values() for each in kind["properties"].values()}
    options = value.get("anyOf", [])
    return [name for each in options for name in each.get("enum", []) if name not in consts]


def _alike(kinds: Mapping[str, Schema]) -> dict[str, Any]:
    """Keys that all kinds have in common."""
    every = [kind["properties"] for kind in kinds.values()]
    if len(every) < ALIKE:
        return {}
    return {
        key: value
        for key, value in every[0].items()
        if all(properties.get(key) == value for properties in every)
    }


def _table(properties: Schema, required: list[str]) -> Iterator[str]:
    yield from ("| key | meaning | value | default |", "|---|---|---|---|")
    for key, value in properties.items():
        default = _in_place(value) or ("required" if key in required else _default(value))
        yield f"| `{key}` | {_meaning(value)} | {_cell(_value(value))} | {_cell(default)} |"


def _meaning(value: Schema) -> str:
    said = str(value.get("description", ""))
    # The next column describes the quantity.
    if said and not (said.endswith(tuple(_SIGNS)) and "with its unit" in said):
        return _cell(said)
    # The description of an optional key is in one of its alternatives.
    return next(filter(None, map(_meaning, value.get("anyOf", []))), "")


def _in_place(value: Schema) -> str:
    """Key that an alias stands for; empty for any other key."""
    return f"for `{value['x-alias-of']}`" if "x-alias-of" in value else ""


def _required(kind: Schema) -> list[str]:
    """Required keys, those included that have aliases."""
    choices = [rule.get("oneOf") or rule.get("anyOf", []) for rule in kind.get("allOf", [])]
    return [*kind.get("required", []), *(each[0]["required"][0] for each in choices if each)]


_WORDS = {
    "integer": "whole number",
    "number": "number",
    "string": "text",
    "object": "keys of your own",
}

#: Bounds of quantities, by the words of the schema.
_SIGNS = {"any": "", "zero or more": " ≥ 0", "more than zero": " > 0"}


def _default(value: Schema) -> str:
    default = value.get("default")
    if default is None or isinstance(default, dict):
        return "–"
    if isinstance(default, bool):
        return f"`{str(default).lower()}`"
    if isinstance(default, float) and default == int(default):
        return f"`{int(default)}`"
    return f"`{default}`" if default != "" else "–"


def _value(value: Schema) -> str:
    """Allowed values of a key, in words."""
    if "const" in value:
        return f"`{value['const']}`"
    if "enum" in value:
        return " or ".join(f"`{each}`" for each in value["enum"])
    options = value.get("anyOf") or value.get("oneOf")
    if options:
        if any(True for _ in _references(value)):
            return _link_below(value, options)
        texts = [_value(each) for each in options if each.get("type") != "null"]
        joined = ", or ".join(dict.fromkeys(texts)) + _bounds(value)
        return joined if "e.g." in joined else joined + _example(value)
    if "$ref" in value:
        return "its keys (below)"
    return _simple(value)


def _link_below(value: Schema, options: list[Schema]) -> str:
    """Allowed values that are described in their own sections."""
    if len(set(_references(value))) == 1:
        return "its keys (below)"
    names = any("enum" in each for each in options)
    lists = any(each.get("type") == "array" for each in options)
    said = "a name, or a kind with its keys (below)" if names else "a kind with its keys (below)"
    return f"{said}; or a list of these" if lists else said


def _simple(value: Schema) -> str:
    kind = value.get("type", "")
    if kind == "array":
        if "prefixItems" in value:
            return "[" + ", ".join(_value(each) for each in value["prefixItems"]) + "]"
        return f"list: {_value(value['items'])}"
    if kind == "boolean":
        return "`true` or `false`"
    if "x-alias-of" in value:
        return f"as `{value['x-alias-of']}`{_example(value)}"
    if "pattern" in value:
        return _quantity(value)
    if "x-dimension" in value:
        return " or ".join(value["x-dimension"]) + _example(value)
    return _WORDS[kind] + _bounds(value) + _example(value)


def _quantity(value: Schema) -> str:
    bound = _SIGNS[value["x-sign"]]
    return f"{value['x-dimension']}{bound}{_example(value)}"


def _bounds(value: Schema) -> str:
    return "".join(
        f", {words} {value[key]:g}".replace("e+0", "e") for key, words in _BOUNDS if key in value
    )


def _example(value: Schema) -> str:
    examples = value.get("examples", [])
    texts = [each if isinstance(each, str) else json.dumps(each) for each in examples]
    return f", e.g. `{texts[0]}`" if texts else ""


def _references(value: Any) -> Iterator[str]:
    """Definitions that a value may refer to, in order."""
    if isinstance(value, Mapping):
        if "x-shorthand" in value:  # another spelling of the kinds beside it
            return
        if "$ref" in value:
            yield str(value["$ref"]).rsplit("/", 1)[-1]
        for key in ("anyOf", "oneOf", "items"):
            yield from _references(value.get(key))
    elif isinstance(value, list):
        for each in value:
            yield from _references(each)


def _target(path: str) -> str:
    return f"({_label(path)})="


def _label(path: str) -> str:
    return f"case-{path.replace('.', '-').replace('_', '-')}"


def _sentence(text: str) -> str:
    whole = " ".join(text.split())
    whole = whole[0].upper() + whole[1:]
    return whole if whole.endswith(".") else f"{whole}."


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", r"\|")
