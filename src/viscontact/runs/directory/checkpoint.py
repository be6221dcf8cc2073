"""Restart state of a run, saved atomically in `state.npz`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from viscontact import __version__
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.runs.directory.atomic_files import replacing
from viscontact.runs.directory.lock_check import LockCheck, never_lost
from viscontact.runs.directory.npz_archive import outline_of, read_plain, write_plain

#: Layout of the restart data; raise it with every change of a name or a meaning in them.
LAYOUT = 11

#: Remedy for files from which a run cannot be resumed.
REMEDY = "start the run again with --overwrite"


@dataclass(frozen=True)
class Checkpoint:
    """State of a run between two of its steps."""

    case: dict[str, Any]  # description of the run; only a run with an equal one continues from here
    lines: int  # of the progress log
    reached: float | None  # last recorded instant [s] or speed [m/s]; None before the first
    result: RestartData  # position of the result's writer
    march: RestartData  # empty before the first step
    transforms: str  # library of the Fourier transforms
    inner_loops: str  # what computes them
    version: str = __version__  # of the program that saved it
    layout: int = LAYOUT  # of the restart data


def save_checkpoint(path: Path, checkpoint: Checkpoint, check: LockCheck = never_lost) -> None:
    """Save a checkpoint in place of the previous one, which stays if that fails with an OSError."""
    with replacing(path, check) as file:
        # Not `asdict`, which would copy every array.
        write_plain(file, vars(checkpoint))


def is_checkpoint(path: Path) -> bool:
    """True if a file was saved as a checkpoint, by any version; parts of it may be damaged."""
    try:
        with path.open("rb") as file:
            outline = outline_of(file)
    except (OSError, ValueError):
        return False
    return isinstance(outline, dict) and {"case", "march", "transforms"} <= set(outline)


def load_checkpoint(path: Path) -> Checkpoint:
    """Load a checkpoint to the last bit; ValueError if damaged, or of another origin or version."""
    try:
        with path.open("rb") as file:
            saved = read_plain(file)
    except ValueError as error:
        raise ValueError(f"{path}: {error}; {REMEDY}") from error
    version = saved.get("version")
    if version != __version__:
        raise ValueError(
            f"{path}: was saved by viscontact {version}, and this is {__version__}; continue "
            "with that version, or start the run again with --overwrite"
        )
    if saved.get("layout") != LAYOUT:
        raise ValueError(f"{path}: was saved by an earlier state of viscontact; {REMEDY}")
    try:
        return Checkpoint(**saved)
    except TypeError as error:
        raise ValueError(f"{path}: was saved by another version of viscontact; {REMEDY}") from error
