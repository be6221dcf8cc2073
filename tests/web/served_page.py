"""The calculator page in a real browser, watched: a server of its own, and what goes wrong."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit
from urllib.request import Request, urlopen

from viscontact.web.access import TOKEN_NAME

_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
BROWSER = next(filter(None, map(shutil.which, _BROWSERS)), None)


@dataclass
class Server:
    """`viscontact serve`, which may be stopped and started again at the same address."""

    folder: Path
    port: int = 0
    process: subprocess.Popen[str] | None = None

    @property
    def page(self) -> str:
        return f"http://127.0.0.1:{self.port}/"

    @property
    def token(self) -> str:
        return (self.folder / TOKEN_NAME).read_text(encoding="utf-8").strip()

    @property
    def address(self) -> str:
        """The address that it prints."""
        return f"{self.page}?token={self.token}"

    def ask(self, path: str) -> Any:
        """Answer to a request of a program."""
        asked = Request(f"{self.page}{path}", headers={"Authorization": f"token {self.token}"})
        with urlopen(asked) as answer:
            return json.load(answer)

    def start(self) -> None:
        command = [sys.executable, "-m", "viscontact", "serve", "--no-open"]
        command += ["--port", str(self.port), "--dir", str(self.folder)]
        self.process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
        )
        assert self.process.stdout
        line = self.process.stdout.readline()
        found = re.search(r"http://127\.0\.0\.1:(\d+)", line)
        assert found, line + self.process.stdout.read()
        self.port = int(found[1])

    def kill(self) -> None:
        """End it as a crash or a power cut does: without notice."""
        assert self.process
        self.process.kill()
        self.process.wait()
        assert self.process.stdout
        self.process.stdout.close()
        self.process = None

    def stop(self) -> None:
        if self.process is None:
            return
        self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        assert self.process.stdout
        self.process.stdout.close()
        self.process = None


@contextmanager
def served(folder: Path) -> Iterator[Server]:
    server = Server(folder)
    server.start()
    try:
        yield server
    finally:
        server.stop()


@contextmanager
def opened_browser() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    options = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=options)
        try:
            yield browser
        finally:
            browser.close()


@dataclass
class Watched:
    """What went wrong in a page, and what it asked from elsewhere."""

    host: str
    faults: list[str] = field(default_factory=list)
    outside: list[str] = field(default_factory=list)

    def watch(self, page: Any) -> None:
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        page.on("request", self._look)

    def _hear(self, message: Any) -> None:
        if message.type in ("error", "warning"):
            self.faults.append(message.text)

    def _look(self, request: Any) -> None:
        parts = urlsplit(request.url)
        if parts.scheme in ("http", "https", "ws") and parts.netloc != self.host:
            self.outside.append(request.url)


def new_page(browser: Any, server: Server, **options: Any) -> tuple[Any, Watched]:
    """A page of a visitor who has never been here, and what is seen of it."""
    context = browser.new_context(viewport={"width": 1280, "height": 900}, **options)
    page = context.new_page()
    page.set_default_timeout(20_000)
    watched = Watched(urlsplit(server.address).netloc)
    watched.watch(page)
    return page, watched


def visit(page: Any, server: Server, case: str = "") -> None:
    """Open the page, with a case that was written there before."""
    if case:
        kept = f"sessionStorage['viscontact.case'] ??= {json.dumps(case)}"
        page.add_init_script(kept)
    page.goto(server.address)
    until_ready(page)


def until_ready(page: Any) -> None:
    page.wait_for_selector("html[data-ready]", state="attached")


def write_case(page: Any, text: str) -> None:
    """Paste a case as YAML, and wait until it has been looked at."""
    page.click("#as-text")
    with page.expect_response("**/api/check"):
        page.fill("#yaml", text)
    page.click("#as-form")


def until_checked(page: Any) -> None:
    """Wait until the server has checked the present case."""
    page.wait_for_selector("#estimate[aria-busy=false]", state="attached")


def type_into(page: Any, path: str, text: str) -> None:
    """Write a value into the field of a key, as a person does, until the server has seen it."""
    page.fill(f'[id="field-{path}"]', text)
    until_checked(page)


def run(page: Any, button: str) -> str:
    """Press a button that computes; return the run once its results are drawn."""
    with page.expect_response(
        lambda answer: answer.request.method == "POST" and answer.url.endswith("/api/runs")
    ) as asked:
        page.click(button)
    name = str(asked.value.json()["id"])
    until_drawn(page, name)
    return name


def until_at_work(page: Any) -> None:
    """Wait until the first step of the run that is followed is done."""
    page.wait_for_function(
        "() => document.getElementById('progress-text').textContent.startsWith('step')",
        timeout=60_000,
    )


def until_drawn(page: Any, run: str) -> None:
    page.wait_for_selector(f'html[data-drawn="{run}"]', state="attached", timeout=90_000)


def fact(page: Any, label: str) -> str:
    """What the headline says of a quantity."""
    return str(page.locator(f'#facts div:has(dt:text-is("{label}")) dd').inner_text())
