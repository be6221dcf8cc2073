"""Requests to the calculator page are answered for its own pages on this machine only."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient
from httpx import Response

from viscontact.web.routes import case_routes
from web.calculator_page import CASE, HOST, asking


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page")) as client:
        yield client


# By DNS rebinding (Jackson et al., CCS 2007) a site lets its own name lead to this machine; then
# the browser takes its page and ours for one. What gives it away is the name in Host.
@pytest.mark.parametrize(
    "host",
    [
        *("evil.example", "evil.example:8377", "127.0.0.1.evil.example", "0.0.0.0:8377", "", "["),
        # Our own names with more around them, and with another port or none.
        *("evil.example@127.0.0.1", "evil.example@127.0.0.1:8377", "127.0.0.1:8377@evil.example"),
        *("127.0.0.1:8377/evil.example", "127.0.0.1:8377#", "127.0.0.1:8377?", "127.0.0.1:83770"),
        *("127.0.0.1", "localhost", "127.0.0.1:80", "localhost:", "127.0.0.1 :8377", "127.1:8377"),
        *("2130706433:8377", "::1", "[::1", "[::1]:8377]", "localhost.:8377", "LOCALHOST:8377"),
    ],
)
def test_a_foreign_host_is_refused(client: TestClient, host: str) -> None:
    answer = client.get("/api/version", headers={"host": host})
    assert answer.status_code == 403
    assert "answers to 127.0.0.1:8377 or" in answer.json()["problems"][0]["message"]


@pytest.mark.parametrize("host", ["127.0.0.1:8377", "localhost:8377", "[::1]:8377"])
def test_this_machine_by_its_own_names_is_answered(client: TestClient, host: str) -> None:
    assert client.get("/api/version", headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "https://evil.example"},
        {"origin": "null"},  # a page of a file, or one in a sandbox
        {"origin": "http://127.0.0.1:9999"},  # another server on this machine
        {"origin": "http://localhost:8377"},  # not the name that was asked for
        {"origin": "https://127.0.0.1:8377"},
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
    ],
)
def test_what_another_page_asks_is_refused(client: TestClient, headers: dict[str, str]) -> None:
    asked = {"json": {"yaml": CASE}, "headers": headers}
    assert client.post("/api/check", **asked).status_code == 403
    assert client.get("/api/version", headers=headers).status_code == 403
    assert client.delete("/api/files/rough-patch.npz", headers=headers).status_code == 403


def test_what_the_page_itself_asks_is_answered(client: TestClient) -> None:
    ours = {"origin": HOST, "sec-fetch-site": "same-origin"}
    assert client.post("/api/case", json={"yaml": CASE}, headers=ours).status_code == 200


def test_a_link_from_elsewhere_may_lead_to_the_page_but_to_nothing_else(client: TestClient) -> None:
    clicked = {"sec-fetch-site": "cross-site", "sec-fetch-mode": "navigate"}
    assert client.get("/", headers=clicked).status_code != 403
    assert client.get("/api/runs", headers=clicked).status_code == 403


def test_what_is_too_large_is_refused_before_it_is_read(client: TestClient) -> None:
    answer = client.post("/api/check", content=b"", headers={"content-length": "3000001"})
    assert answer.status_code == 413
    assert "at most 3 MB" in answer.json()["problems"][0]["message"]
    answer = client.post(
        "/api/files?name=a.csv", content=b"", headers={"content-length": "64000001"}
    )
    assert answer.status_code == 413


def test_a_body_of_unknown_size_is_refused(client: TestClient) -> None:
    answer = client.post("/api/check", content=iter([b"{", b"}"]))
    assert answer.status_code == 411
    # RFC 9112, section 6.3: Transfer-Encoding overrides Content-Length.
    both = {"content-length": "2", "transfer-encoding": "chunked"}
    assert client.post("/api/check", content=b"{}", headers=both).status_code == 411
    huge = {"content-length": "9" * 5000}  # more digits than Python makes a number of
    assert client.post("/api/check", content=b"{}", headers=huge).status_code == 413


@pytest.fixture
def fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Response:
    """What is answered where our own code is at fault."""

    def broken() -> None:
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(case_routes, "case_schema", broken)
    with asking(tmp_path) as client:
        patient = TestClient(client.app, base_url=HOST, raise_server_exceptions=False)
        return patient.get("/api/schema")


def test_an_internal_error_is_reported_as_such(fault: Response) -> None:
    assert fault.status_code == 500
    assert "please report it" in fault.json()["problems"][0]["message"]


def test_every_answer_forbids_requests_to_elsewhere(client: TestClient, fault: Response) -> None:
    refused = client.get("/api/version", headers={"host": "evil.example"})
    for answer in (client.get("/api/version"), client.get("/api/nothing"), refused, fault):
        policy = dict(part.split(" ", 1) for part in _policy(answer.headers))
        assert policy["default-src"] == "'none'"
        sources = " ".join(policy[name] for name in policy if name.endswith("-src"))
        assert set(sources.split()) <= {"'none'", "'self'", "'unsafe-inline'", "data:", "blob:"}
        assert "'unsafe-inline'" not in policy["script-src"]
        assert policy["frame-ancestors"] == "'none'"
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["cross-origin-resource-policy"] == "same-origin"


def test_a_drawing_that_is_opened_by_itself_has_its_styles_and_neither_scripts_nor_requests(
    client: TestClient,
) -> None:
    answer = client.get("/static/icon.svg")
    assert answer.headers["content-type"].startswith("image/svg+xml")
    # What is not named falls back to default-src (Content Security Policy Level 3, 6.8.4).
    assert set(_policy(answer.headers)) == {"default-src 'none'", "style-src 'unsafe-inline'"}


def _policy(headers: dict[str, str]) -> list[str]:
    return [part.strip() for part in headers["content-security-policy"].split(";")]


def test_errors_have_one_form_whatever_they_are(client: TestClient) -> None:
    asked = (
        client.get("/api/runs/none"),
        client.get("/nothing"),
        client.get("/static/../app.py"),
        client.get("/static/%2e%2e%2fapp.py"),
        client.put("/api/check"),
        client.post("/api/check", json={"yamll": ""}),
        client.post("/api/check", content=b"{", headers={"content-type": "application/json"}),
    )
    assert [answer.status_code for answer in asked] == [404, 404, 404, 404, 405, 400, 400]
    for answer in asked:
        (problem,) = answer.json()["problems"]
        assert problem.keys() == {"message", "path", "line"}


# Names that systems refuse or take for something else: Windows as it documents them, and 255 bytes
# that a name may have on most file systems.
BY_SYSTEM = ("NUL", "con.csv", "Com1 .csv", "case.yaml.", "a.csv ", "é" * 130 + ".csv")


def test_files_with_names_that_lead_elsewhere_are_refused(
    client: TestClient, tmp_path: Path
) -> None:
    for name in (
        "../a.csv",
        "/etc/a.csv",
        "a/b.csv",
        ".a",
        "C:a.csv",
        "case.yaml",
        "",
        "a\n.csv",
        *BY_SYSTEM,
    ):
        answer = client.post("/api/files", params={"name": name}, content=b"1")
        assert answer.status_code == 400, name
    assert client.delete("/api/files/..%2f..%2frequest.json").status_code == 404
