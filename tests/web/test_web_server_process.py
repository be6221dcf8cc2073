"""The process of the calculator page: stopped and started again, it continues its runs."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time as clock
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx
import pytest

from viscontact.cli import main
from web.calculator_page import LONG_CASE, begun, followed, status, until
from web.run_numbers import by_command_line, numbers


class Served:
    """`viscontact serve`, as anybody could type it."""

    def __init__(self, folder: Path) -> None:
        command = [sys.executable, "-m", "viscontact", "serve", "--no-open", "--port", "0"]
        self.process = subprocess.Popen(
            [*command, "--dir", str(folder)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert self.process.stdout is not None
        page, _, token = self.process.stdout.readline().split()[0].partition("?token=")
        words = {"authorization": f"token {token}"}
        self.client = httpx.Client(base_url=page, timeout=60, headers=words)

    def end(self, number: int) -> tuple[int, str]:
        """Send it a signal, and return its exit code and what it said."""
        self.process.send_signal(number)
        _, said = self.process.communicate(timeout=60)
        self.client.close()
        return self.process.returncode, said


@pytest.fixture
def serving(tmp_path: Path) -> Iterator[Callable[[], Served]]:
    """Return a function that starts a server; none outlasts its test."""
    servers: list[Served] = []

    def start() -> Served:
        servers.append(Served(tmp_path / "page"))
        return servers[-1]

    yield start
    for server in servers:
        if server.process.poll() is None:
            server.process.kill()
            server.process.communicate()


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="there, only the console asks processes to stop")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_a_server_stopped_in_mid_run_shows_the_run_again_and_continues_it(
    serving: Callable[[], Served], tmp_path: Path, number: int
) -> None:
    text = LONG_CASE.replace("12000", "4000")
    first = serving()
    run = begun(first.client, text)
    waiting = [begun(first.client, text) for _ in range(2)][-1]
    until(lambda: status(first.client, run)["step"] > 3)
    code, _ = first.end(number)
    assert code == (-number if number == signal.SIGKILL else 0)

    second = serving()
    # One whose server was killed finishes its step by itself.
    until(lambda: all(each["over"] for each in second.client.get("/api/runs").json()))
    reply = status(second.client, run)
    assert reply["state"] == "interrupted"
    assert reply["resumable"]
    assert 3 < reply["step"] < 4000
    assert status(second.client, waiting)["state"] == "interrupted"
    for each in (run, waiting):
        second.client.post(f"/api/runs/{each}/resume")
    results = []
    for each in (run, waiting):
        assert followed(second.client, each)[-1]["state"] == "done"
        results.append(tmp_path / f"{each}.nc")
        results[-1].write_bytes(second.client.get(f"/api/runs/{each}/result.nc").content)
    whole = numbers(by_command_line(text, tmp_path))
    assert [numbers(result) for result in results] == [whole, whole]
    assert second.end(signal.SIGINT)[0] == 0


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="there, only the console asks processes to stop")
def test_a_server_answers_until_it_is_asked_to_end_and_its_runs_have_saved(
    serving: Callable[[], Served], tmp_path: Path
) -> None:
    server = serving()
    assert server.client.base_url.host == "127.0.0.1"
    run = begun(server.client, LONG_CASE)
    until(lambda: status(server.client, run)["step"] > 3)
    # A second one may not write to the same folder.
    again = [sys.executable, "-m", "viscontact", "serve", "--no-open", "--port", "0"]
    refused = subprocess.run(
        [*again, "--dir", str(tmp_path / "page")],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert refused.returncode == 2
    assert refused.stderr.count("\n") == 1
    assert "another viscontact serves from there" in refused.stderr
    with ThreadPoolExecutor(1) as pool:
        seen = pool.submit(followed, server.client, run)
        clock.sleep(0.5)
        code, said = server.end(signal.SIGTERM)
        assert seen.result()[-1]["state"] == "interrupted"  # whoever looks on sees the end
    assert code == 0
    assert said.splitlines() == ["stopping after this step; once more to stop now", "ended"]
    (asked,) = (tmp_path / "page" / "runs").glob("*/request.json")
    assert json.loads(asked.read_text(encoding="utf-8"))["state"] == "interrupted"
    assert (asked.parent / "run" / "state.npz").is_file()


def test_a_port_that_is_taken_is_refused_in_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        words = ["serve", "--no-open", "--port", str(port), "--dir", str(tmp_path)]
        assert main(words) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"--port {port}: cannot be used: ")
    assert said.count("\n") == 1


def test_without_the_extra_a_line_names_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in [name for name in sys.modules if name.startswith("viscontact.web")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "uvicorn", None)  # what an import of it meets
    assert main(["serve", "--no-open"]) == 2
    assert capsys.readouterr().err == (
        "the calculator page needs uvicorn: pip install 'viscontact[web]'\n"
    )
