"""Calculator behind the page: case reader, run queue, and one thread for heavy tasks."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

from starlette.requests import Request

from viscontact import __version__
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Sphere
from viscontact.bodies.laws import Zener
from viscontact.bodies.loads import step
from viscontact.bodies.materials.material import Material
from viscontact.report.run_data import run_data
from viscontact.results.netcdf import open_results, save
from viscontact.results.summary import summary_rows
from viscontact.runs.single import simulate
from viscontact.units.systems import AUTOMATIC
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.runs.queue import RunQueue
from viscontact.web.runs.run import ManagedRun
from viscontact.web.runs.run_figures import look_of, run_figures
from viscontact.web.runs.status import result_summary, status_of
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.problems import RequestError

T = TypeVar("T")

#: Time between two checks of the runs, the same while none is active, and between two events [s].
POLL_INTERVAL, IDLE_INTERVAL, EVENT_INTERVAL = 0.03, 0.1, 0.2
#: Time from the start of the server to its first use of what an answer needs [s].
_FIRST_USE = 1.0
#: Number of events without a change after which a line is sent, to keep the connection open.
_QUIET = 75
#: Status code for a client that has closed the connection.
_GONE = 499


class Calculator:
    """State of the server that all requests share."""

    def __init__(self, folder: Folder, at_once: int, *, keeps_spare: bool = False) -> None:
        self.folder, self.cases = folder, CaseReader(folder)
        self.queue = RunQueue(folder, at_once, keeps_spare=keeps_spare)
        self.is_to_end, self._is_awaited = False, keeps_spare
        self._turn, self._thread = asyncio.Lock(), ThreadPoolExecutor(1)
        # Summaries of results; an entry is dropped with its run.
        self._summaries: WeakKeyDictionary[ManagedRun, tuple[str, dict[str, Any]]] = (
            WeakKeyDictionary()
        )

    async def do(self, task: Callable[[], T], request: Request | None = None) -> T:
        """Call a heavy task in the only thread for these, as HDF5 is not thread-safe."""
        async with self._turn:
            if request is not None and await request.is_disconnected():
                raise RequestError(_GONE, "the client has closed the connection")
            return await asyncio.get_running_loop().run_in_executor(self._thread, task)

    async def status(self, run: ManagedRun) -> dict[str, Any]:
        """Return the status of a run, with a summary of its result once it is over."""
        if not run.is_over:
            return status_of(run, {})
        key = f"{run.entry.state} {run.course.instants} {__version__}"
        if self._summaries.get(run, ("",))[0] != key:
            self._summaries[run] = key, await self._summary(run, key)
        return status_of(run, self._summaries[run][1])

    async def _summary(self, run: ManagedRun, key: str) -> dict[str, Any]:
        """Summary of the result of a run that is over, read once."""
        kept = self.folder.summary(run.name, key)
        if kept is not None:
            return kept
        try:
            found = await self.do(lambda: result_summary(run.directory))
        except (OSError, ValueError, KeyError):
            return {}
        with suppress(OSError):  # a full disk
            self.folder.keep_summary(run.name, key, found)
        return found

    async def events(self, run: ManagedRun) -> AsyncIterator[str]:
        """Yield the status of a run as events, at once and at each change, until it is over."""
        before, quiet = "", 0
        while True:
            # Both may change while the status is sent.
            stage, is_last = run.stage, run.is_over
            status = json.dumps(await self.status(run), allow_nan=False, ensure_ascii=False)
            quiet = 0 if status != before else quiet + 1
            if status != before:
                yield f"data: {status}\n\n"
            elif quiet % _QUIET == 0:
                yield ": keep-alive\n\n"
            if is_last:
                return
            before = status
            # A new stage is sent at once: the values of a run are known, or it has ended.
            for _ in range(round(EVENT_INTERVAL / POLL_INTERVAL)):
                await asyncio.sleep(POLL_INTERVAL)
                if run.stage != stage:
                    break

    async def use_first(self) -> None:
        """Make the first answer as fast as later ones, where the next run has a process waiting."""
        await asyncio.sleep(_FIRST_USE)
        if self._is_awaited and not self.queue.is_at_work:
            with suppress(Exception):  # the answer itself will say what is wrong
                await self.do(_use_first)

    async def poll_runs(self) -> None:
        """Start and check runs until cancelled."""
        while True:
            if self.is_to_end:
                self.queue.end()
            self.queue.poll()
            await asyncio.sleep(POLL_INTERVAL if self.queue.is_at_work else IDLE_INTERVAL)


def _use_first() -> None:
    """Compute and draw a small contact, as the first use of the libraries takes a second."""
    material = Material(Zener(1e9, 1e9, 1e9), poisson_ratio=0.4)
    grid = Grid((48, 48), (0.6e-3, 0.6e-3))
    ds = simulate(Sphere(0.01), material, step(5.0), grid, [0.0, 0.05, 0.1], errors=False)
    with TemporaryDirectory() as folder:
        save(ds, Path(folder) / "run.nc")
        with open_results(Path(folder) / "run.nc") as read:
            run_data(read)
            summary_rows(read)
            run_figures(read, look_of(AUTOMATIC, dark=False))
