"""Log of a run on stderr, with the option --verbose."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from viscontact.cli.terminal.messages import say


class _LineHandler(logging.Handler):
    """Handler that prints each message as a line."""

    def emit(self, record: logging.LogRecord) -> None:
        say(record.getMessage())


@contextmanager
def logged(verbose: int) -> Iterator[None]:
    """Print the log within the block: grids and resumed runs, from 2 on also each step."""
    if not verbose:
        yield
        return
    log, lines = logging.getLogger("viscontact"), _LineHandler()
    before = log.level
    log.addHandler(lines)
    log.setLevel(logging.INFO if verbose == 1 else logging.DEBUG)
    try:
        yield
    finally:
        log.removeHandler(lines)
        log.setLevel(before)
