"""What the tests of the calculator page share: a case of a second, and who asks for it."""

from __future__ import annotations

import json
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
from fastapi.testclient import TestClient

from viscontact.web.app import new_app
from viscontact.web.calculator import Calculator
from viscontact.web.workspace.folder import Folder

HOST = "http://127.0.0.1:8377"
CASE = """\
title: Zener sphere
indenter: {shape: sphere, radius: 10 mm}
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
load:
  kind: step
  force: 4 N
time: {end: 5 s, steps: 4}
grid: {shape: [24, 24], size: [4 mm, 4 mm]}
output: {fields: [0 s, 5 s]}
"""
#: The same with so many steps that it lasts until it is stopped.
LONG_CASE = CASE.replace("steps: 4", "steps: 12000").replace("5 s]}", "5 s], errors: false}")


@contextmanager
def asking(
    folder: Path, at_once: int = 2, *, keeps_spare: bool = False, token: str = ""
) -> Iterator[TestClient]:
    """Ask a page that keeps its runs in a folder; without a token, it asks for none."""
    app = new_app(Calculator(Folder(folder), at_once, keeps_spare=keeps_spare), token)
    with TestClient(app, base_url=HOST) as client:
        yield client


def begun(client: httpx.Client, text: str = CASE, quality: str = "full") -> str:
    """Let a case be run, and return what the run is called."""
    answer = client.post("/api/runs", json={"yaml": text, "quality": quality})
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


def status(client: httpx.Client, run: str) -> dict[str, Any]:
    found: dict[str, Any] = client.get(f"/api/runs/{run}").json()
    return found


def followed(client: httpx.Client, run: str) -> list[dict[str, Any]]:
    """Return every event of a run until it is over."""
    with client.stream("GET", f"/api/runs/{run}/events") as answer:
        assert answer.headers["content-type"].startswith("text/event-stream")
        return [json.loads(line[5:]) for line in answer.iter_lines() if line.startswith("data:")]


def until(holds: Callable[[], bool], seconds: float = 60.0) -> None:
    give_up = clock.monotonic() + seconds
    while not holds():
        assert clock.monotonic() < give_up
        clock.sleep(0.02)


def as_printed(answer: httpx.Response) -> list[str]:
    """Return the problems of an answer as the command line prints them of a `case.yaml`."""
    return [
        " ".join(
            [
                f"case.yaml:{each['line']}:" if each["line"] else "case.yaml:",
                *([f"{each['path']}:"] if each["path"] else []),
                each["message"],
            ]
        )
        for each in answer.json()["problems"]
    ]
