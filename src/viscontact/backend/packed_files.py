"""Reading of packed and binary files, whose content may need any memory and time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from viscontact.backend.reading_child import ReadingRequest
from viscontact.backend.reading_limits import reading_limits
from viscontact.backend.reading_process import UnansweredError, read_apart
from viscontact.backend.record import Record


def read_packed(
    file: Path,
    read: Callable[..., Record],
    *arguments: Any,
    prepare: Callable[[], object] = tuple,
    remedy: str,
) -> Record:
    """Return `read(file, *arguments)` from another process, with limits of memory and time.

    `read` and `prepare`, which imports what `read` needs, are functions of a module. A ValueError
    states the limit that is exceeded and the `remedy`, or what `read` refuses.
    """
    try:
        limits = reading_limits(file)
        # The other process may be in another directory.
        request = ReadingRequest(read, (file.absolute(), *arguments), prepare, limits)
        return read_apart(request)
    except UnansweredError as error:
        raise ValueError(limits.message(file.name, error.end, remedy, error.how)) from None
    except OSError as error:
        raise ValueError(f"{file.name}: cannot be read: {error}") from error
