"""The commands, and the call that words at the command line stand for."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import cache, partial
from typing import Any

from viscontact.cli import commands
from viscontact.cli.plain_words import plain_arguments
from viscontact.runs.processes.request import DONE, INTERRUPTED

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


def call_for(words: Sequence[str] | None) -> Callable[[], Any]:
    """Call that words stand for, by default those of the process."""
    typed = list(sys.argv[1:] if words is None else words)
    # Shells ask for completions by a variable.
    if typed and typed[0] in _COMMANDS and "_VISCONTACT_COMPLETE" not in os.environ:
        function: Callable[..., None] = getattr(commands, typed[0])
        given = plain_arguments(function, typed[1:])
        if given is not None:
            return partial(_run, function, given)
    command = command_for(words)
    given_words = None if words is None else typed
    return partial(command, given_words, prog_name="viscontact", standalone_mode=False)


def _run(function: Callable[..., None], given: dict[str, Any]) -> int:
    try:
        function(**given)
    except KeyboardInterrupt:  # of which Typer makes the same code
        return INTERRUPTED
    return DONE


def application(names: Iterable[str] = tuple(_COMMANDS)) -> Any:
    """Typer application with some of the commands, by default with all."""
    # It takes a tenth of a second to import, and is for help, errors and what is unusual.
    from viscontact.cli.typed_words import typer_application

    return typer_application((name, _COMMANDS[name]) for name in names)


def command_for(words: Sequence[str] | None) -> Any:
    """Click command that runs some words, by default those of the process."""
    # To build the options of all commands takes a tenth of a second.
    first, *_ = [*(sys.argv[1:] if words is None else words), ""]
    return _click_command(first if first in _COMMANDS else None)


@cache
def _click_command(name: str | None) -> Any:
    """Click command with one command, or with all of them."""
    from typer.main import get_command

    return get_command(application() if name is None else application([name]))
