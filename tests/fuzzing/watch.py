"""Calls under watch: what they print, how they end, how long they take, how much they take."""

from __future__ import annotations

import contextlib
import faulthandler
import io
import os
import signal
import sys
import time as clock
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from viscontact.cli import main

#: No input may keep a command computing longer than this [s]; most take a fiftieth of a second.
LONGEST = 10.0

#: What an in-process input may take besides what the process has [bytes]: `ROOM` is the
#: free memory given to the command, and the rest is for buffers of a file that is read.
ROOM, SPARE = 4e8, 1.2e9

_FAULT = "This is a fault of viscontact"


class Hang(BaseException):
    """A call that went on beyond `LONGEST`; no `except Exception` holds it up."""


@dataclass(frozen=True)
class Ending:
    """How a command ended."""

    code: int
    out: str
    err: str
    seconds: float


@dataclass
class Tally:
    """The figures of a campaign."""

    endings: Counter[str] = field(default_factory=Counter)
    slowest: float = 0.0
    longest: int = 0

    def add(self, ending: str, seconds: float, length: int) -> None:
        """Count an input."""
        self.endings[ending] += 1
        self.slowest = max(self.slowest, seconds)
        self.longest = max(self.longest, length)

    def line(self, family: str) -> str:
        """Write the figures as a line."""
        tried = sum(self.endings.values())
        each = ", ".join(f"{count} {ending}" for ending, count in sorted(self.endings.items()))
        return (
            f"bad input, {family}: {tried} tried: {each}; 0 crashes, 0 hangs; longest input "
            f"{self.longest} characters, slowest {self.slowest:.1f} s"
        )


@contextlib.contextmanager
def watched(seconds: float = LONGEST) -> Iterator[None]:
    """Raise `Hang` in what computes longer, or waits much longer; end the process if need be.

    The time of the processor is what counts, so that a busy machine does no harm.
    """
    waiting = 6 * seconds
    faulthandler.dump_traceback_later(2 * waiting, exit=True, file=sys.__stderr__)
    if not hasattr(signal, "setitimer"):  # Windows: the process is ended, that is all
        yield
        faulthandler.cancel_dump_traceback_later()
        return

    def ring(*_: object) -> None:
        raise Hang(f"computed more than {seconds:g} s, or waited more than {waiting:g} s")

    clocks = (
        (signal.ITIMER_PROF, signal.SIGPROF, seconds),
        (signal.ITIMER_REAL, signal.SIGALRM, waiting),
    )
    before = [signal.signal(bell, ring) for _, bell, _ in clocks]
    for timer, _, after in clocks:
        signal.setitimer(timer, after)
    try:
        yield
    finally:
        for (timer, bell, _), handler in zip(clocks, before, strict=True):
            signal.setitimer(timer, 0)
            signal.signal(bell, handler)
        faulthandler.cancel_dump_traceback_later()


@contextlib.contextmanager
def bounded_memory(extra: float = ROOM + SPARE) -> Iterator[None]:
    """Let the process take no more address space than it has and so many bytes (Linux only)."""
    if not sys.platform.startswith("linux"):
        yield
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text().split()[0])
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    limit = pages * os.sysconf("SC_PAGE_SIZE") + int(extra)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def command(arguments: Sequence[str]) -> Ending:
    """Run a command of viscontact in this process and check how it ends."""
    out, err = io.StringIO(), io.StringIO()
    started = clock.perf_counter()
    with (
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
        watched(),
        bounded_memory(),
    ):
        code = main(arguments)
    ending = Ending(code, out.getvalue(), err.getvalue(), clock.perf_counter() - started)
    check(ending)
    return ending


def check(ending: Ending) -> None:
    """Check what must hold of every command, whatever its input."""
    said = ending.out + ending.err
    assert _FAULT not in said, said
    assert "Traceback" not in said, said
    assert ending.code in (0, 1, 2), said
    if ending.code:
        assert ending.err.strip(), "refused without a word"


def refused_or(done: str, ending: Ending) -> str:
    """Say how a command ended: in words for the tally."""
    return {0: done, 1: "stopped", 2: "refused"}[ending.code]


def contents(folder: Path) -> dict[str, int]:
    """Return all that lies in a folder, by name, with its time of change."""
    found: dict[str, int] = {}
    for entry in os.scandir(folder):
        found[entry.name] = entry.stat(follow_symlinks=False).st_mtime_ns
    return found


def refuses(call: Callable[[], Any]) -> str:
    """Make a call that must end in time and raise nothing but a worded refusal, if anything."""
    import viscontact as vc

    try:
        with watched(), bounded_memory():
            call()
    except (vc.ConvergenceError, vc.DomainError):
        return "stopped"
    except (ValueError, TypeError) as error:
        said = str(error)
    else:
        return "accepted"
    assert said, "refused without a word"
    return "refused"


def set_free_memory(monkeypatch: pytest.MonkeyPatch, room: float = ROOM) -> None:
    """Let commands believe that so much memory is free, on every machine the same."""
    import viscontact.runs.preparation

    monkeypatch.setattr(viscontact.runs.preparation, "available_memory", lambda: room)
