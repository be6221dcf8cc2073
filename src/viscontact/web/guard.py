"""Access control: only pages of this server, on this machine, with limited request sizes."""

from __future__ import annotations

import json
from collections.abc import Iterable
from urllib.parse import urlsplit

from starlette.types import ASGIApp, Message, Receive, Scope, Send

#: Names of this machine. Another name in `Host` belongs to another site whose address was
#: redirected to this machine (DNS rebinding).
LOOPBACK = ("127.0.0.1", "localhost", "::1")

#: Largest size of a request [bytes]: a case as JSON, and a file of measurements.
MOST_JSON, MOST_FILE = 3_000_000, 64_000_000

#: Content policy of the page; figures and drawings contain styles of their own.
_PAGE_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; manifest-src 'self'; "
    "form-action 'none'; base-uri 'none'; frame-ancestors 'none'"
)
_DRAWING_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
#: Content policy of a report, a self-contained page; its scripts have no access to this server.
REPORT_POLICY = (
    "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data: blob:; font-src data:"
)
_HEADERS = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
    "cross-origin-opener-policy": "same-origin",
    "x-frame-options": "DENY",
    "cache-control": "no-store",
}


class Guard:
    """Middleware that refuses foreign or too large requests and adds security headers."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = {
            name.decode("latin-1"): value.decode("latin-1") for name, value in scope["headers"]
        }
        if refusal := _refusal(scope["method"], scope["path"], headers):
            await _refuse(_marking(send), *refusal)
        else:
            await self._app(scope, receive, _marking(send))


def _refusal(method: str, path: str, headers: dict[str, str]) -> tuple[int, str] | None:
    """Status code and reason for refusing a request; None if it is allowed."""
    host = headers.get("host", "")
    if _name(f"//{host}") not in LOOPBACK:
        return 403, f"this server answers to {', '.join(LOOPBACK)} only, and was called {host!r}"
    origin = headers.get("origin")
    if origin is not None and origin != f"http://{host}":
        return 403, f"a page of {origin} may not use this server"
    # A link to this page that the user clicked is no request of another page.
    is_visit = method == "GET" and headers.get("sec-fetch-mode") == "navigate" and path == "/"
    if headers.get("sec-fetch-site", "none") not in ("none", "same-origin") and not is_visit:
        return 403, "another page may not use this server"
    if "transfer-encoding" in headers:  # it overrides Content-Length
        return 411, "send a Content-Length instead of a chunked body"
    size, most = (
        headers.get("content-length", "0"),
        MOST_FILE if path == "/api/files" else MOST_JSON,
    )
    if not size.isdecimal() or len(size) > 20 or int(size) > most:
        return 413, f"the request is too large: at most {most // 1_000_000} MB can be sent"
    return None


def _name(address: str) -> str | None:
    try:
        return urlsplit(address).hostname
    except ValueError:
        return None


async def _refuse(send: Send, status: int, why: str) -> None:
    body = json.dumps({"problems": [{"message": why, "path": "", "line": None}]}).encode()
    headers = [(b"content-type", b"application/json"), (b"content-length", b"%d" % len(body))]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})


def _marking(send: Send) -> Send:
    """Add the security headers to answers."""

    async def marked(message: Message) -> None:
        if message["type"] == "http.response.start":
            given: list[tuple[bytes, bytes]] = list(message["headers"])
            names = {name.lower() for name, _ in given}
            own = {**_HEADERS, "content-security-policy": _policy(given)}
            missing = ((k.encode(), v.encode()) for k, v in own.items() if k.encode() not in names)
            message = {**message, "headers": [*given, *missing]}
        await send(message)

    return marked


def _policy(headers: Iterable[tuple[bytes, bytes]]) -> str:
    kinds = [value for name, value in headers if name.lower() == b"content-type"]
    is_drawing = any(kind.startswith(b"image/svg") for kind in kinds)
    return _DRAWING_POLICY if is_drawing else _PAGE_POLICY
