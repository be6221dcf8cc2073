"""Reading of packed and binary files, whose content may need any memory and time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from viscontact.backend.reading_child import ReadingRequest
from viscontact.backend.reading_limits import End, reading_limits, reads_all_apart
from viscontact.backend.reading_process import UnansweredError, read_apart
from viscontact.backend.record import Record

#: First bytes of files whose content can be larger than they are: zip, gzip, HDF5, netCDF, MATLAB,
#: compressed Digital Surf, and old workbooks.
_EXPANDING = (
    *(b"PK", b"\x1f\x8b", b"\x89HDF", b"CDF", b"MATLAB", b"DSCOMPRESSED"),
    b"\xd0\xcf\x11\xe0",
)
#: Size from which a file of any kind is read in a process of its own [bytes].
_LARGE = 20_000_000


def read_packed(
    file: Path,
    read: Callable[..., Record],
    *arguments: Any,
    prepare: Callable[[], object] = tuple,
    remedy: str,
) -> Record:
    """Return `read(file, *arguments)`: from a process with limits, or from here if harmless.

    `read` and `prepare`, which imports what `read` needs, are functions of a module. A ValueError
    states the limit that is exceeded and the `remedy`, or what `read` refuses.
    """
    arguments = file.absolute(), *arguments  # the other process may be in another directory
    try:
        limits = reading_limits(file)
        if reads_all_apart() or can_expand(file):
            return read_apart(ReadingRequest(read, arguments, prepare, limits))
        return read(*arguments)
    except UnansweredError as error:
        raise ValueError(limits.message(file.name, error.end, remedy, error.how)) from None
    except MemoryError:
        raise ValueError(limits.message(file.name, End.MEMORY, remedy)) from None
    except OSError as error:
        raise ValueError(f"{file.name}: cannot be read: {error}") from error


def can_expand(file: Path) -> bool:
    """True for a large file, and for one that may be larger in memory than on disk."""
    with file.open("rb") as opened:
        start = opened.read(max(map(len, _EXPANDING)))
    return start.startswith(_EXPANDING) or file.stat().st_size > _LARGE
