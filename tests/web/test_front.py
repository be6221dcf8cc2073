"""Front of the server: it shows the page first, and makes what answers with cases after it."""

from __future__ import annotations

import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from viscontact.web import front
from viscontact.web.app import new_app, unguarded
from viscontact.web.calculator import Calculator
from viscontact.web.front import Front
from viscontact.web.workspace.folder import Folder
from web.calculator_page import HOST


def calculator(folder: Path) -> Calculator:
    return Calculator(Folder(folder), 1)


def test_the_page_is_shown_before_its_application_is_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(front, "FIRST_PAGE", 1e6)
    allowed, made = threading.Event(), threading.Event()

    def make() -> FastAPI:
        made.set()
        assert allowed.wait(60)
        return unguarded(calculator(tmp_path))

    with TestClient(Front(make), base_url=HOST) as client:
        assert not made.is_set()
        page = client.get("/")
        assert "<title>" in page.text
        assert client.get("/static/main.js").status_code == 200
        assert made.wait(60)
        allowed.set()
        assert client.get("/api/examples").status_code == 200


def test_front_answers_as_the_whole_application(tmp_path: Path) -> None:
    whole = new_app(calculator(tmp_path / "whole"))
    behind = Front(lambda: unguarded(calculator(tmp_path / "behind")))
    with TestClient(whole, base_url=HOST) as one, TestClient(behind, base_url=HOST) as other:
        for path in (
            "/",
            "/static/main.js",
            "/static/nothing.js",
            "/static/..%2Fapp.py",
            "/nowhere",
        ):
            first, second = one.get(path), other.get(path)
            assert (first.status_code, first.content) == (second.status_code, second.content), path
        assert one.post("/").json() == other.post("/").json()


def test_all_else_is_made_also_if_no_page_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(front, "FIRST_PAGE", 0.0)
    made = threading.Event()

    def make() -> FastAPI:
        made.set()
        return unguarded(calculator(tmp_path))

    with TestClient(Front(make), base_url=HOST):
        assert made.wait(60)


def test_a_server_that_ends_before_its_application_is_made_ends_that_too(tmp_path: Path) -> None:
    page: dict[str, Any] = {}

    def make() -> FastAPI:
        page["calculator"] = calculator(tmp_path)
        return unguarded(page["calculator"])

    shown = Front(make)
    with TestClient(shown, base_url=HOST) as client:
        shown.end()
        assert client.get("/api/examples").status_code == 200
        assert page["calculator"].is_to_end


def test_a_fault_while_the_application_begins_is_told_to_who_asks() -> None:
    @asynccontextmanager
    async def begin(application: FastAPI) -> AsyncIterator[None]:
        raise RuntimeError("no beginning")
        yield

    front_of_none = Front(lambda: FastAPI(lifespan=begin))
    with (
        TestClient(front_of_none, base_url=HOST) as client,
        pytest.raises(RuntimeError, match="no beginning"),
    ):
        client.get("/api/examples")


def test_a_fault_while_the_application_is_made_is_told_to_who_asks() -> None:
    def make() -> FastAPI:
        raise RuntimeError("no application")

    with TestClient(Front(make), base_url=HOST) as client:
        assert client.get("/").status_code == 200
        with pytest.raises(RuntimeError, match="no application"):
            client.get("/api/examples")
