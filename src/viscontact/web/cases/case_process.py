"""Process that reads, checks and draws cases, so that the server answers meanwhile."""

from __future__ import annotations

import multiprocessing
import pickle
import signal
import traceback
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from typing import Any, Concatenate, ParamSpec, TypeVar

from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.problems import RequestError

P = ParamSpec("P")
T = TypeVar("T")


class CaseProcess:
    """Process with a reader of cases; it is started when it is needed, also after it has ended."""

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._process: SpawnProcess | None = None
        self._pipe: Connection | None = None
        self._is_closed = False

    def do(
        self,
        task: Callable[Concatenate[CaseReader, P], T],
        *arguments: P.args,
        **named: P.kwargs,
    ) -> T:
        """Return the result of a function of a module, called with the reader in the process."""
        pipe = self._pipe or self._start()
        try:
            pipe.send((task, arguments, named))
            found, error = pipe.recv()
        except (EOFError, OSError) as ended:
            self._forget()
            raise RequestError(
                500,
                "the process that reads cases has ended unexpectedly, perhaps for lack of memory; "
                "the next request starts another one",
            ) from ended
        if error is not None:
            raise error
        return found  # type: ignore[no-any-return]

    def close(self) -> None:
        """End the process at once."""
        self._is_closed = True
        if self._process is not None:
            self._process.kill()

    def _start(self) -> Connection:
        if self._is_closed:
            raise RequestError(503, "the server is about to end")
        # A new interpreter: one that is forked from a process with threads may hang.
        context = multiprocessing.get_context("spawn")
        own, other = context.Pipe()
        process = context.Process(target=_serve, args=(other, self._folder))
        process.start()
        other.close()  # so that the end of either process is seen by the other one
        self._pipe, self._process = own, process
        if self._is_closed:  # meanwhile
            process.kill()
        return own

    def _forget(self) -> None:
        if self._pipe is not None and self._process is not None:
            self._pipe.close()
            self._process.kill()
            self._process.join()
        self._pipe = self._process = None


def _serve(pipe: Connection, folder: Folder) -> None:
    """Do tasks until the server ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server
    reader = CaseReader(folder)
    with suppress(EOFError, OSError):
        while True:
            task, arguments, named = pipe.recv()
            pipe.send(_outcome(partial(task, reader, *arguments, **named)))


def _outcome(task: Callable[[], Any]) -> tuple[Any, Exception | None]:
    """Return the result of a task, or its error."""
    try:
        return task(), None
    except RequestError as refused:
        return None, refused
    except Exception as error:
        # The traceback is lost on the way; with it goes what cannot be sent.
        error.add_note(traceback.format_exc())
        with suppress(Exception):
            pickle.loads(pickle.dumps(error))
            return None, error
        return None, RuntimeError(f"{type(error).__name__}: {error}\n{traceback.format_exc()}")
