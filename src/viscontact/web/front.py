"""Front of the server: it answers with the page before all else is imported."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from starlette.types import Receive, Scope, Send

from viscontact.web.pages import pages

if TYPE_CHECKING:
    from fastapi import FastAPI

#: Time after which all else is imported although no page has been asked for [s].
FIRST_PAGE = 1.0


class Front:
    """Page and its files at once; all else by an application that is made after the first page."""

    def __init__(self, make: Callable[[], FastAPI]) -> None:
        self._make, self._pages = make, pages()
        self._asked, self._over = asyncio.Event(), asyncio.Event()
        self._made: asyncio.Future[FastAPI] | None = None  # of the loop that serves
        self._is_to_end = False

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or begin and end with the server."""
        if scope["type"] == "lifespan":
            await self._live(receive, send)
        elif scope["path"] == "/" or scope["path"].startswith("/static/"):
            await self._pages(scope, receive, send)
            self._asked.set()
        else:
            self._asked.set()
            assert self._made is not None  # the server has begun
            await (await asyncio.shield(self._made))(scope, receive, send)

    def end(self) -> None:
        """Let the active runs save, and end; called in any thread."""
        self._is_to_end = True
        if self._made is not None and self._made.done() and not self._made.exception():
            self._made.result().state.calculator.is_to_end = True

    async def _live(self, receive: Receive, send: Send) -> None:
        await receive()
        self._made = asyncio.get_running_loop().create_future()
        serving = asyncio.create_task(self._serve(self._made))
        await send({"type": "lifespan.startup.complete"})
        await receive()
        self._over.set()
        with suppress(Exception):  # those who have asked were told
            await serving
        await send({"type": "lifespan.shutdown.complete"})

    async def _serve(self, made: asyncio.Future[FastAPI]) -> None:
        """Make the application, and live with it until the server ends."""
        with suppress(TimeoutError):
            await asyncio.wait_for(self._asked.wait(), FIRST_PAGE)
        try:
            application = await asyncio.to_thread(self._make)
            async with application.router.lifespan_context(application):
                made.set_result(application)
                if self._is_to_end:  # asked meanwhile
                    self.end()
                await self._over.wait()
        except BaseException as error:
            if not made.done():  # else those who ask would wait for ever
                made.set_exception(error)
            raise
