"""Heavy tasks of the server, one after the other in a thread of their own."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any, TypeVar

from starlette.requests import Request

from viscontact.web.workspace.problems import RequestError

T = TypeVar("T")

#: Largest number of tasks that wait.
_MOST_WAITING = 50
#: Status code for a client that has closed the connection.
_GONE = 499
#: Time after which a refused task may be tried again [s].
_LATER = 5


class Lane:
    """Thread for heavy tasks, one after the other."""

    def __init__(self) -> None:
        self._turn, self._thread = asyncio.Lock(), ThreadPoolExecutor(1)
        self._end = asyncio.Event()
        self._waiting = 0
        self.is_busy = False

    async def do(self, task: Callable[[], T], request: Request | None = None) -> T:
        """Do a task in its turn, unless the client of its request has gone by then."""
        with self._place():
            async with self._turn:
                if request is not None and await request.is_disconnected():
                    raise RequestError(_GONE, "the client has closed the connection")
                return await self._done(task)

    def end(self) -> None:
        """Wait for no task any more; one that is being done is left to itself."""
        self._end.set()

    async def _done(self, task: Callable[[], T]) -> T:
        if self._end.is_set():
            raise _ending()
        self.is_busy = True
        done = asyncio.get_running_loop().run_in_executor(self._thread, task)
        done.add_done_callback(self._note_end)
        over = asyncio.ensure_future(self._end.wait())
        try:
            awaited: set[asyncio.Future[Any]] = {done, over}
            await asyncio.wait(awaited, return_when=asyncio.FIRST_COMPLETED)
        finally:
            over.cancel()
        if not done.done():
            raise _ending()
        return done.result()

    def _note_end(self, done: asyncio.Future[T]) -> None:
        self.is_busy = False
        if not done.cancelled():
            # Python reports an exception that no one has read when the task is deleted.
            done.exception()

    @contextmanager
    def _place(self) -> Iterator[None]:
        if self._waiting > _MOST_WAITING:
            why = f"{_MOST_WAITING} requests are waiting for the server; try it again later"
            raise RequestError(429, why, retry_after=_LATER)
        self._waiting += 1
        try:
            yield
        finally:
            self._waiting -= 1


def _ending() -> RequestError:
    return RequestError(503, "the server is about to end")
