"""YAML 1.2 parser with line numbers, and writer that keeps comments."""

from __future__ import annotations

import functools
import io
import re
import warnings
from collections.abc import Mapping
from operator import getitem
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.constructor import DuplicateKeyError
from ruamel.yaml.error import MarkedYAMLError, ReusedAnchorWarning

from viscontact.case.errors import KeyPath, SourceError
from viscontact.case.yaml_scalars import written_over

__all__ = ["SourceError", "parse", "parse_value", "with_overrides"]

# Limits on values and depth: aliases can expand a small file without end, and the parser needs
# 1.3 s for this many values and a time that grows with the square of the depth.
_MOST_VALUES, _DEEPEST = 10_000, 12
_MOST_BRACKETS = 200
# Limits on merges and tags: merging copies every key of a mapping, and the time for a tag grows
# with the square of its length.
_MOST_MERGED, _LONGEST_TAG = 50, 1000
# Limit on aliases times values, a bound of the number of copied keys.
_MOST_COPIED = 100_000
# Number and unit, which YAML reads as a text.
_QUANTITY = re.compile(r"[+-]?\d+\.?\d*(?:[eE][+-]?\d+)? [A-Za-zµμΩ°%/][\wµμΩ°%/*^ ()-]*")
#: Part of a text in which data are looked for, and a line of several numbers.
_LOOKED_AT = 4096
_NUMBERS = re.compile(r"[-+\d.][-+\d.eE]*(?:[\s,;]+[-+\d.][-+\d.eE]*)+[\s,;]*")
# Possible places of aliases, those in texts and comments included.
_ALIAS = re.compile(r"(?:^|[\s,:\[{])\*[^\s*]")


def parse(text: str) -> tuple[Any, dict[KeyPath, int]]:
    """Read YAML."""
    lines: dict[KeyPath, int] = {}
    return _plain_data(_load(text), (), lines), lines


def parse_value(text: str) -> Any:
    """Read one value, as behind a key."""
    plain = text.strip()
    # A parser for each of thousands of quantities takes longer than all other checks of a case.
    return plain if _QUANTITY.fullmatch(plain) else parse(text)[0]


def with_overrides(text: str, values: dict[KeyPath, Any]) -> str:
    """Write values into the text of a YAML file, keeping its comments."""
    quickly = written_over(text, values)
    if quickly is not None:
        return quickly
    document = _load(text)
    for path, value in values.items():
        target = document
        for step in path[:-1]:
            if isinstance(target, dict) and target.get(step) is None:  # also an empty section
                target[step] = {}
            target = target[step]
        target[path[-1]] = value
    return write(document)


def rewritten(text: str, data: dict[str, Any]) -> str:
    """Write data as YAML with the order and the comments of an earlier text."""
    try:
        document = _load(text)
    except SourceError:
        document = None
    if not isinstance(document, CommentedMap):
        return write(data)
    _bring_up_to_date(document, data)
    return write(document)


def renamed(text: str, keys: Mapping[KeyPath, KeyPath], data: dict[str, Any]) -> str:
    """Write data under new keys, each by its old one, in a YAML text with its comments."""
    document = _load(text)
    for new, old in keys.items():
        section = functools.reduce(getitem, old[:-1], document)
        if new[:-1] == old[:-1] and old[-1] in section.ca.items:
            section.ca.items[new[-1]] = section.ca.items.pop(old[-1])
        if new[:-1] == old[:-1]:
            section.insert(list(section).index(old[-1]), new[-1], None)
        section.pop(old[-1], None)
    _bring_up_to_date(document, data)
    written = write(document)
    # A key that was merged from an anchor cannot be renamed in its place.
    return written if parse(written)[0] == data else write(data)


def _bring_up_to_date(old: CommentedMap, new: dict[str, Any]) -> None:
    for key in [key for key in old if str(key) not in new]:
        del old[key]
    for key, value in new.items():
        before = old.get(key)
        if isinstance(before, CommentedMap) and isinstance(value, dict):
            _bring_up_to_date(before, value)
        elif key not in old or _plain_data(before, (), {}) != value:
            old[key] = value


def write(data: Any) -> str:
    """Write data as YAML."""
    stream = io.StringIO()
    _yaml().dump(data, stream)
    return stream.getvalue()


def _yaml() -> YAML:
    yaml = YAML(typ="rt", pure=True)
    yaml.preserve_quotes = True
    yaml.width = 100
    return yaml


def _load(text: str) -> Any:
    _refuse_data(text)
    _refuse_endless(text)
    try:
        with warnings.catch_warnings():
            # YAML allows an anchor to be redefined.
            warnings.simplefilter("ignore", ReusedAnchorWarning)
            return _yaml().load(text)
    except DuplicateKeyError as error:
        name = str(error.problem).split('"')[1]
        raise SourceError(f"the key {name!r} is given twice", _line(error)) from error
    except MarkedYAMLError as error:
        why = " ".join(str(part) for part in (error.context, error.problem) if part)
        hint = "; indent with spaces, not tabs" if "'\\t'" in why else ""
        raise SourceError(f"not valid YAML: {why}{hint}", _line(error)) from error
    except RecursionError as error:
        raise SourceError("nested too deeply for a case file") from error
    except Exception as error:  # malformed text makes the parser raise many other kinds
        why = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise SourceError(f"not valid YAML: {why}") from error


def _refuse_data(text: str) -> None:
    """Refuse the numbers of a table or of a height map."""
    start = text[:_LOOKED_AT]
    first = next((line for line in start.splitlines() if line.strip()), "")
    numbers = _NUMBERS.fullmatch(first.strip()) is not None
    if "NUMPY" in start[:8] or numbers:
        raise SourceError(
            "is no case file, but holds numbers, as a table or a height map does; a case names it "
            "by a key 'file', and the page takes it by Open"
        )


def _refuse_endless(text: str) -> None:
    """Refuse a text that would take minutes to parse."""
    # Matches in texts and comments count as well; case files have few there.
    returns = text.count("\r") - text.count("\r\n")  # these end lines, too
    values = text.count(",") + text.count("\n") + returns
    if values > _MOST_VALUES:
        raise SourceError(
            f"has more than {_MOST_VALUES} lines and commas; a long history belongs in a CSV file"
        )
    if text.count("<<") > _MOST_MERGED:
        raise SourceError(f"merges more than {_MOST_MERGED} mappings with <<; write their keys out")
    # A tag can also make a key a merge key.
    if ("<<" in text or "!" in text) and values * len(_ALIAS.findall(text)) > _MOST_COPIED:
        raise SourceError("merges too many keys with <<; write out those that are needed")
    if re.search(rf"!\S{{{_LONGEST_TAG}}}", text):
        raise SourceError("not valid YAML: a word with ! before it is too long for a tag")
    depth = 0
    for bracket in re.findall(r"[\[\]{}]", text):
        depth = max(0, depth + (1 if bracket in "[{" else -1))
        if depth > _MOST_BRACKETS:
            raise SourceError("nested too deeply for a case file")


def _line(error: MarkedYAMLError) -> int | None:
    mark = error.problem_mark or error.context_mark
    return mark.line + 1 if mark else None


def _plain_data(value: Any, path: KeyPath, lines: dict[KeyPath, int]) -> Any:
    """Convert the parser's containers to plain ones, and collect the lines."""
    if len(path) > _DEEPEST:
        raise SourceError("nested too deeply for a case file")
    if len(lines) > _MOST_VALUES:
        raise SourceError(
            f"expands to more than {_MOST_VALUES} values; a long history belongs in a CSV file"
        )
    if isinstance(value, CommentedMap):
        return {_text(str(key)): _entry(value, key, path, lines) for key in value}
    if isinstance(value, CommentedSeq):
        return [_entry(value, index, path, lines) for index in range(len(value))]
    return _plain_scalar(value)


def _entry(container: Any, key: Any, path: KeyPath, lines: dict[KeyPath, int]) -> Any:
    here = (*path, key if isinstance(container, CommentedSeq) else str(key))
    known = container.lc.data or {}
    # A key merged from an anchor has no line; the line of its mapping is used.
    if key in known:
        lines[here] = known[key][0] + 1
    elif path in lines:
        lines[here] = lines[path]
    return _plain_data(container[key], here, lines)


def _plain_scalar(value: Any) -> Any:
    # bool before int, its base class
    for kind in (bool, int, float):
        if isinstance(value, kind):
            return kind(value)
    return None if value is None else _text(str(value))


def _text(value: str) -> str:
    """Return a text as plain str; escapes can make lone surrogates, which cannot be written."""
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise SourceError(f"{value[:40]!r} holds half a character; write the character") from error
    return str(value)
