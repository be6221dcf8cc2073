"""The standard streams of the process: there, and written to, or given up."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager


class _Output(io.TextIOWrapper):
    """A stream that remembers that it could not be written, be it buffered or not."""

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
    """Let closed streams lead to nowhere, as under cron, and no file take their numbers."""
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
            lead_nowhere(name, mode)
    # A terminal that cannot write "mm²" gets "mm?", not an error.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def lead_nowhere(name: str, mode: str = "w") -> None:
    """Let a stream of `sys` lead to nowhere, as long as the process lasts."""
    # Not by its number, which a file may have taken before this.
    opened = os.open(os.devnull, os.O_RDONLY if mode == "r" else os.O_WRONLY)
    setattr(sys, name, os.fdopen(opened, mode, encoding="utf-8"))


def remember_output() -> None:
    """Let the stdout of this process remember whether it could be written."""
    old = sys.stdout
    if isinstance(old, io.TextIOWrapper):
        options = {
            name: getattr(old, name)
            for name in ("encoding", "errors", "line_buffering", "write_through")
        }
        sys.stdout = _Output(old.detach(), **options)


def unwritten(name: str) -> OSError | None:
    """Return why what was printed cannot be written, if so, and give the stream up."""
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
        stream.failure = None  # said once
    return failure


@contextmanager
def printing() -> Iterator[None]:
    """Within it, output that cannot be written is an OSError, at the end at the latest."""
    try:
        yield
        sys.stdout.flush()
    except SystemExit as error:  # what rich makes of a reader that is gone
        raise BrokenPipeError("nobody reads it") from error
