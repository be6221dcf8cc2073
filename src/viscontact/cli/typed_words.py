"""Typer application: it reads any command line, refuses wrong ones and prints help."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from functools import wraps
from typing import Annotated, Any

import typer

from viscontact import __version__
from viscontact.cli import commands
from viscontact.cli.declared import Declared, declared
from viscontact.cli.terminal.messages import put


def _print_version(wanted: bool) -> None:
    if wanted:
        put(f"viscontact {__version__}")
        raise typer.Exit


def viscontact(
    version: Annotated[
        bool,
        typer.Option(
            "--version", help="Print the version.", callback=_print_version, is_eager=True
        ),
    ] = False,
) -> None:
    """Simulate the contact of a body with a viscoelastic half-space over time."""


def typer_application(examples: Iterable[tuple[str, str]]) -> typer.Typer:
    """Typer application of commands, each given by its name and an example."""
    made = typer.Typer(
        name="viscontact",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode="rich",
        context_settings={"help_option_names": ["-h", "--help"]},
        epilog="Start with: viscontact demo",
    )
    made.callback()(viscontact)
    for name, example in examples:
        made.command(epilog=f"Example:  {example}")(_for_typer(getattr(commands, name)))
    return made


def _for_typer(function: Callable[..., None]) -> Callable[..., None]:
    """Command whose parameters are declared in Typer's words."""

    @wraps(function)
    def typed(**given: Any) -> None:
        function(**given)

    parameters = [
        parameter.replace(annotation=Annotated[kind, _declared(how)], kind=parameter.KEYWORD_ONLY)
        for parameter, kind, how in declared(function).values()
    ]
    del typed.__wrapped__
    typed.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    typed.__annotations__ = {each.name: each.annotation for each in parameters}
    return typed


def _declared(how: Declared) -> Any:
    words: dict[str, Any] = {"metavar": how.metavar, "help": how.help}
    words |= {"min": how.min, "max": how.max, "show_default": how.show_default}
    words["rich_help_panel"] = how.panel
    if how.names is None:
        return typer.Argument(**words)
    return typer.Option(*how.names, count=how.count, **words)
