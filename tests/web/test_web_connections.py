"""Connections that are slow, broken or too many disturb no others, and leave no traceback."""

from __future__ import annotations

import logging
import random
import socket
import threading
import time as clock
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from pathlib import Path

import httpx
import psutil
import pytest
import uvicorn

from viscontact.web import connections
from viscontact.web.app import new_app
from viscontact.web.calculator import Calculator
from viscontact.web.connections import LimitedConnection
from viscontact.web.server import listening
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.uploads import MOST_UPLOADS
from web.calculator_page import until

#: Times in place of those of `connections` [s].
HEADER, BODY = 0.4, 0.6


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("page")


@pytest.fixture(scope="module")
def port(folder: Path) -> Iterator[int]:
    """Port of a server in a thread, with short times."""
    listener = listening(0)
    app = new_app(Calculator(Folder(folder), 1))
    config = uvicorn.Config(app, http=LimitedConnection, log_config=None, access_log=False)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    with pytest.MonkeyPatch.context() as patched:
        for name, value in (("HEADER_TIME", HEADER), ("BODY_TIME", BODY), ("MOST_CONNECTIONS", 20)):
            patched.setattr(connections, name, value)
        thread.start()
        until(lambda: server.started)
        yield listener.getsockname()[1]
        server.should_exit = True
        thread.join()


def opened(port: int, sent: bytes = b"") -> socket.socket:
    connection = socket.create_connection(("127.0.0.1", port), timeout=20)
    connection.sendall(sent)
    return connection


def answers(port: int) -> bool:
    return httpx.get(f"http://127.0.0.1:{port}/api/files").status_code == 200


def lasts(connection: socket.socket, drip: bytes) -> float:
    """Time until the server closes a connection on which bytes arrive one by one [s]."""
    began = clock.monotonic()
    connection.settimeout(0.02)
    for byte in drip:
        try:
            connection.sendall(bytes([byte]))
            if not connection.recv(1000):
                break
        except TimeoutError:
            continue
        except OSError:
            break
    return clock.monotonic() - began


def request(port: int, line: str, length: int) -> bytes:
    head = f"{line} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Length: {length}\r\n\r\n"
    return head.encode()


# Slow Loris (Hansen, 2009): lines of a request that come one by one and never end.
def test_lines_of_a_request_must_arrive_in_time(port: int) -> None:
    with opened(port) as silent, opened(port, b"GET / HTTP/1.1\r\n") as slow:
        assert lasts(slow, b"X-a: b\r\n" * 20) < HEADER + 0.5
        assert silent.recv(1) == b""


@pytest.mark.parametrize("line", ["POST /api/check", "POST /api/files?name=a.csv", "PUT /nothing"])
def test_a_body_must_arrive_in_time_also_one_that_is_refused(port: int, line: str) -> None:
    with opened(port, request(port, line, 1000)) as slow:
        assert lasts(slow, b"{" * 100) < BODY + 0.5


def test_the_longest_idle_of_too_many_connections_give_way(port: int) -> None:
    with ExitStack() as held:
        many = [held.enter_context(opened(port, b"GET / HTTP/1.1\r\n")) for _ in range(40)]
        assert answers(port)
        many[0].settimeout(0.1)
        with suppress(ConnectionResetError):
            assert many[0].recv(1) == b""
    assert answers(port)


def test_no_bytes_of_a_client_cause_a_traceback(
    port: int, caplog: pytest.LogCaptureFixture
) -> None:
    begun = request(port, "POST /api/files?name=a.csv", 50_000)
    whole = request(port, "GET /api/files", 0)
    chunked = begun.replace(b"Content-Length: 50000", b"Transfer-Encoding: chunked")
    tries = [
        *(b"\x16\x03\x01 no HTTP\r\n\r\n", b"GET /\r\n\r\n", begun, begun + b"1" * 40_000),
        *(whole + b"\0\0\0\r\n\r\n", whole * 5, whole * 3 + begun, chunked + b"zz\r\n\r\n"),
        *(chunked, chunked + b"5\r\n12345\r\n0\r\n\r\n", begun.replace(b"POST", b"HEAD")),
        whole.replace(b"\r\n\r\n", b"\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\r\n"),
        whole.replace(b"\r\n\r\n", b"\r\nContent-Length: 7\r\n\r\n"),
        begun.replace(b"\r\n\r\n", b"\r\nContent-Type: multipart/form-data\r\n\r\n") + b"--x",
        begun.replace(b"\r\n\r\n", b"\r\nExpect: 100-continue\r\n\r\n"),
        request(port, "POST /api/check", 20) + b'{"yaml": "\xff\xff"}    ',
        b"GET / HTTP/1.1\r\n" + b"X: " + b"a" * 70_000,
    ]
    rng = random.Random(1)
    with caplog.at_level(logging.DEBUG):
        for sent in tries:
            for keep in (len(sent), rng.randrange(1, len(sent))):
                with suppress(OSError), opened(port, sent[:keep]) as connection:
                    if rng.random() < 0.5:
                        connection.settimeout(0.05)
                        connection.recv(10_000)
        clock.sleep(BODY + 0.2)
        assert answers(port)
    assert [each.getMessage() for each in caplog.records if each.exc_info] == []
    assert [each.getMessage() for each in caplog.records if each.levelno >= logging.ERROR] == []


PART = b"1" * 1_000_000


class _Holding(threading.Thread):
    """Client that sends half of a file, and waits."""

    def __init__(self, port: int, name: str) -> None:
        super().__init__()
        self.connection = opened(port, request(port, f"POST /api/files?name={name}", 60_000_000))
        self.start()

    def run(self) -> None:
        with suppress(OSError):
            for _ in range(30):
                self.connection.sendall(PART)


def memory() -> float:
    """Resident memory of this process, where the server is [MB]."""
    return psutil.Process().memory_info().rss / 1e6


def test_broken_uploads_leave_neither_memory_nor_files(
    port: int, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "BODY_TIME", 60.0)
    before = memory()
    for _ in range(3):
        holding = [_Holding(port, f"{number}.csv") for number in range(MOST_UPLOADS)]
        until(lambda: len(parts(folder)) == MOST_UPLOADS)
        answer = httpx.post(f"http://127.0.0.1:{port}/api/files?name=more.csv", content=b"1")
        assert answer.status_code == 429
        assert int(answer.headers["retry-after"]) > 0
        assert "uploaded already" in answer.json()["problems"][0]["message"]
        for each in holding:
            each.join()
            each.connection.close()
        until(lambda: parts(folder) == [])
    assert memory() - before < 60  # 360 MB were sent
    assert not list((folder / "files").glob("?.csv"))


def parts(folder: Path) -> list[str]:
    return [each.name for each in (folder / "files").iterdir() if each.name.endswith(".upload")]
