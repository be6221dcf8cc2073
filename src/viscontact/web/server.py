"""Process of the server: its socket, its start and its end."""

from __future__ import annotations

import os
import socket
import threading
import time as clock
from collections.abc import Callable
from contextlib import ExitStack, closing
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import uvicorn

from viscontact import web
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.directory.lock import locked
from viscontact.web.access import Access, kept_token, open_page
from viscontact.web.connections import LimitedConnection
from viscontact.web.front import Front
from viscontact.web.guard import Guard
from viscontact.web.workspace.folder import Folder, usual_folder
from viscontact.web.workspace.privacy import owner_only

if TYPE_CHECKING:
    from fastapi import FastAPI

HOST = "127.0.0.1"

#: Ports tried in turn by default.
USUAL_PORTS = range(8377, 8387)

#: Time between two looks at what asks the server to end [s].
_INTERVAL = 0.1
#: Time for unfinished answers when the server ends [s].
_LAST_ANSWERS = 4
#: Connections that wait to be accepted, and that are accepted at once.
_BACKLOG = 100


class PortError(Exception):
    """Port that cannot be used."""


def listening(port: int | None) -> socket.socket:
    """Return a socket that is reachable from this machine only."""
    if port is not None:
        return _bound(port)
    for usual in USUAL_PORTS:
        try:
            return _bound(usual)
        except PortError:
            continue
    return _bound(0)


@dataclass(frozen=True)
class Service:
    """Server of a folder: its socket, its number of runs at the same time, its need of a token."""

    path: Path
    listener: socket.socket
    at_once: int | None = None
    needs_token: bool = True

    def address(self, token: str) -> str:
        """Return the address to type into a browser."""
        page = f"http://{HOST}:{self.listener.getsockname()[1]}/"
        return f"{page}?token={token}" if token else page


def serve(
    service: Service, is_to_stop: Callable[[], bool], on_start: Callable[[str], None]
) -> None:
    """Serve the page until `is_to_stop()`, and until the active runs have saved.

    `on_start` gets the address of the page.
    """
    path = service.path
    with ExitStack() as opened:
        opened.enter_context(closing(service.listener))
        opened.enter_context(owner_only())
        path.mkdir(parents=True, exist_ok=True)
        check = opened.enter_context(locked(path))
        folder = Folder(path)
        token = kept_token(path) if service.needs_token else ""
        front = Front(partial(_application, folder, service.at_once))
        config = uvicorn.Config(
            Guard(front, Access(token)),
            http=LimitedConnection,
            backlog=_BACKLOG,
            log_level="error",  # warnings are about what clients send
            access_log=False,
            server_header=False,
            proxy_headers=False,
            ws="none",
            timeout_graceful_shutdown=_LAST_ANSWERS,
        )

        def is_over() -> bool:
            check()  # LockLost, once another server has taken the folder over
            return is_to_stop()

        started = partial(on_start, service.address(token))
        _run(uvicorn.Server(config), service.listener, front, is_over, started)


def _application(folder: Folder, at_once: int | None) -> FastAPI:
    """Import what answers with cases and runs, and make its application."""
    calculator = web.Calculator(folder, at_once or web.usual_at_once(), keeps_spare=True)
    return web.unguarded(calculator)


def _run(
    server: uvicorn.Server,
    listener: socket.socket,
    front: Front,
    is_to_stop: Callable[[], bool],
    on_start: Callable[[], None],
) -> None:
    # In a thread of its own, uvicorn does not replace the signal handlers of the command.
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        while not server.started and thread.is_alive():
            clock.sleep(_INTERVAL)
        if server.started:
            on_start()
        while thread.is_alive() and not is_to_stop():
            clock.sleep(_INTERVAL)
    finally:
        front.end()
        server.should_exit = True
        thread.join()


def _bound(port: int) -> socket.socket:
    listener = socket.socket()
    try:
        # Allow a port that was closed a moment ago. Windows allows it anyway; there the option
        # would let two servers share the port.
        if os.name != "nt":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((HOST, port))
    except OSError as error:
        listener.close()
        raise PortError(error.strerror or str(error)) from error
    return listener


__all__ = ["PortError", "Service", "listening", "open_page", "serve", "usual_folder"]
