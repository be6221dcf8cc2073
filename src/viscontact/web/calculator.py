"""Calculator behind the page: case reader, run queue, and one thread for heavy tasks."""

from __future__ import annotations

import asyncio
import json
import time as clock
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from functools import partial
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Concatenate, ParamSpec, TypeAlias, TypeVar
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
from viscontact.web.cases.case_process import CaseProcess
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.lane import Lane
from viscontact.web.runs.queue import RunQueue
from viscontact.web.runs.run import ManagedRun
from viscontact.web.runs.run_figures import look_of, run_figures
from viscontact.web.runs.status import result_summary, status_of
from viscontact.web.runs.study import StudyRun, study_status
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.problems import RequestError

P = ParamSpec("P")
T = TypeVar("T")
_Summary: TypeAlias = "asyncio.Future[dict[str, Any] | None]"

#: Time between two checks of the runs, the same while none is active, and between two events [s].
POLL_INTERVAL, IDLE_INTERVAL, EVENT_INTERVAL = 0.03, 0.1, 0.2
#: Time from the start of the server to its first use of what an answer needs [s].
_FIRST_USE = 1.0
#: Number of events without a change after which a line is sent, to keep the connection open.
_QUIET = 75
#: Time in which active runs finish their steps when the server ends; then they are killed [s].
SAVING_TIME = 2.5


class Calculator:
    """State of the server that all requests share."""

    def __init__(self, folder: Folder, at_once: int, *, keeps_spare: bool = False) -> None:
        self.folder, self.cases = folder, CaseReader(folder)
        self.queue = RunQueue(folder, at_once, keeps_spare=keeps_spare)
        self.is_to_end, self._is_awaited = False, keeps_spare
        self._end_at: float | None = None
        self._results = Lane()
        # A process of its own for cases: they are computed with, and libraries of many formats read
        # their files. Without it, they are read in the thread for results, as HDF5 is not
        # thread-safe.
        self._process = CaseProcess(folder) if keeps_spare else None
        self._about_cases = Lane() if keeps_spare else self._results
        # Summaries of results as tasks; an entry is dropped with its run.
        self._summaries: WeakKeyDictionary[ManagedRun, tuple[str, _Summary]] = WeakKeyDictionary()

    async def do(self, task: Callable[[], T], request: Request | None = None) -> T:
        """Call a heavy task about results in the only thread for these."""
        return await self._results.do(task, request)

    async def about_case(
        self,
        request: Request | None,
        task: Callable[Concatenate[CaseReader, P], T],
        *arguments: P.args,
        **named: P.kwargs,
    ) -> T:
        """Call a function of a module with the reader of cases, while the server answers others."""
        if self._process is None:
            whole = partial(task, self.cases, *arguments, **named)
        else:
            whole = partial(self._process.do, task, *arguments, **named)
        return await self._about_cases.do(whole, request)

    @property
    def is_busy(self) -> bool:
        """True while the thread for results does a task."""
        return self._results.is_busy

    async def close(self) -> None:
        """Let the active runs save, or end them after a time; wait for no task any more."""
        self._begin_end()
        while (self.queue.has_processes or self.is_busy) and not self._is_late():
            await asyncio.sleep(POLL_INTERVAL)
            self.queue.poll()
        self.queue.close()

    def _begin_end(self) -> None:
        self.queue.end()
        if self._end_at is None:
            self._end_at = clock.monotonic() + SAVING_TIME
            for lane in (self._results, self._about_cases):
                lane.end()
            if self._process is not None:
                self._process.close()

    def _is_late(self) -> bool:
        return self._end_at is not None and clock.monotonic() > self._end_at

    async def status(self, run: ManagedRun, patience: float | None = None) -> dict[str, Any]:
        """Return the status of a run; after `patience` [s] without the summary of its result."""
        if isinstance(run, StudyRun):
            return study_status(run)
        if not run.is_over:
            return status_of(run)
        key = f"{run.entry.state} {run.course.instants} {__version__}"
        if self._summaries.get(run, ("",))[0] != key:
            self._summaries[run] = key, asyncio.ensure_future(self._summary(run, key))
        reading = self._summaries[run][1]
        await asyncio.wait({reading}, timeout=patience)
        return status_of(run, reading.result() if reading.done() else None)

    async def _summary(self, run: ManagedRun, key: str) -> dict[str, Any] | None:
        """Summary of the result of a run that is over, read once; None if it was not read."""
        kept = self.folder.summary(run.name, key)
        if kept is not None:
            return kept
        try:
            found = await self.do(lambda: result_summary(run.directory))
        except (OSError, ValueError, KeyError):
            return {}
        except RequestError:  # the server ends, or has too much to do
            self._summaries.pop(run, None)
            return None
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
            if is_last or self._is_late():
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
                checking = self.about_case(None, CaseReader.check, _first_case(), "full")
                await asyncio.gather(self.do(_use_first), checking)

    async def poll_runs(self) -> None:
        """Start and check runs until cancelled."""
        while True:
            if self.is_to_end:
                self._begin_end()
            if self._is_late():
                self.queue.close()
            self.queue.poll()
            await asyncio.sleep(POLL_INTERVAL if self.queue.is_at_work else IDLE_INTERVAL)


def _first_case() -> str:
    return (files("viscontact.case.examples") / "sphere-zener.yaml").read_text(encoding="utf-8")


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
