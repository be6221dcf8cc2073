"""Access control: who has the token, on pages of this server, with limited request sizes."""

from __future__ import annotations

import json
from collections.abc import Iterable

from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from viscontact.web.access import Access, refusal_page

#: Names of this machine. Another name in `Host` belongs to another site whose address was
#: redirected to this machine (DNS rebinding).
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")

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

    def __init__(self, app: ASGIApp, access: Access) -> None:
        self._app, self._access = app, access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        connection = HTTPConnection(scope)
        refusal = _foreign(connection) or self._without_token(connection) or _too_large(connection)
        if refusal:
            await _refuse(connection, _marking(send), *refusal)
            return
        cookie = self._access.cookie(connection) if self._access.is_entry(connection) else None
        await self._app(scope, receive, _marking(send, cookie))

    def _without_token(self, connection: HTTPConnection) -> tuple[int, str] | None:
        if self._access.is_granted(connection):
            return None
        return 401, (
            "this server asks for its token: open the address that viscontact serve has printed; "
            "a program sends the header 'Authorization: token ...'"
        )


def _foreign(connection: HTTPConnection) -> tuple[int, str] | None:
    """Status code and reason for refusing a request of another site; None if it is none."""
    headers, path = connection.headers, connection.scope["path"]
    host, port = headers.get("host", ""), connection.scope["server"][1]
    known = [f"{name}:{port}" for name in LOOPBACK]
    if host not in known and not (port == 80 and host in LOOPBACK):  # which browsers leave out
        return 403, f"this server answers to {' or '.join(known)} only, and was called {host!r}"
    origin = headers.get("origin")
    if origin is not None and origin != f"http://{host}":
        return 403, f"a page of {origin} may not use this server"
    # A link to this page that the user clicked is no request of another page.
    is_visit = (
        connection.scope["method"] == "GET"
        and headers.get("sec-fetch-mode") == "navigate"
        and path == "/"
    )
    if headers.get("sec-fetch-site", "none") not in ("none", "same-origin") and not is_visit:
        return 403, "another page may not use this server"
    return None


def _too_large(connection: HTTPConnection) -> tuple[int, str] | None:
    """Status code and reason for refusing the size of a request; None if it is allowed."""
    headers = connection.headers
    if "transfer-encoding" in headers:  # it overrides Content-Length
        return 411, "send a Content-Length instead of a chunked body"
    size = headers.get("content-length", "0")
    most = MOST_FILE if connection.scope["path"] == "/api/files" else MOST_JSON
    if not size.isdecimal() or len(size) > 20 or int(size) > most:
        return 413, f"the request is too large: at most {most // 1_000_000} MB can be sent"
    return None


async def _refuse(connection: HTTPConnection, send: Send, status: int, why: str) -> None:
    if "text/html" in connection.headers.get("accept", ""):
        kind, body = b"text/html; charset=utf-8", refusal_page(why, lacks_token=status == 401)
    else:
        kind = b"application/json"
        body = json.dumps({"problems": [{"message": why, "path": "", "line": None}]})
    content = body.encode()
    headers = [(b"content-type", kind), (b"content-length", b"%d" % len(content))]
    if status == 401:
        headers.append((b"www-authenticate", b'Bearer realm="viscontact"'))
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": content})


def _marking(send: Send, cookie: str | None = None) -> Send:
    """Add the security headers to answers, and a cookie."""

    async def marked(message: Message) -> None:
        if message["type"] == "http.response.start":
            given: list[tuple[bytes, bytes]] = list(message["headers"])
            names = {name.lower() for name, _ in given}
            own = {**_HEADERS, "content-security-policy": _policy(given)}
            if cookie is not None:
                given.append((b"set-cookie", cookie.encode()))
            missing = ((k.encode(), v.encode()) for k, v in own.items() if k.encode() not in names)
            message = {**message, "headers": [*given, *missing]}
        await send(message)

    return marked


def _policy(headers: Iterable[tuple[bytes, bytes]]) -> str:
    kinds = [value for name, value in headers if name.lower() == b"content-type"]
    is_drawing = any(kind.startswith(b"image/svg") for kind in kinds)
    return _DRAWING_POLICY if is_drawing else _PAGE_POLICY
