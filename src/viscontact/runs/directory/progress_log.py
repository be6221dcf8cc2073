"""The course of a run as lines of text, to be followed while it goes on."""

from __future__ import annotations

import json
import math
import os
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, Self

from viscontact.results.variables import SCALARS
from viscontact.state import ContactState, Outcome

#: How much of a file is read at once [bytes].
BLOCK = 2**16


class ProgressLog(AbstractContextManager["ProgressLog"]):
    r"""A file with a line of JSON for each state.

    A line holds the instant, all scalars of the result in SI units by their names there, the
    outcome by its name, and the warnings met first at that instant. What is not a number, such as
    the eccentricity without contact, is null. Numbers read back are the same to the last bit. A
    line is written at once: when the process is killed, the last line may be cut short, no other.

    Parameters
    ----------
    path : path
        The file; what is there is replaced.

    Attributes
    ----------
    count : int
        Lines so far.

    Examples
    --------
    >>> import tempfile
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e7), 0.5)
    >>> grid = vc.Grid((32, 32), (3e-3, 3e-3))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "progress.jsonl"
    ...     with ProgressLog(path) as log:
    ...         for state in vc.march(vc.Sphere(0.01), rubber, vc.step(2.0), grid, [0.0]):
    ...             log.append(state)
    ...     line = json.loads(path.read_text(encoding="utf-8"))
    >>> round(line["force"], 3), line["outcome"], line["loss_per_cycle"], line["warnings"]
    (2.0, 'converged', None, [])
    """

    def __init__(self, path: str | Path) -> None:
        self.count = 0
        self._path = Path(path)
        self._file = self._path.open("w+b", buffering=0)

    @classmethod
    def resume(cls, path: str | Path, lines: int) -> Self:
        """Go on with a file from a line, cutting off what is behind it.

        Parameters
        ----------
        path : path
            The file.
        lines : int
            Lines to be kept.

        Returns
        -------
        ProgressLog
            The next state that is appended makes the next line.

        Raises
        ------
        ValueError
            If the file has fewer whole lines, or cannot be read; it is left as it is.
        """
        try:
            end, found = _end_of(Path(path), lines)
        except OSError as error:
            raise ValueError(f"{path} cannot be read, so the run cannot go on: {error}") from error
        if found < lines:
            raise ValueError(
                f"{path} has {found} whole lines, and the run had written {lines}; "
                "start it anew with --overwrite"
            )
        log = cls.__new__(cls)
        log.count, log._path = lines, Path(path)
        log._file = log._path.open("r+b", buffering=0)
        log._file.truncate(end)
        log._file.seek(end)
        return log

    def append(self, state: ContactState) -> None:
        """Write the line of a state.

        Parameters
        ----------
        state : ContactState
            The next state of the run; its fields are not needed.

        Raises
        ------
        OSError
            If it cannot be written whole; the lines before it stay.
        """
        line = json.dumps(_entries(state), allow_nan=False, ensure_ascii=False) + "\n"
        encoded = line.encode()
        begin = self._file.tell()
        if self._file.write(encoded) != len(encoded):
            self._file.truncate(begin)
            self._file.seek(begin)
            raise self._full()
        self.count += 1

    def flush_to_disk(self) -> None:
        """Wait until all lines are on the disk, so that they outlast a power cut.

        A file that somebody has removed meanwhile is written anew.

        Raises
        ------
        OSError
            If they cannot be brought there.
        """
        if not os.path.lexists(self._path):
            self._write_anew()
        os.fsync(self._file.fileno())

    def _write_anew(self) -> None:
        self._file.seek(0)
        content = self._file.readall()
        fresh = self._path.open("x+b", buffering=0)
        if fresh.write(content) != len(content):
            fresh.close()
            self._path.unlink()
            raise self._full()
        self._file.close()
        self._file = fresh

    def _full(self) -> OSError:
        return OSError(f"{self._path} could not be written whole; is the disk full?")

    def close(self) -> None:
        """Close the file; further calls do nothing."""
        self._file.close()

    def __exit__(self, *_: object) -> None:
        self.close()


def is_course(path: Path) -> bool:
    """Whether a file begins with a line as a `ProgressLog` writes it.

    Parameters
    ----------
    path : Path
        The file, if there is one.
    """
    try:
        with path.open("rb") as file:
            line = json.loads(file.readline(BLOCK))
    except (OSError, ValueError, RecursionError):
        return False
    return isinstance(line, dict) and {"time", "outcome"} <= set(line)


def _entries(state: ContactState) -> dict[str, Any]:
    entries: dict[str, Any] = {"time": float(state.time)}
    for name, variable in SCALARS.items():
        number = float(getattr(state, name))
        whole = variable.kind.startswith("i")
        # JSON has no word for what is no number.
        entries[name] = (int(number) if whole else number) if math.isfinite(number) else None
    outcome = Outcome(state.outcome).name.lower()
    return {**entries, "outcome": outcome, "warnings": list(state.warnings)}


def _end_of(path: Path, lines: int) -> tuple[int, int]:
    """Return where a number of lines ends [bytes], and how many whole lines were found."""
    found = position = 0
    with path.open("rb") as file:
        while found < lines and (block := file.readline(BLOCK)):
            position += len(block)
            found += block.endswith(b"\n")
    return position, found
