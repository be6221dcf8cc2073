"""`serve`: the calculator page."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Any, NoReturn

from viscontact.cli.declared import option
from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.cli.terminal.messages import put, refuse, say

_NO_TOKEN = (
    "without a token, every user and program of this machine can see, change and delete the runs "
    "and files"
)
_NEEDED = ("fastapi", "starlette", "uvicorn", "h11", "anyio", "matplotlib", "plotly")


def serve(
    port: Annotated[
        int | None,
        option(
            "--port",
            metavar="N",
            min=0,
            max=65535,
            help="Port; 0 for any free one. By default 8377, or the next free one.",
        ),
    ] = None,
    directory: Annotated[
        Path | None,
        option(
            "--dir",
            metavar="DIR",
            help="Directory of runs and files; by default in your folder for application data.",
        ),
    ] = None,
    jobs: Annotated[
        int | None,
        option("-j", "--jobs", min=1, metavar="N", help="Number of runs at the same time."),
    ] = None,
    browser: Annotated[
        bool, option("--open/--no-open", help="Open the page in the browser.")
    ] = True,
    no_token: Annotated[
        bool,
        option(
            "--no-token",
            help="Ask for no token: every user and program of this machine can then see, change "
            "and delete runs and files.",
        ),
    ] = False,
) -> None:
    """Serve the calculator page to this machine only, until Ctrl-C.

    The printed address contains a token; only who has it can use the page. Ctrl-C ends it with
    exit code 0; active runs finish their step and save first. When the page is served from the same
    DIR again, they can be continued.
    """
    with watched_interruption() as interruption:
        with interruption.postponed():
            server = _server()
        folder = directory or server.usual_folder()
        with _refusing(port, folder):
            listener = server.listening(port)

        def announce(address: str) -> None:
            put(f"{address}  (Ctrl-C ends it; runs and files are in {folder})", flush=True)
            if no_token:
                say(_NO_TOKEN)
            if browser and _has_display():
                server.open_page(folder, address)

        service = server.Service(folder, listener, jobs, needs_token=not no_token)
        with _refusing(port, folder), interruption.marching(), suppress(KeyboardInterrupt):
            server.serve(service, lambda: interruption.requested, announce)
        interruption.over = True
        say("ended")
        _end_at_once()


@contextmanager
def _refusing(port: int | None, folder: Path) -> Iterator[None]:
    """Refuse a port or a folder that cannot be used."""
    from viscontact.runs.directory.lock import DirectoryInUse
    from viscontact.web.server import PortError

    try:
        yield
    except PortError as error:
        refuse(f"--port {port}: cannot be used: {error}; choose another one")
    except DirectoryInUse:
        refuse(f"{folder}: another viscontact serves from there; choose another --dir DIR")
    except OSError as error:
        # The message of the lock names an option of `run`.
        cause = error.__cause__ if isinstance(error.__cause__, OSError) else error
        refuse(f"{folder}: cannot be used: {cause.strerror or cause}; choose another --dir DIR")


def _end_at_once() -> NoReturn:
    """End the process: Python would wait for its threads, and tear down all that was imported."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(0)


def _server() -> Any:
    """Return `viscontact.web.server`, or name the missing package."""
    try:
        from viscontact.web import server
    except ModuleNotFoundError as error:
        if error.name not in _NEEDED:
            raise
        _refuse_without(error.name)
    for name in _NEEDED:  # some are imported after the first page only
        if name not in sys.modules and find_spec(name) is None:
            _refuse_without(name)
    return server


def _refuse_without(package: str) -> NoReturn:
    refuse(f"the calculator page needs {package}: pip install 'viscontact[web]'")


def _has_display() -> bool:
    """True if a browser would open in a window, and not in the terminal."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
