"""`state.npz`: what it takes to go on with a run, saved all at once or not at all."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from viscontact import __version__
from viscontact.runs.directory.atomic_files import put_in_place
from viscontact.runs.directory.npz_archive import outline_of, read_plain, write_plain
from viscontact.runs.directory.result_validation import REMEDY
from viscontact.time_integration.restart_data import RestartData


@dataclass(frozen=True)
class Checkpoint:
    """A run as it was after one of its steps.

    Attributes
    ----------
    case : dict
        The run's description, which another run's must equal to go on from here.
    lines : int
        Lines of the progress log.
    reached : float or None
        The last instant that was recorded [s]; None before the first.
    result : dict
        Where the writer of the result stood.
    march : dict
        What the march restart_data; empty before the first step.
    transforms : str
        Whose Fourier transforms the run is made with.
    version : str
        The program that saved it.
    """

    case: dict[str, Any]
    lines: int
    reached: float | None
    result: RestartData
    march: RestartData
    transforms: str
    version: str = __version__


def save_checkpoint(path: Path, checkpoint: Checkpoint) -> None:
    """Save a checkpoint in the place of the one before.

    Parameters
    ----------
    path : Path
        The file; at any moment the old one or the new one is there, even if the power is cut.
    checkpoint : Checkpoint
        What to save.

    Raises
    ------
    OSError
        If it cannot be written; the old one is still there.
    """
    fresh = path.with_name(f".{path.name}.new")
    # What lies there is not written to: it may be a link to anything.
    fresh.unlink(missing_ok=True)
    try:
        with fresh.open("xb") as file:
            # Not `asdict`, which would copy every array.
            write_plain(file, vars(checkpoint))
        put_in_place(fresh, path)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise


def is_checkpoint(path: Path) -> bool:
    """Whether a file was saved as a checkpoint, by any version, be it damaged since in part.

    Parameters
    ----------
    path : Path
        The file, if there is one.
    """
    try:
        with path.open("rb") as file:
            outline = outline_of(file)
    except (OSError, ValueError):
        return False
    return isinstance(outline, dict) and {"case", "march", "transforms"} <= set(outline)


def load_checkpoint(path: Path) -> Checkpoint:
    """Load a checkpoint.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Checkpoint
        As it was saved, to the last bit.

    Raises
    ------
    ValueError
        If the file is damaged, or not ours, or another version's.
    """
    try:
        with path.open("rb") as file:
            saved = read_plain(file)
    except ValueError as error:
        raise ValueError(f"{path}: {error}; {REMEDY}") from error
    version = saved.get("version")
    if version != __version__:
        raise ValueError(
            f"{path}: was saved by viscontact {version}, and this is {__version__}; go on with "
            "that version, or start the run anew with --overwrite"
        )
    try:
        return Checkpoint(**saved)
    except TypeError as error:
        raise ValueError(f"{path}: was saved by another version of viscontact; {REMEDY}") from error
