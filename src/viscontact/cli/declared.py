"""Declarations of the arguments and options of commands."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Annotated, Any, get_args, get_origin

from viscontact.backend.lazy_dataclass import dataclass

# Typer, which reads command lines and prints their help, takes a quarter of the start of a command:
# so the commands do not name it, and `plain_words` reads what is written in the plain way.


@dataclass(frozen=True)
class Declared:
    """Argument or option of a command: the names of an option, and what is known of its values."""

    # None for an argument; empty for an option named after its parameter
    names: tuple[str, ...] | None
    metavar: str | None = None  # how help calls its value
    help: str | None = None
    min: int | None = None
    max: int | None = None
    count: bool = False  # its value is how often it is given
    show_default: bool = True
    panel: str | None = None  # of the help


def argument(**details: Any) -> Any:
    """Declare an argument."""
    return Declared(None, **details)


def option(*names: str, **details: Any) -> Any:
    """Declare an option, by default called as its parameter."""
    return Declared(names, **details)


def declared(function: Callable[..., Any]) -> Mapping[str, tuple[inspect.Parameter, Any, Declared]]:
    """Return the parameters of a command by name, each with its type and its declaration."""
    found = {}
    for name, parameter in inspect.signature(function, eval_str=True).parameters.items():
        assert get_origin(parameter.annotation) is Annotated
        kind, how = get_args(parameter.annotation)
        found[name] = (parameter, kind, how)
    return found
