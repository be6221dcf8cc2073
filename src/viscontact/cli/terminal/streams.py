"""Standard streams of the process, closed or failing ones included."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager


class _Output(io.TextIOWrapper):
    """Stream that keeps the first error of writing, buffered or not."""

    failure: OSError | None = None

    def write(self, text: str, /) -> int:
        try:
            return super().write(text)
        except OSError as error:
            self.failure = error
            raise

    def flush(self) -> None:
        try:
            super().flush()
        except OSError as error:
            self.failure = error
            raise


def occupy_streams() -> None:
    """Redirect closed standard streams to the null device, so that no file takes their numbers."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            opened = os.open(os.devnull, os.O_RDWR)
            if opened != number:
                os.dup2(opened, number)
                os.close(opened)
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            discard(name, mode)
    # A terminal that cannot write "mm²" gets "mm?", not an error.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def discard(name: str, mode: str = "w") -> None:
    """Redirect a stream of `sys` to the null device, until the process ends."""
    # A new number, as a file may have taken the old one.
    opened = os.open(os.devnull, os.O_RDONLY if mode == "r" else os.O_WRONLY)
    setattr(sys, name, os.fdopen(opened, mode, encoding="utf-8"))


def remember_output() -> None:
    """Replace stdout by a stream that keeps errors of writing."""
    old = sys.stdout
    if isinstance(old, io.TextIOWrapper):
        options = {
            name: getattr(old, name)
            for name in ("encoding", "errors", "line_buffering", "write_through")
        }
        sys.stdout = _Output(old.detach(), **options)


def unwritten(name: str) -> OSError | None:
    """Flush a stream; where that fails, discard its further output and return the error."""
    stream = getattr(sys, name)
    try:
        stream.flush()
        failure: OSError | None = getattr(stream, "failure", None)
    except OSError as error:
        failure = error
    if failure is not None:
        # Python would complain again when it flushes at the end.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
    if isinstance(stream, _Output):
        stream.failure = None  # reported once
    return failure


@contextmanager
def printing() -> Iterator[None]:
    """Raise OSError, at the end of the block at the latest, where output cannot be written."""
    try:
        yield
        sys.stdout.flush()
    except SystemExit as error:  # rich, when the reader of a pipe has closed it
        raise BrokenPipeError("the reader has closed the pipe") from error
