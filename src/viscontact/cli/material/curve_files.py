"""Files of one or several force curves."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from viscontact.cli.terminal.messages import refuse
from viscontact.identification import count_force_curves
from viscontact.identification.instrument_curves import is_instrument_file


def curve_files(typed: Sequence[Path]) -> list[Path]:
    """Return files, those of directories, and those that a pattern names."""
    found: list[Path] = []
    for path in typed:
        if path.is_dir():
            inside = sorted(each for each in path.iterdir() if _is_curve(each))
            if not inside:
                refuse(f"{path}: the directory holds no CSV table and no file of an instrument")
            found += inside
        elif "*" in path.name and not path.exists():  # a shell of Windows leaves patterns
            matches = sorted(path.parent.glob(path.name))
            if not matches:
                refuse(f"{path}: no file has such a name")
            found += matches
        else:
            found.append(path)
    return found


def _is_curve(path: Path) -> bool:
    return path.is_file() and (path.suffix.lower() == ".csv" or is_instrument_file(path))


def holds_several(files: Sequence[Path]) -> bool:
    """Whether files have several curves; False for a file that cannot be read."""
    if len(files) > 1:
        return True
    try:
        return is_instrument_file(files[0]) and count_force_curves(files[0]) > 1
    except (ValueError, OSError):
        return False
