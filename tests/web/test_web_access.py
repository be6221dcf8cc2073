"""Who has no token is refused on every route; files are for the owner of the server only."""

from __future__ import annotations

import json
import os
import re
import stat
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi.routing import APIRoute
from fastapi.testclient import TestClient

from viscontact.web.access import TOKEN_NAME, kept_token, open_page
from viscontact.web.app import new_app
from viscontact.web.calculator import Calculator
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.privacy import owner_only
from web.calculator_page import CASE, HOST, asking
from web.served_page import served

TOKEN = "0123456789abcdef" * 3
BY_HEADER = {"authorization": f"token {TOKEN}"}


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page"), token=TOKEN) as client:
        yield client


@pytest.fixture
def visitor(client: TestClient) -> TestClient:
    """A browser that has never been here."""
    return TestClient(client.app, base_url=HOST)


def routes(folder: Path) -> list[tuple[str, str]]:
    """Method and path of every route, with names in place of parameters."""
    app: Any = new_app(Calculator(Folder(folder), 1))
    found = [route for route in _all_routes(app._app.routes) if isinstance(route, APIRoute)]
    return [(m, re.sub(r"{\w+}", "svg", r.path)) for r in found for m in sorted(r.methods)]


def _all_routes(found: Any) -> Iterator[Any]:
    for each in found:
        inner = getattr(each, "original_router", None)
        yield from [each] if inner is None else _all_routes(inner.routes)


def test_every_route_refuses_who_has_no_token(visitor: TestClient, tmp_path: Path) -> None:
    asked = routes(tmp_path)
    assert len(asked) > 25
    assert {"/", "/static/svg", "/api/runs/svg/events", "/api/files"} <= {path for _, path in asked}
    wrong = ({}, {"authorization": "token wrong"}, {"cookie": f"viscontact-8377={TOKEN}"})
    for method, path in [*asked, ("GET", "/nothing"), ("GET", f"/static/main.js?token={TOKEN}")]:
        for headers in wrong:
            answer = visitor.request(method, path, headers=headers)
            assert answer.status_code == 401, (method, path)
            assert answer.headers["www-authenticate"].startswith("Bearer")
            assert "set-cookie" not in answer.headers
            assert "asks for its token" in answer.json()["problems"][0]["message"]


def test_a_browser_without_the_token_is_shown_what_to_do(visitor: TestClient) -> None:
    for address in ("/", "/?token=wrong", "/?token=", "/?token=%00%ff"):
        answer = visitor.get(address, headers={"accept": "text/html,*/*"})
        assert answer.status_code == 401
        assert answer.headers["content-type"].startswith("text/html")
        assert "open the address that <code>viscontact serve</code> has printed" in answer.text
        assert TOKEN not in answer.text
    foreign = visitor.get("/", headers={"accept": "text/html", "host": "<b>"})
    assert foreign.status_code == 403
    assert "was called '&lt;b&gt;'" in foreign.text


# RFC 6265bis: no script reads a cookie that is HttpOnly, and other sites do not send a Strict one.
def test_address_with_the_token_gives_a_cookie_for_all_routes(visitor: TestClient) -> None:
    assert visitor.get(f"/?token={TOKEN}").status_code == 200
    (cookie,) = visitor.cookies.jar
    assert cookie.name == "viscontact-8377"  # cookies do not distinguish ports
    assert cookie.value != TOKEN
    assert cookie.has_nonstandard_attr("HttpOnly")
    assert cookie.get_nonstandard_attr("SameSite") == "Strict"
    assert (cookie.domain, cookie.path) == ("127.0.0.1", "/")  # as no Domain is set
    for path in ("/", "/static/main.js", "/api/runs", "/static/plotly.min.js"):
        assert visitor.get(path).status_code == 200


@pytest.mark.parametrize("word", ["token", "Bearer", "bearer"])
def test_programs_send_the_token_in_a_header(visitor: TestClient, word: str) -> None:
    answer = visitor.get("/api/runs", headers={"authorization": f"{word} {TOKEN}"})
    assert answer.status_code == 200
    assert "set-cookie" not in answer.headers


def test_the_token_admits_no_other_site(visitor: TestClient) -> None:
    answer = visitor.get(f"/?token={TOKEN}", headers={"host": "evil.example"})
    assert answer.status_code == 403
    foreign = {**BY_HEADER, "origin": "https://evil.example"}
    assert visitor.post("/api/check", json={"yaml": CASE}, headers=foreign).status_code == 403


def test_a_token_is_kept_by_its_folder_unless_others_could_read_it(tmp_path: Path) -> None:
    token = kept_token(tmp_path)
    assert re.fullmatch("[0-9a-f]{48}", token)
    assert mode(tmp_path / TOKEN_NAME) == 0o600
    assert kept_token(tmp_path) == token
    (tmp_path / TOKEN_NAME).chmod(0o644)
    fresh = kept_token(tmp_path)
    assert (fresh != token, mode(tmp_path / TOKEN_NAME)) == (True, 0o600)
    for damage in ("", "short", "z" * 48):
        (tmp_path / TOKEN_NAME).write_text(damage, encoding="utf-8")
        assert kept_token(tmp_path) not in (damage, fresh)
    (tmp_path / TOKEN_NAME).unlink()
    (tmp_path / TOKEN_NAME).symlink_to(tmp_path / "elsewhere")
    kept_token(tmp_path)
    assert not (tmp_path / "elsewhere").exists()


def test_the_token_is_no_argument_of_the_browser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    open_page(tmp_path, f"{HOST}/?token={TOKEN}")
    (address,) = opened
    assert TOKEN not in address
    page = tmp_path / "open.html"
    assert address == page.as_uri()
    assert f'content="0;url={HOST}/?token={TOKEN}"' in page.read_text(encoding="utf-8")
    assert mode(page) == 0o600


def mode(path: Path) -> int:
    return stat.S_IMODE(path.lstat().st_mode)


@pytest.mark.skipif(os.name == "nt", reason="there are no such modes")
def test_a_folder_of_before_is_taken_from_others(tmp_path: Path) -> None:
    page, outside = tmp_path / "page", tmp_path / "outside"
    run = page / "runs" / "20260101-000000-aaaaaa"
    for place in (page / "files", run / "run", outside):
        place.mkdir(parents=True)
    written = [page / "files" / "a.csv", run / "request.json", run / "run" / "result.nc"]
    for file in (*written, outside / "b.csv"):
        file.write_bytes(b"1")
    (page / "runs" / "linked").symlink_to(outside)
    for each in (tmp_path, *tmp_path.rglob("*")):
        if not each.is_symlink():
            each.chmod(0o755 if each.is_dir() else 0o644)
    with owner_only():
        Folder(page)
    assert {mode(each) for each in (page, *page.rglob("*")) if each.is_dir()} <= {0o700, 0o777}
    assert {mode(each) for each in page.rglob("*") if each.is_file()} == {0o600}
    assert (mode(tmp_path), mode(outside), mode(outside / "b.csv")) == (0o755, 0o755, 0o644)


@pytest.mark.skipif(os.name == "nt", reason="there are no such modes")
def test_a_folder_with_other_content_stays_open_but_for_what_is_ours(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine", encoding="utf-8")
    (tmp_path / "thesis.txt").chmod(0o644)
    tmp_path.chmod(0o755)
    Folder(tmp_path)
    assert (mode(tmp_path), mode(tmp_path / "thesis.txt")) == (0o755, 0o644)
    assert (mode(tmp_path / "files"), mode(tmp_path / "runs")) == (0o700, 0o700)


#: What another user tries: every route, the files, and the arguments of the processes.
TRIES = """
import http.client, json, os, sys

port, folder, asked = json.loads(sys.stdin.read())
answers = []
for method, path in asked:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
    connection.request(method, path, body=b"1" if method == "POST" else None)
    answers.append(connection.getresponse().status)
opened = []
for place, folders, names in os.walk(folder):
    opened += names
for name in ("token", "files", "runs", "open.html", "files/rough-patch.npz"):
    try:
        os.stat(os.path.join(folder, name))
        opened.append(name)
    except PermissionError:
        pass
arguments = []
for process in filter(str.isdigit, os.listdir("/proc")):
    try:
        arguments.append(open(f"/proc/{process}/cmdline", errors="replace").read())
    except OSError:
        pass
print(json.dumps([answers, opened, arguments]))
"""


def _python_of_nobody() -> str:
    """A Python that this process may start as another user; empty if there is none."""
    if os.name == "nt" or os.geteuid() != 0:
        return ""
    for python in (sys.executable, "/usr/bin/python3"):
        with suppress(OSError, LookupError, subprocess.SubprocessError):
            subprocess.run([python, "-I", "-c", ""], user="nobody", check=True)
            return python
    return ""


@pytest.mark.slow
def test_another_user_of_the_machine_is_refused_on_every_route() -> None:
    """As `nobody`, with a folder in a place that all users can enter."""
    if not (python := _python_of_nobody()):
        pytest.skip("only root can become another user")
    with tempfile.TemporaryDirectory() as open_place:
        Path(open_place).chmod(0o755)
        folder = Path(open_place) / "page"
        with served(folder) as server:
            asked = routes(Path(open_place) / "other")
            tried = subprocess.run(
                [python, "-I", "-c", TRIES],
                input=json.dumps([server.port, str(folder), asked]),
                capture_output=True,
                text=True,
                user="nobody",
                group="nogroup",
                extra_groups=[],
                check=False,
            )
            answers, opened, arguments = json.loads(tried.stdout or f'"{tried.stderr}"')
            assert answers == [401] * len(asked)
            assert opened == []
            assert arguments
            assert not [each for each in arguments if server.token in each]
            assert server.ask("api/runs") == []
        assert {mode(each) & 0o077 for each in (folder, *folder.rglob("*"))} == {0}


@pytest.mark.slow
def test_without_a_token_the_command_says_what_that_gives_up(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "viscontact", "serve", "--no-open", "--no-token"]
    with subprocess.Popen(
        [*command, "--port", "0", "--dir", str(tmp_path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout
        assert process.stderr
        address = process.stdout.readline().split()[0]
        assert httpx.get(f"{address}api/runs").status_code == 200
        assert process.stderr.readline() == (
            "without a token, every user and program of this machine can see, change and delete "
            "the runs and files\n"
        )
        process.terminate()
    assert not (tmp_path / TOKEN_NAME).exists()
