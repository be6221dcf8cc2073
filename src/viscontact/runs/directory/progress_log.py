"""Progress log: a line of JSON for each instant or speed of a run."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext, suppress
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any, Self

from viscontact.backend.arrays import Floats
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.results.damage import DamagedFileError
from viscontact.results.line_digests import ROW, is_as_written, read_entries, with_digest
from viscontact.results.variables import AXES, error_name, parts_of, scalars_of, value_of
from viscontact.runs.directory.atomic_files import MAY_BE_HELD, flush_to_disk, fresh_name
from viscontact.runs.directory.checkpoint import REMEDY
from viscontact.runs.directory.lock_check import LockCheck, never_lost

#: Longest first line of a progress log [bytes].
LONGEST_LINE = 2**16


class ProgressLog(AbstractContextManager["ProgressLog"]):
    """A file with a line of JSON for each state, in SI units; `count` lines so far."""

    # A line is written at once: when the process is killed, only the last line may be incomplete. A
    # value that is not finite, such as the eccentricity without contact, is null; an infinite error
    # is "inf". Each line has its number, from 0, and a digest; those of earlier versions do not.

    def __init__(self, path: str | Path, check: LockCheck = never_lost) -> None:
        self.count = 0
        self._path, self._check = Path(path), check
        self._file = self._path.open("w+b", buffering=0)

    @classmethod
    def resume(
        cls, path: Path, lines: int, reached: float | None, check: LockCheck = never_lost
    ) -> Self:
        """Continue a log after some lines, the last of a given instant [s] or speed [m/s].

        ValueError if the lines are not all there, cannot be read, or are not of this run.
        """
        # Lines beyond these are cut off by the next `append` or `flush_to_disk`, so that the file
        # is unchanged if the run is refused for another reason.
        try:
            with path.open("rb") as file:
                found = [line for line in islice(file, lines) if line.endswith(b"\n")]
            reaches = [reached_in(each) for each in _read_lines(found)]
        except OSError as error:
            raise ValueError(f"{path} cannot be read ({error.strerror}); {REMEDY}") from error
        except (ValueError, LookupError, TypeError, OverflowError, RecursionError) as error:
            raise ValueError(
                f"{path} is damaged, or was written by something else; {REMEDY}"
            ) from error
        if len(found) < lines or (reaches[-1] if reaches else None) != reached:
            raise ValueError(f"{path} is not the course of this run so far; {REMEDY}")
        log = cls.__new__(cls)
        log.count, log._path, log._check = lines, path, check
        log._file = path.open("r+b", buffering=0)
        log._file.seek(sum(map(len, found)))
        return log

    def append(self, state: ContactState, part: float | None = None) -> None:
        """Write a state and the finished part of the run [-]; OSError and no line if not whole."""
        entries = _entries(state) | ({} if part is None else {"part": part})
        encoded = _encode(entries | {ROW: self.count})
        begin = self._file.tell()
        self._check()
        self._file.truncate(begin)
        if self._file.write(encoded) != len(encoded):
            self._file.truncate(begin)
            self._file.seek(begin)
            raise self._full_disk_error()
        self.count += 1

    def flush_to_disk(self) -> None:
        """Wait until all lines are on the disk; a file that has been removed is written again."""
        self._check()
        if not os.path.lexists(self._path):
            self._write_anew()
        self._file.truncate(self._file.tell())  # lines beyond the state that was resumed
        os.fsync(self._file.fileno())

    def finish(
        self,
        errors: Mapping[str, Floats] | None = None,
        fields: Mapping[str, Any] | None = None,
        ended: Mapping[str, Any] | None = None,
    ) -> None:
        """Add errors of scalars to all lines; to the last one `fields` and `ended`."""
        # The file is replaced at once and durably; one that a program holds on Windows is
        # unchanged.
        self.flush_to_disk()
        fresh = fresh_name(self._path)
        fresh.unlink(missing_ok=True)
        try:
            with self._path.open("rb") as lines, fresh.open("xb") as file:
                for row, read in enumerate(self._read_again(lines)):
                    entries = read | _errors(errors or {}, row)
                    if row == self.count - 1:
                        entries |= {"complete": True, "fields": fields and dict(fields)}
                        entries |= ended or {}
                    file.write(_encode({**entries, ROW: row}))
            flush_to_disk(fresh)
            self._check()
            self._replace(fresh)
        finally:
            fresh.unlink(missing_ok=True)

    def _read_again(self, lines: Iterable[bytes]) -> Iterator[dict[str, Any]]:
        try:
            for entries in _read_lines(lines):
                entries.pop(ROW, None)  # comes last
                yield entries
        except (ValueError, RecursionError) as error:
            raise DamagedFileError(self._path, "its lines") from error

    def _replace(self, fresh: Path) -> None:
        """Replace the file by a closed one, and continue with that."""
        end = self._file.tell()
        self._file.close()
        with suppress(PermissionError) if MAY_BE_HELD else nullcontext():
            fresh.replace(self._path)
            end = self._path.stat().st_size
        self._file = self._path.open("r+b", buffering=0)
        self._file.seek(end)

    def _write_anew(self) -> None:
        self._file.seek(0)
        content = self._file.readall()
        fresh = self._path.open("x+b", buffering=0)
        if fresh.write(content) != len(content):
            fresh.close()
            self._path.unlink()
            raise self._full_disk_error()
        self._file.close()
        self._file = fresh

    def _full_disk_error(self) -> OSError:
        return OSError(f"{self._path} could not be written whole; is the disk full?")

    def close(self) -> None:
        """Close the file; further calls do nothing."""
        self._file.close()

    def __exit__(self, *_: object) -> None:
        self.close()


def _read_lines(lines: Iterable[bytes]) -> Iterator[dict[str, Any]]:
    """Read lines; ValueError for one that is damaged, or without digest where earlier ones have."""
    is_checked = False
    for row, line in enumerate(lines):
        entries = read_entries(line, row)
        if is_checked and not is_as_written(line):
            raise ValueError("a line has no digest")
        is_checked = is_checked or is_as_written(line)
        yield entries


def is_course(path: Path) -> bool:
    """True if a file begins with a line of a `ProgressLog`."""
    try:
        with path.open("rb") as file:
            line = json.loads(file.readline(LONGEST_LINE))
    except (OSError, ValueError, RecursionError):
        return False
    return isinstance(line, dict) and "outcome" in line and any(over in line for over in AXES)


def reached_in(entries: Mapping[str, Any]) -> float:
    """Return the instant [s] or the speed [m/s] of a line; LookupError without either."""
    for over in AXES:
        if over in entries:
            return float(entries[over])
    raise LookupError("neither time nor speed")


def _entries(state: ContactState) -> dict[str, Any]:
    entries: dict[str, Any] = {state.over: float(getattr(state, state.over))}
    for name, whole in _scalars(parts_of(state), state.over):
        number = value_of(state, name)
        # JSON has no NaN.
        entries[name] = (int(number) if whole else number) if math.isfinite(number) else None
    outcome = Outcome(state.outcome).name.lower()
    return {**entries, "outcome": outcome, "warnings": list(state.warnings)}


@lru_cache(maxsize=8)
def _scalars(parts: frozenset[str], over: str) -> tuple[tuple[str, bool], ...]:
    """Names of the scalars of a line, and whether they are whole numbers."""
    return tuple(
        (name, each.kind.startswith("i")) for name, each in scalars_of(parts, over).items()
    )


def _errors(errors: Mapping[str, Floats], row: int) -> dict[str, float | str | None]:
    """Errors of the scalars at an instant."""
    # A line holds no values over the creepage.
    values = {error_name(name): float(each[row]) for name, each in errors.items() if each.ndim == 1}
    return {
        name: "inf" if math.isinf(value) else None if math.isnan(value) else value
        for name, value in values.items()
    }


def _encode(entries: Mapping[str, Any]) -> bytes:
    return with_digest(json.dumps(entries, allow_nan=False, ensure_ascii=False).encode()) + b"\n"
