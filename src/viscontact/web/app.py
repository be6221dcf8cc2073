"""Web application: all routes, behind the guard."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from importlib.resources import as_file, files
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, JSONResponse, Response
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp

from viscontact.case.data_file import is_plain_name
from viscontact.results.damage import DamagedFileError
from viscontact.web.access import Access
from viscontact.web.calculator import Calculator
from viscontact.web.guard import Guard
from viscontact.web.routes import case_routes, run_routes, study_routes
from viscontact.web.workspace.pictures import DAMAGED
from viscontact.web.workspace.problems import InputProblem, RequestError

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
#: Status of input that is refused; header of a page that expects problems of its input as an answer
#: like any other, and of such an answer.
_UNPROCESSABLE, _PROBLEMS = 422, "x-problems"
#: Script that reports use as well.
_LINKED = "linked.js"


def new_app(calculator: Calculator, token: str = "") -> ASGIApp:
    """Return the application of a calculator; with a token, it answers only who has that."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        tasks = [
            asyncio.create_task(each()) for each in (calculator.poll_runs, calculator.use_first)
        ]
        yield
        for task in tasks:
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task
        await calculator.close()

    # No documentation pages, as they would load scripts from other sites.
    app = FastAPI(lifespan=lifespan, docs_url=None, redoc_url=None, openapi_url=None)
    app.state.calculator = calculator
    app.add_exception_handler(RequestError, _answer_refusal)
    app.add_exception_handler(DamagedFileError, _answer_damage)
    app.add_exception_handler(ClientDisconnect, _answer_disconnected)
    app.add_exception_handler(RequestValidationError, _answer_invalid)
    app.add_exception_handler(HTTPException, _answer_unknown)
    app.add_exception_handler(Exception, _failed)
    app.include_router(case_routes.router)
    app.include_router(run_routes.router)
    app.include_router(study_routes.router)
    app.add_api_route("/", _page)
    app.add_api_route("/static/{name}", _static)
    # Outermost, as answers to errors are made outside of added middleware.
    return Guard(app, Access(token))


def _page() -> FileResponse:
    return _static("index.html")


def _static(name: str) -> FileResponse:
    folder = _FIGURES if name == _LINKED else _STATIC
    path, media_type = folder / name, _MEDIA_TYPES.get(Path(name).suffix)
    if name == _PLOTLY:
        with as_file(files("plotly") / "package_data" / _PLOTLY) as found:
            headers = {"cache-control": "max-age=86400"}
            return FileResponse(found, media_type="text/javascript", headers=headers)
    if not is_plain_name(name) or media_type is None or not path.is_file():
        raise RequestError(404, f"there is no file called {name[:40]!r}")
    return FileResponse(path, media_type=media_type, headers={"cache-control": "no-cache"})


def _answer_refusal(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestError)
    later = error.retry_after
    headers = {} if later is None else {"retry-after": str(later)}
    if error.status == _UNPROCESSABLE and request.headers.get(_PROBLEMS) == "expected":
        # A browser writes an error to its console for each answer of another status.
        return JSONResponse(error.body, headers={_PROBLEMS: str(error.status)})
    return JSONResponse(error.body, error.status, headers)


def _answer_disconnected(request: Request, error: Exception) -> Response:
    """End a request whose client has gone before it was whole."""
    return Response(status_code=400)


def _answer_damage(request: Request, error: Exception) -> JSONResponse:
    return JSONResponse(RequestError(409, DAMAGED).body, 409)


def _answer_invalid(request: Request, error: Exception) -> JSONResponse:
    """Answer a request whose parameters are not valid."""
    assert isinstance(error, RequestValidationError)
    found = [
        InputProblem(
            f"the request cannot be understood: {'.'.join(map(str, each['loc']))}: {each['msg']}"
        )
        for each in error.errors()
    ]
    return JSONResponse(RequestError(400, *found).body, 400)


def _answer_unknown(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    why = f"{request.method} {request.url.path}: {error.detail}"
    return JSONResponse(RequestError(error.status_code, why).body, error.status_code)


def _failed(request: Request, error: Exception) -> JSONResponse:
    why = (
        f"unexpected {type(error).__name__}: {error}. This is a fault of viscontact; please report "
        "it with the case"
    )
    return JSONResponse(RequestError(500, why).body, 500)
