"""The server's process: an address on this machine, and its end."""

from __future__ import annotations

import os
import socket
import threading
import time as clock
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import uvicorn

from viscontact.runs.directory.lock import locked
from viscontact.web.app import new_app
from viscontact.web.calculator import LOOK, Calculator
from viscontact.web.runs.queue import usual_at_once
from viscontact.web.workspace.folder import Folder, usual_folder

HOST = "127.0.0.1"

#: Tried in turn if nobody names a port.
USUAL_PORTS = range(8377, 8387)

#: Answers that are being made when the server ends have so long to be finished [s].
_LAST_ANSWERS = 5


class PortError(Exception):
    """A port cannot be used."""


def listening(port: int | None) -> socket.socket:
    """Return a socket on this machine alone."""
    if port is not None:
        return _bound(port)
    for usual in USUAL_PORTS:
        try:
            return _bound(usual)
        except PortError:
            continue
    return _bound(0)


def address_of(listener: socket.socket) -> str:
    """Return the address to type into a browser."""
    return f"http://{HOST}:{listener.getsockname()[1]}/"


def serve(
    path: Path,
    listener: socket.socket,
    at_once: int | None,
    is_to_stop: Callable[[], bool],
    on_start: Callable[[], None],
) -> None:
    """Serve the page until somebody wants it to end, and the runs at work have saved."""
    path.mkdir(parents=True, exist_ok=True)
    with locked(path), closing(listener):
        calculator = Calculator(Folder(path), at_once or usual_at_once())
        config = uvicorn.Config(
            new_app(calculator),
            log_level="warning",
            access_log=False,
            server_header=False,
            proxy_headers=False,
            ws="none",
            timeout_graceful_shutdown=_LAST_ANSWERS,
        )
        _run(uvicorn.Server(config), listener, calculator, is_to_stop, on_start)


def _run(
    server: uvicorn.Server,
    listener: socket.socket,
    calculator: Calculator,
    is_to_stop: Callable[[], bool],
    on_start: Callable[[], None],
) -> None:
    # In a thread of its own it leaves signals to who has met them from the start.
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        while not server.started and thread.is_alive():
            clock.sleep(LOOK)
        if server.started:
            on_start()
        while thread.is_alive() and not is_to_stop():
            clock.sleep(LOOK)
    finally:
        calculator.is_to_end = True
        server.should_exit = True
        thread.join()


def _bound(port: int) -> socket.socket:
    listener = socket.socket()
    try:
        # A port that was given back a moment ago may be taken again; on Windows it may anyway, and
        # this would let two servers share it.
        if os.name != "nt":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((HOST, port))
    except OSError as error:
        listener.close()
        raise PortError(error.strerror or str(error)) from error
    return listener


__all__ = ["PortError", "address_of", "listening", "serve", "usual_folder"]
