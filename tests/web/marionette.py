"""Firefox, driven by its own protocol Marionette: any installed Firefox, and no further program.

Messages are `LENGTH:JSON` over a socket of this machine: [0, number, command, parameters] to the
browser, and [1, number, error, result] back.
"""

from __future__ import annotations

import json
import shutil
import socket
import subprocess
import time as clock
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any

FIREFOX = next(filter(None, map(shutil.which, ("firefox", "firefox-esr"))), None)
#: Name of a reference to an element in the WebDriver standard.
_ELEMENT = "element-6066-11e4-a52e-4f735466cecf"


class RefusedError(Exception):
    """A command that Firefox refuses: its name, the kind of error and the message."""


class Firefox:
    """A browser with one page."""

    def __init__(self, connection: socket.socket) -> None:
        self._connection, self._number = connection, 0
        self._answer()  # the greeting
        self.tell("WebDriver:NewSession", capabilities={})

    def tell(self, command: str, **parameters: Any) -> Any:
        """Send a command, and return its result."""
        self._number += 1
        text = json.dumps([0, self._number, command, parameters]).encode()
        self._connection.sendall(b"%d:%s" % (len(text), text))
        _, number, error, result = self._answer()
        assert number == self._number
        if error is not None:
            raise RefusedError(command, error["error"], error["message"])
        return result

    def script(self, text: str, *arguments: Any) -> Any:
        """Run the body of a function in the page, and return its value."""
        return self.tell("WebDriver:ExecuteScript", script=text, args=list(arguments))["value"]

    def until(self, condition: str, seconds: float = 60.0) -> Any:
        """Wait until an expression is true in the page; return its value."""
        give_up = clock.monotonic() + seconds
        while not (found := self.script(f"return {condition}")):
            assert clock.monotonic() < give_up, condition
            clock.sleep(0.05)
        return found

    def click(self, selector: str) -> None:
        self._act("WebDriver:ElementClick", selector)

    def type(self, selector: str, text: str) -> None:
        """Replace what a field holds, key by key."""
        self._act("WebDriver:ElementClear", selector)
        self._act("WebDriver:ElementSendKeys", selector, text=text)

    def _act(self, command: str, selector: str, **parameters: Any) -> None:
        """Do something with an element, once it is in sight and drawn for good."""
        centred = "document.querySelector(arguments[0]).scrollIntoView({ block: 'center' })"
        give_up = clock.monotonic() + 20
        while True:
            try:
                self.script(centred, selector)
                self.tell(command, id=self._element(selector), **parameters)
                return
            except RefusedError as refused:
                passing = ("element not interactable", "stale element reference")
                if refused.args[1] not in passing or clock.monotonic() > give_up:
                    raise
                clock.sleep(0.1)

    def faults(self) -> list[str]:
        """Return the errors that scripts of pages from a server have raised."""
        self.tell("Marionette:SetContext", value="chrome")
        found = self.script(
            "return Services.console.getMessageArray()"
            ".filter((each) => each instanceof Ci.nsIScriptError && !(each.flags & 1)"
            " && each.sourceName.startsWith('http'))"
            ".map((each) => `${each.sourceName}:${each.lineNumber}: ${each.errorMessage}`)"
        )
        self.tell("Marionette:SetContext", value="content")
        return list(found)

    def _element(self, selector: str) -> str:
        found = self.tell("WebDriver:FindElement", using="css selector", value=selector)
        return str(found["value"][_ELEMENT])

    def _answer(self) -> Any:
        length = b""
        while not length.endswith(b":"):
            length += self._received(1)
        return json.loads(self._received(int(length[:-1])))

    def _received(self, count: int) -> bytes:
        found = b""
        while len(found) < count:
            part = self._connection.recv(count - len(found))
            assert part, "Firefox has closed the connection"
            found += part
        return found


@contextmanager
def opened_firefox(profile: Path) -> Iterator[Firefox]:
    """Start Firefox without a window, with a fresh profile."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    profile.mkdir()
    (profile / "user.js").write_text(f'user_pref("marionette.port", {port});\n', encoding="utf-8")
    process = subprocess.Popen(
        [
            *(str(FIREFOX), "--marionette", "--headless", "--no-remote"),
            *("--remote-allow-system-access", "--profile", str(profile)),  # for `faults`
        ],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        with closing(_connected(port)) as connection:
            firefox = Firefox(connection)
            yield firefox
            firefox.tell("Marionette:Quit")
        process.wait(20)
    finally:
        process.kill()
        process.wait()


def _connected(port: int, seconds: float = 60.0) -> socket.socket:
    give_up = clock.monotonic() + seconds
    while clock.monotonic() < give_up:
        with suppress(OSError):
            return socket.create_connection(("127.0.0.1", port), timeout=seconds)
        clock.sleep(0.1)
    raise TimeoutError("Firefox opens no port")
