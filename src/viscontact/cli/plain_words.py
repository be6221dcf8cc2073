"""Command lines as they mostly are, read without Typer, which takes a quarter of the start."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from enum import Enum
from pathlib import Path
from types import NoneType
from typing import Any, get_args, get_origin

from viscontact.cli.declared import Declared, declared

_INTEGER = re.compile(r"-?[0-9]{1,9}")
_DECIMAL = re.compile(r"-?[0-9]{1,9}(\.[0-9]{1,15})?")
#: Words that a shell of Windows leaves to the program.
_PATTERN = re.compile(r"[*?\[~%$]")


class UnusualError(Exception):
    """The words are left to Typer."""


def plain_arguments(function: Callable[..., Any], words: Sequence[str]) -> dict[str, Any] | None:
    """Arguments of a command that words give; None where Typer has to read or to refuse them.

    Options stand with their full names, each with its value, before, between or after the
    arguments.
    """
    if os.name == "nt" and any(map(_PATTERN.search, words)):
        return None
    try:
        return _Reading(function).read(words)
    except UnusualError:
        return None


class _Reading:
    """Words that are sorted into the parameters of a command."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._parameters = declared(function)
        self._named = {
            each: name
            for name, (_, _, how) in self._parameters.items()
            if how.names is not None
            for each in how.names or (f"--{name.replace('_', '-')}",)
            if "/" not in each  # the names of yes and no
        }
        self._places = [name for name, (_, _, how) in self._parameters.items() if how.names is None]
        self._found: dict[str, Any] = {}

    def read(self, words: Sequence[str]) -> dict[str, Any]:
        """Return the arguments of the command."""
        left, placed = list(words), []
        while left:
            word = left.pop(0)
            if word.startswith("-"):
                self._take_option(word, left)
            elif word:
                placed.append(word)
            else:
                raise UnusualError
        self._take_arguments(placed)
        for name, (parameter, _, _) in self._parameters.items():
            if name not in self._found:
                if parameter.default is parameter.empty:
                    raise UnusualError
                self._found[name] = parameter.default
        return self._found

    def _take_option(self, word: str, left: list[str]) -> None:
        given, equals, value = word.partition("=")
        name = self._named.get(given)
        if name is None or (equals and not given.startswith("--")):
            raise UnusualError
        kind, how = self._parameters[name][1:]
        if how.count or (equals and not value):
            raise UnusualError
        if single(kind) is bool:
            if equals or not how.names:
                raise UnusualError
            self._found[name] = True
            return
        if not equals:
            if not left or not left[0] or left[0].startswith("-"):
                raise UnusualError
            value = left.pop(0)
        self._take(name, value)

    def _take_arguments(self, words: list[str]) -> None:
        for place, name in enumerate(self._places):
            is_list = _is_list(self._parameters[name][1])
            if is_list and place < len(self._places) - 1:
                raise UnusualError
            for _ in range(len(words) if is_list else min(1, len(words))):
                self._take(name, words.pop(0))
        if words:
            raise UnusualError

    def _take(self, name: str, text: str) -> None:
        kind, how = self._parameters[name][1:]
        value = value_of(single(kind), text, how)
        if _is_list(kind):
            self._found.setdefault(name, []).append(value)
        elif name in self._found:
            raise UnusualError
        else:
            self._found[name] = value


def _without_none(kind: Any) -> Any:
    kinds = [each for each in get_args(kind) if each is not NoneType]
    return kinds[0] if NoneType in get_args(kind) and len(kinds) == 1 else kind


def _is_list(kind: Any) -> bool:
    return get_origin(_without_none(kind)) is list


def single(kind: Any) -> Any:
    """Type of one value."""
    kind = _without_none(kind)
    return get_args(kind)[0] if get_origin(kind) is list else kind


def value_of(kind: Any, text: str, how: Declared) -> Any:
    """Return the value that a text gives."""
    if kind is str or kind is Path:
        return kind(text)
    if kind in (int, float):
        pattern = _INTEGER if kind is int else _DECIMAL
        if not pattern.fullmatch(text):
            raise UnusualError
        number = kind(text)
        if (how.min is not None and number < how.min) or (how.max is not None and number > how.max):
            raise UnusualError
        return number
    if isinstance(kind, type) and issubclass(kind, Enum) and text in [each.value for each in kind]:
        return kind(text)
    raise UnusualError
