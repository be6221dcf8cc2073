"""Web application: all routes, behind the guard."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, Response
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp

from viscontact.results.damage import DamagedFileError
from viscontact.web.access import Access
from viscontact.web.calculator import Calculator
from viscontact.web.guard import Guard
from viscontact.web.pages import answer_refusal, answer_unknown, failed, page, static
from viscontact.web.routes import case_routes, run_routes, study_routes
from viscontact.web.workspace.pictures import DAMAGED
from viscontact.web.workspace.problems import InputProblem, RequestError


def new_app(calculator: Calculator, token: str = "") -> ASGIApp:
    """Return the application of a calculator; with a token, it answers only who has that."""
    # Outermost, as answers to errors are made outside of added middleware.
    return Guard(unguarded(calculator), Access(token))


def unguarded(calculator: Calculator) -> FastAPI:
    """Return the application of a calculator, which answers whoever asks."""

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
    app.add_exception_handler(RequestError, answer_refusal)
    app.add_exception_handler(DamagedFileError, _answer_damage)
    app.add_exception_handler(ClientDisconnect, _answer_disconnected)
    app.add_exception_handler(RequestValidationError, _answer_invalid)
    app.add_exception_handler(HTTPException, answer_unknown)
    app.add_exception_handler(Exception, failed)
    app.include_router(case_routes.router)
    app.include_router(run_routes.router)
    app.include_router(study_routes.router)
    app.add_api_route("/", page)
    app.add_api_route("/static/{name}", static)
    return app


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
