"""The page and its static files, and the answers to requests that fail."""

from __future__ import annotations

from importlib.resources import as_file, files
from pathlib import Path

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse
from starlette.routing import Route

from viscontact.case.plain_names import is_plain_name
from viscontact.web.workspace.problems import RequestError

_STATIC = Path(__file__).parent / "static"
_FIGURES = Path(__file__).parents[1] / "drawing" / "plotly"

#: Media types of static files; operating systems differ in their own tables.
_MEDIA_TYPES = {
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".ico": "image/vnd.microsoft.icon",
    ".woff2": "font/woff2",
    ".json": "application/json",
    ".webmanifest": "application/manifest+json",
}
_PLOTLY = "plotly.min.js"
#: Script that reports use as well.
_LINKED = "linked.js"

#: Status of input that is refused; header of a page that expects problems of its input as an answer
#: like any other, and of such an answer.
_UNPROCESSABLE, _PROBLEMS = 422, "x-problems"


def pages() -> Starlette:
    """Return the application of the page and its static files alone."""
    return Starlette(
        routes=[
            Route("/", lambda request: page()),
            Route("/static/{name}", lambda request: static(request.path_params["name"])),
        ],
        exception_handlers={
            RequestError: answer_refusal,
            HTTPException: answer_unknown,
            Exception: failed,
        },
    )


def page() -> FileResponse:
    """Return the page."""
    return static("index.html")


def static(name: str) -> FileResponse:
    """Return a static file."""
    folder = _FIGURES if name == _LINKED else _STATIC
    path, media_type = folder / name, _MEDIA_TYPES.get(Path(name).suffix)
    if name == _PLOTLY:
        with as_file(files("plotly") / "package_data" / _PLOTLY) as found:
            headers = {"cache-control": "max-age=86400"}
            return FileResponse(found, media_type="text/javascript", headers=headers)
    if not is_plain_name(name) or media_type is None or not path.is_file():
        raise RequestError(404, f"there is no file called {name[:40]!r}")
    return FileResponse(path, media_type=media_type, headers={"cache-control": "no-cache"})


def answer_refusal(request: Request, error: Exception) -> JSONResponse:
    """Answer a request that is refused."""
    assert isinstance(error, RequestError)
    later = error.retry_after
    headers = {} if later is None else {"retry-after": str(later)}
    if error.status == _UNPROCESSABLE and request.headers.get(_PROBLEMS) == "expected":
        # A browser writes an error to its console for each answer of another status.
        return JSONResponse(error.body, headers={_PROBLEMS: str(error.status)})
    return JSONResponse(error.body, error.status, headers)


def answer_unknown(request: Request, error: Exception) -> JSONResponse:
    """Answer a request of an unknown address or method."""
    assert isinstance(error, HTTPException)
    why = f"{request.method} {request.url.path}: {error.detail}"
    return JSONResponse(RequestError(error.status_code, why).body, error.status_code)


def failed(request: Request, error: Exception) -> JSONResponse:
    """Answer a request that has met a fault."""
    why = (
        f"unexpected {type(error).__name__}: {error}. This is a fault of viscontact; please report "
        "it with the case"
    )
    return JSONResponse(RequestError(500, why).body, 500)
