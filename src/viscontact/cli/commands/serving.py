"""`serve`."""

from __future__ import annotations

import os
import sys
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any

import typer

from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.cli.terminal.messages import refuse, say

_NEEDED = ("fastapi", "starlette", "uvicorn", "anyio", "matplotlib", "contourpy", "plotly")


def serve(
    port: Annotated[
        int | None,
        typer.Option(
            "--port",
            metavar="N",
            min=0,
            max=65535,
            help="Which port; 0 for any, 8377 or the next one free if left out.",
        ),
    ] = None,
    directory: Annotated[
        Path | None,
        typer.Option(
            "--dir", metavar="DIR", help="Where runs and files are kept; your folder for data."
        ),
    ] = None,
    jobs: Annotated[
        int | None, typer.Option("-j", "--jobs", min=1, metavar="N", help="So many runs at once.")
    ] = None,
    browser: Annotated[
        bool, typer.Option("--open/--no-open", help="Show the page in the browser.")
    ] = True,
) -> None:
    """Serve the calculator page, to this machine only, until Ctrl-C.

    Ctrl-C ends it with exit code 0. Runs at work finish their step and save first. When the page is
    served from the same DIR again, they are there and can be gone on with.
    """
    with watched_interruption() as interruption:
        with interruption.postponed():
            server = _server()
        folder = directory or server.usual_folder()
        with _refusing(port, folder):
            listener = server.listening(port)
        address = server.address_of(listener)

        def tell() -> None:
            print(f"{address}  (Ctrl-C ends it; runs and files are in {folder})", flush=True)
            if browser and _has_display():
                webbrowser.open(address)

        with _refusing(port, folder), interruption.marching(), suppress(KeyboardInterrupt):
            server.serve(folder, listener, jobs, lambda: interruption.requested, tell)
        interruption.over = True
        say("ended")


@contextmanager
def _refusing(port: int | None, folder: Path) -> Iterator[None]:
    """Refuse a port that is taken, and a folder that cannot be used or is in use."""
    from viscontact.runs.directory.lock import DirectoryInUse
    from viscontact.web.server import PortError

    try:
        yield
    except PortError as error:
        refuse(f"--port {port}: cannot be used: {error}; choose another one")
    except DirectoryInUse:
        refuse(f"{folder}: another viscontact serves from there; choose another --dir DIR")
    except OSError as error:
        # What is said of the lock names an option that runs have.
        cause = error.__cause__ if isinstance(error.__cause__, OSError) else error
        refuse(f"{folder}: cannot be used: {cause.strerror or cause}; choose another --dir DIR")


def _server() -> Any:
    """Return `viscontact.web.server`, or say what it needs."""
    try:
        from viscontact.web import server
    except ModuleNotFoundError as error:
        if error.name not in _NEEDED:
            raise
        refuse(f"the calculator page needs {error.name}: pip install 'viscontact[web]'")
    return server


def _has_display() -> bool:
    """Whether a browser would show up beside the terminal, and not in it."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
