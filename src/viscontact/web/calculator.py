"""What answers requests: cases at a desk, runs in a workshop, and one thread for heavy work."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request

from viscontact import __version__
from viscontact.web.cases.case_reader import Desk
from viscontact.web.runs.queue import Workshop
from viscontact.web.runs.run import Work
from viscontact.web.runs.status import found_by, status_of
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.problems import RequestError

T = TypeVar("T")

#: Time between two looks at the runs, and between two events of one [s].
LOOK, EVENT = 0.1, 0.2
#: After so many events without news a line is sent, lest somebody on the way gives up.
_QUIET = 75
#: Nobody reads an answer with this code: who asked is gone.
_GONE = 499


class Calculator:
    """All that the page's requests need."""

    def __init__(self, folder: Folder, at_once: int) -> None:
        self.folder, self.desk = folder, Desk(folder)
        self.workshop = Workshop(folder, at_once)
        self.is_to_end = False
        self._turn = asyncio.Lock()
        # Forgotten with the run.
        self._found: WeakKeyDictionary[Work, tuple[str, dict[str, Any]]] = WeakKeyDictionary()

    async def do(self, work: Callable[[], T], request: Request | None = None) -> T:
        """Do heavy work in a thread, one piece after the other: HDF5 knows no threads."""
        async with self._turn:
            if request is not None and await request.is_disconnected():
                raise RequestError(_GONE, "nobody waits for the answer")
            return await run_in_threadpool(work)

    async def status(self, work: Work) -> dict[str, Any]:
        """Return how a run stands, with what its result says once it is over."""
        if not work.is_over:
            return status_of(work, {})
        key = f"{work.asked.state} {work.course.instants} {__version__}"
        if self._found.get(work, ("",))[0] != key:
            self._found[work] = key, await self._found_by(work, key)
        return status_of(work, self._found[work][1])

    async def _found_by(self, work: Work, key: str) -> dict[str, Any]:
        """What the result of a run that is over says, read once."""
        kept = self.folder.found(work.name, key)
        if kept is not None:
            return kept
        try:
            found = await self.do(lambda: found_by(work.directory))
        except (OSError, ValueError, KeyError):
            return {}
        with suppress(OSError):  # a full disk
            self.folder.keep_found(work.name, key, found)
        return found

    async def events(self, work: Work) -> AsyncIterator[str]:
        """Yield how a run stands, at once and whenever that changes, until it is over."""
        before, quiet = "", 0
        while True:
            told = json.dumps(await self.status(work), allow_nan=False, ensure_ascii=False)
            quiet = 0 if told != before else quiet + 1
            if told != before:
                yield f"data: {told}\n\n"
            elif quiet % _QUIET == 0:
                yield ": still there\n\n"
            if work.is_over:
                return
            before = told
            await asyncio.sleep(EVENT)

    async def look_after_runs(self) -> None:
        """Look after the runs for as long as this goes on."""
        while True:
            if self.is_to_end:
                self.workshop.end()
            self.workshop.look()
            await asyncio.sleep(LOOK)
