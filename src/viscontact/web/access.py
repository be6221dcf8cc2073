"""Token of a server, which requests carry in a header or, once the page is open, in a cookie."""

from __future__ import annotations

import hmac
import re
import secrets
import webbrowser
from pathlib import Path
from xml.etree.ElementTree import Element

from starlette.requests import HTTPConnection

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.svg.html import element, written
from viscontact.web.workspace.privacy import is_private, write_private

#: Name of the file with the token in the folder of a server; without it, a new token is made.
TOKEN_NAME = "token"
#: Name of the page that leads a browser to the address with the token.
OPENING_NAME = "open.html"

_TOKEN = re.compile(r"[0-9a-f]{48}")
#: Token in the header Authorization.
_HEADER = re.compile(r"(?:token|bearer) +(\S+)", re.IGNORECASE)
#: Time for which a browser keeps the cookie [s].
_COOKIE_AGE = 30 * 24 * 3600


@dataclass(frozen=True)
class Access:
    """Check of the token of requests; an empty token admits every request."""

    token: str = ""

    def is_granted(self, connection: HTTPConnection) -> bool:
        """True if the request carries the token."""
        if not self.token or self.is_entry(connection):
            return True
        name, value = self._cookie(connection)
        given = _HEADER.fullmatch(connection.headers.get("authorization", ""))
        by_header = given is not None and _are_equal(given[1], self.token)
        return by_header or _are_equal(connection.cookies.get(name, ""), value)

    def is_entry(self, connection: HTTPConnection) -> bool:
        """True for the page with the token in its address, which gets the cookie."""
        path, given = connection.scope["path"], connection.query_params.get("token")
        return path == "/" and bool(self.token) and _are_equal(given or "", self.token)

    def cookie(self, connection: HTTPConnection) -> str:
        """Return the header that sets the cookie."""
        name, value = self._cookie(connection)
        return f"{name}={value}; Max-Age={_COOKIE_AGE}; Path=/; HttpOnly; SameSite=Strict"

    def _cookie(self, connection: HTTPConnection) -> tuple[str, str]:
        """Name and value of the cookie."""
        # Cookies do not distinguish ports: each server has a name of its own. The value does not
        # show the token.
        name = f"viscontact-{connection.scope['server'][1]}"
        return name, hmac.new(self.token.encode(), name.encode(), "sha256").hexdigest()


def kept_token(folder: Path) -> str:
    """Return the token of a folder, so that pages and bookmarks outlast the server."""
    path = folder / TOKEN_NAME
    if is_private(path):
        kept = path.read_text(encoding="utf-8", errors="replace").strip()
        if _TOKEN.fullmatch(kept):
            return kept
    token = secrets.token_hex(24)
    write_private(path, f"{token}\n")
    return token


def open_page(folder: Path, address: str) -> None:
    """Open an address in the browser."""
    # All users see the arguments of a process. A file that the owner alone can read leads to the
    # address.
    path = folder / OPENING_NAME
    lead = element("meta", http_equiv="refresh", content=f"0;url={address}")
    link = element("p", "Open ", element("a", "the calculator page", href=address), ".")
    write_private(path, _page("viscontact", lead, link))
    webbrowser.open(path.absolute().as_uri())


def refusal_page(why: str, *, lacks_token: bool) -> str:
    """Return a page for a visitor who is refused."""
    paragraphs = [element("p", why)]
    if lacks_token:
        paragraphs = [
            element("p", "This server answers only those who have its token."),
            element(
                "p",
                "If you started it, open the address that ",
                element("code", "viscontact serve"),
                " has printed in its terminal and that ends in ",
                element("code", "?token=…"),
                f" The token is also in the file {TOKEN_NAME} of its folder. After that, this "
                "browser is admitted without it for 30 days.",
            ),
            element("p", "If another user of this machine started it, start one of your own."),
        ]
    again = element("p", element("a", "Try again", href="/"))
    return _page("viscontact: refused", None, element("h1", "Refused"), *paragraphs, again)


def _page(title: str, lead: Element | None, *content: Element) -> str:
    style = "body { font: 1rem/1.5 sans-serif; max-width: 36rem; margin: 3rem auto }"
    head = element("head", element("meta", charset="utf-8"), element("title", title), lead)
    head.append(element("style", style))
    return "<!DOCTYPE html>" + written(element("html", head, element("body", *content), lang="en"))


def _are_equal(given: str, wanted: str) -> bool:
    """Compare in a time that does not depend on the first difference."""
    return hmac.compare_digest(given.encode(), wanted.encode())
