"""Typer application with all commands."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from typing import Annotated, Any

import typer

from viscontact import __version__
from viscontact.cli import commands
from viscontact.cli.terminal.messages import put

#: Names of the commands, each with an example; their functions are those of `cli.commands`.
_COMMANDS = {
    "demo": "viscontact demo",
    "example": "viscontact example roller-dogbone -o my.yaml",
    "check": "viscontact check my.yaml",
    "run": "viscontact run my.yaml --set load.force=20kN --set output.fields=all -o heavier",
    "status": "viscontact status forces --watch",
    "show": "viscontact show heavier",
    "plot": 'viscontact plot heavier pressure-map --time "0 s" --time "1000 s" -o map.pdf',
    "compare": "viscontact compare centred halfway end --figure history -o runs.png",
    "export": "viscontact export heavier -o heavier.csv",
    "collect": "viscontact collect forces -o forces.nc",
    "design": (
        "viscontact design my.yaml --change indenter.crown_radius='20 mm:2 m:log' "
        "--minimise peak_pressure -o best"
    ),
    "sensitivity": "viscontact sensitivity my.yaml --of peak_pressure,approach -o matters",
    "heat": "viscontact heat rolling --cooling '10 W/m2/K' --ambient '23 degC' --area '0.1 m2'",
    "leakage": (
        "viscontact leakage seal --viscosity '1 mPa s' --pressure-difference '1 bar' --along x"
    ),
    "theory": "viscontact theory road.npz --material epdm-70-25c --pressure '0.3 MPa' --time '1 h'",
    "schema": "viscontact schema > viscontact.schema.json",
    "fit": "viscontact fit dma.csv --poisson-ratio 0.38 -o fit.png --yaml pmma.yaml",
    "material": "viscontact material pmma-paper -o pmma.png",
    "report": "viscontact report heavier -o heavier.html",
    "serve": "viscontact serve --dir my-runs",
    "verify": "viscontact verify --fast",
    "doctor": "viscontact doctor",
    "cite": "viscontact cite --bibtex",
}


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


def application(names: Iterable[str] = tuple(_COMMANDS)) -> typer.Typer:
    """Typer application with some of the commands, by default with all."""
    made = typer.Typer(
        name="viscontact",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode="rich",
        context_settings={"help_option_names": ["-h", "--help"]},
        epilog="Start with: viscontact demo",
    )
    made.callback()(viscontact)
    for name in names:
        function: Callable[..., None] = getattr(commands, name)
        made.command(epilog=f"Example:  {_COMMANDS[name]}")(function)
    return made


def command_for(words: Sequence[str] | None) -> Any:
    """Click command that runs some words, by default those of the process."""
    # To build the options of all commands takes a tenth of a second.
    first, *_ = [*(sys.argv[1:] if words is None else words), ""]
    return _click_command(first if first in _COMMANDS else None)


@cache
def _click_command(name: str | None) -> Any:
    """Click command with one command, or with all of them."""
    return typer.main.get_command(application() if name is None else application([name]))
