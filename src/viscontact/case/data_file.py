"""Paths of files that a case file names."""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo

#: Device names of Windows, with any suffix.
_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d) *(\.|$)", re.IGNORECASE)


def beside_the_case(name: str, info: ValidationInfo) -> str:
    """Return the path of a file that a case names; a confined case may use plain names only."""
    context = info.context or {}
    if context.get("confined") and not is_plain_name(name):
        raise ValueError(
            f"{name!r} is not the plain name of a file, such as 'pmma.csv'; here a case reads only "
            "files in its own folder"
        )
    return str(Path(context.get("folder", "."), name))


def is_plain_name(name: str) -> bool:
    """True if a name is that of a file in the same folder, on any system.

    Examples
    --------
    >>> [is_plain_name(name) for name in ("pmma.csv", "../pmma.csv", "C:pmma.csv", ".profile")]
    [True, False, False, False]
    """
    kinds = (PurePosixPath, PureWindowsPath)
    is_whole = bool(name) and all(kind(name).name == name for kind in kinds)
    return is_whole and not name.startswith(".") and name.isprintable() and not _is_special(name)


def _is_special(name: str) -> bool:
    """True if Windows reads the name as a device or as another name."""
    return name[-1:] in (".", " ") or bool(_DEVICE.match(name))


#: The path of a file, relative to the folder of the case file unless it is absolute.
DataFile = Annotated[str, AfterValidator(beside_the_case)]
