"""A server that is left running: its limits, heavy tasks beside light ones, its end."""

from __future__ import annotations

import os
import signal
import socket
import threading
import time as clock
from collections.abc import Iterator
from contextlib import suppress
from importlib.resources import files
from pathlib import Path

import httpx
import psutil
import pytest

from viscontact.web.cases.case_process import CaseProcess
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.runs import queue
from viscontact.web.workspace import uploads
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.problems import RequestError
from web.calculator_page import CASE, LONG_CASE, asking, begun, status, until
from web.served_page import Server, served

EXAMPLES = files("viscontact.case.examples")


def test_more_runs_than_may_wait_are_refused_for_a_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert queue.MOST_WAITING == 50
    monkeypatch.setattr(queue, "MOST_WAITING", 2)
    with asking(tmp_path, at_once=0) as client:  # every run waits
        first, second = begun(client), begun(client)
        refused = client.post("/api/runs", json={"yaml": CASE})
        assert refused.status_code == 429
        assert 1 <= int(refused.headers["retry-after"]) <= 600
        assert refused.json()["problems"][0]["message"].startswith("2 runs are waiting already")
        assert len(list((tmp_path / "runs").iterdir())) == 2
        client.post(f"/api/runs/{first}/cancel")
        begun(client)
        assert client.post(f"/api/runs/{first}/resume").status_code == 429
        assert status(client, second)["state"] == "waiting"


def test_a_folder_takes_so_many_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with asking(tmp_path) as client:
        here = len(client.get("/api/files").json())
        monkeypatch.setattr(uploads, "MOST_FILES", here + 1)
        assert client.post("/api/files?name=a.csv", content=b"1").status_code == 201
        assert client.post("/api/files?name=a.csv", content=b"2").status_code == 201
        refused = client.post("/api/files?name=b.csv", content=b"1")
        assert refused.status_code == 507
        assert refused.json()["problems"][0]["message"] == (
            f"the folder has {here + 1} files, and takes {here + 1} at most; remove some of them"
        )
        assert (tmp_path / "files" / "a.csv").read_bytes() == b"2"


def test_parts_of_files_of_a_killed_server_are_removed(tmp_path: Path) -> None:
    (tmp_path / "files").mkdir()
    (tmp_path / "files" / ".0123.upload").write_bytes(b"1")
    Folder(tmp_path)
    assert not list((tmp_path / "files").glob(".*"))


def _end(cases: CaseReader) -> None:
    os._exit(3)


def _fail(cases: CaseReader) -> None:
    raise ZeroDivisionError("by zero")


@pytest.mark.slow
def test_cases_are_read_in_a_process_that_is_replaced_when_it_ends(tmp_path: Path) -> None:
    folder = Folder(tmp_path)
    process = CaseProcess(folder)
    try:
        checked = process.do(CaseReader.check, CASE, "full")["cells"]
        assert checked == CaseReader(folder).check(CASE, "full")["cells"]
        with pytest.raises(RequestError) as refused:
            process.do(CaseReader.check, CASE.replace("4 N", "4 mm"), "full")
        assert refused.value.status == 422
        assert refused.value.body["problems"][0]["path"] == "load.force"
        with pytest.raises(ZeroDivisionError) as failed:
            process.do(_fail)
        assert "in _fail" in failed.value.__notes__[0]  # its traceback
        with pytest.raises(RequestError, match="has ended unexpectedly"):
            process.do(_end)
        assert process.do(CaseReader.values, CASE)["title"] == "Zener sphere"
    finally:
        process.close()
    with pytest.raises(RequestError):
        process.do(CaseReader.values, CASE)


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    with served(tmp_path_factory.mktemp("served") / "page") as server:
        yield server


def client_of(server: Server) -> httpx.Client:
    words = {"authorization": f"token {server.token}"}
    return httpx.Client(base_url=server.page, headers=words, timeout=300)


@pytest.mark.slow
def test_light_requests_are_answered_within_a_second_while_heavy_ones_are(server: Server) -> None:
    heavy = (EXAMPLES / "rubber-covered-roll.yaml").read_text(encoding="utf-8")
    with client_of(server) as client:
        until(lambda: status(client, begun(client))["state"] != "waiting")
        asked = [{"yaml": f"{heavy}# {number}\n"} for number in range(2)]
        threads = [
            threading.Thread(target=client.post, args=("/api/check",), kwargs={"json": each})
            for each in asked
        ]
        for thread in threads:
            thread.start()
        longest, count = 0.0, 0
        while any(thread.is_alive() for thread in threads):
            for path in ("/", "/static/main.js", "/api/version", "/api/runs", "/api/files"):
                began = clock.monotonic()
                assert client.get(path).status_code == 200
                longest = max(longest, clock.monotonic() - began)
                count += 1
    assert count > 20
    assert longest < 1.0


@pytest.mark.slow
def test_a_posted_run_costs_the_server_little(server: Server) -> None:
    assert server.process
    process = psutil.Process(server.process.pid)
    with client_of(server) as client:
        begun(client)
        before = sum(process.cpu_times()[:2])
        for number in range(10):
            begun(client, CASE.replace("4 N", f"{number + 5} N"))
        assert sum(process.cpu_times()[:2]) - before < 10 * 0.15


#: Steps of seconds each, none of which is over when the server has to end.
WIDE = CASE.replace("[24, 24]", "[1500, 1500]").replace("5 s]}", "5 s], errors: false}")


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="there, only the console asks processes to stop")
def test_a_server_with_everything_going_on_ends_within_five_seconds_and_has_saved(
    tmp_path: Path,
) -> None:
    with served(tmp_path) as server, client_of(server) as client:
        runs = [begun(client, text) for text in (LONG_CASE, WIDE, WIDE)]
        until(lambda: status(client, runs[0])["step"] > 3)
        children = psutil.Process(server.process.pid).children(recursive=True)  # type: ignore[union-attr]
        held = [half_an_upload(server), unread(server, runs[0])]
        heavy = (EXAMPLES / "rubber-covered-roll.yaml").read_text(encoding="utf-8")
        checking = threading.Thread(target=_post, args=(client, heavy))
        checking.start()
        clock.sleep(0.5)
        code, said, seconds = ended(server)
        checking.join()
        for each in held:
            each.close()
    assert (code, seconds < 6.0) == (0, True)  # five, and the interpreter's end on a busy machine
    assert "Traceback" not in said
    assert said.splitlines()[-1] == "ended"
    psutil.wait_procs(children, 5)
    assert [each for each in children if each.is_running()] == []
    with asking(tmp_path, at_once=0) as client:
        found = [status(client, run) for run in runs]
        assert {each["state"] for each in found} == {"interrupted"}
        assert all(each["resumable"] for each in found)
        assert found[0]["step"] > 3


def _post(client: httpx.Client, text: str) -> None:
    with suppress(httpx.HTTPError):
        client.post("/api/check", json={"yaml": text})


def ended(server: Server) -> tuple[int, str, float]:
    """Exit code, what a server has printed, and the time until it has ended [s]."""
    process = server.process
    assert process
    began = clock.monotonic()
    process.send_signal(signal.SIGTERM)
    said, _ = process.communicate(timeout=60)
    server.process = None
    return process.returncode, said, clock.monotonic() - began


def half_an_upload(server: Server) -> socket.socket:
    lines = ["POST /api/files?name=a.csv HTTP/1.1", "Content-Length: 50000", ""]
    return _sent(server, lines, b"1" * 20_000)


def unread(server: Server, run: str) -> socket.socket:
    """Follow a run without reading the events."""
    return _sent(server, [f"GET /api/runs/{run}/events HTTP/1.1", ""], b"")


def _sent(server: Server, lines: list[str], body: bytes) -> socket.socket:
    own = [f"Host: 127.0.0.1:{server.port}", f"Authorization: token {server.token}"]
    connection = socket.create_connection(("127.0.0.1", server.port))
    connection.sendall("\r\n".join([lines[0], *own, *lines[1:], ""]).encode() + body)
    return connection
