"""The commands together, and the way out: an exit code, never a traceback."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from viscontact import __version__
from viscontact.cli.cases import demo, example, schema
from viscontact.cli.drawing import compare, plot
from viscontact.cli.fitting import fit
from viscontact.cli.later import report
from viscontact.cli.materials import material
from viscontact.cli.messages import INTERRUPTED, REFUSED, STOPPED, say
from viscontact.cli.running import check, run
from viscontact.cli.showing import export, show
from viscontact.cli.verification import verify

app = typer.Typer(
    name="viscontact",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Start with: viscontact demo",
)

_COMMANDS = (
    (demo, "viscontact demo"),
    (example, "viscontact example roller-dogbone -o my.yaml"),
    (check, "viscontact check my.yaml"),
    (run, "viscontact run my.yaml --set load.force=20kN --set output.fields=all -o heavier"),
    (show, "viscontact show heavier"),
    (plot, 'viscontact plot heavier pressure-map --time "0 s" --time "1000 s" -o map.pdf'),
    (compare, "viscontact compare centred halfway end --figure history -o runs.png"),
    (export, "viscontact export heavier -o heavier.csv"),
    (schema, "viscontact schema > viscontact.schema.json"),
    (fit, "viscontact fit dma.csv --poisson-ratio 0.38 -o fit.png --yaml pmma.yaml"),
    (material, "viscontact material pmma-paper -o pmma.png"),
    (report, "viscontact report heavier -o heavier.html"),
    (verify, "viscontact verify --fast"),
)
for _command, _example in _COMMANDS:
    app.command(epilog=f"Example:  {_example}")(_command)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"viscontact {__version__}")
        raise typer.Exit


@app.callback()
def viscontact(
    version: Annotated[
        bool,
        typer.Option(
            "--version", help="Print the version.", callback=_print_version, is_eager=True
        ),
    ] = False,
) -> None:
    """Press a body on a creeping half-space and see what happens over time."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        What was typed behind ``viscontact``; the process's arguments when left out.

    Returns
    -------
    int
        The exit code: 0 done, 2 refused before anything was created, 1 stopped during the
        work, 130 interrupted.

    Examples
    --------
    >>> main(["--version"])
    viscontact 0.1.0
    0
    """
    _prepare_process()
    try:
        typed = None if arguments is None else list(arguments)
        return int(app(typed, prog_name="viscontact", standalone_mode=False) or 0)
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        return _closed_pipe()
    except Exception as error:
        return _usage_or_fault(error)


def _prepare_process() -> None:
    # Inner products over a contact are too short for the threads of a BLAS, which then wait for
    # one another: ten times slower on a busy machine. NumPy reads this when it is first imported.
    for library in ("OPENBLAS", "MKL", "OMP", "BLIS"):
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
    # A terminal that cannot write "mm²" gets "mm?", not an error.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def _usage_or_fault(error: Exception) -> int:
    # Typer's own errors know how to show themselves; their class has moved between its versions.
    show_itself = getattr(error, "show", None)
    if show_itself is not None:
        show_itself()
        return int(getattr(error, "exit_code", REFUSED))
    if os.environ.get("VISCONTACT_TRACEBACK"):
        raise error
    say(f"viscontact: unexpected {type(error).__name__}: {error}")
    say("This is a fault of viscontact; set VISCONTACT_TRACEBACK=1 to see where, and report it.")
    return STOPPED


def _closed_pipe() -> int:
    # `viscontact show DIR | head`: the reader has had enough, and Python would complain again
    # when it flushes stdout at the end.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return STOPPED
