"""Files that a case file names, found beside it."""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo

#: What Windows takes for a device, whatever follows behind a point.
_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d) *(\.|$)", re.IGNORECASE)


def beside_the_case(name: str, info: ValidationInfo) -> str:
    """Return the path of a file that a case names.

    Parameters
    ----------
    name : str
        As the case has it.
    info : ValidationInfo
        Its context says in which ``folder`` the case lies, and whether it is ``confined`` to it.

    Raises
    ------
    ValueError
        If a case that is confined to its folder names a file elsewhere.
    """
    context = info.context or {}
    if context.get("confined") and not is_plain_name(name):
        raise ValueError(
            f"{name!r} is not the plain name of a file, such as 'pmma.csv'; here a case reads only "
            "files that have been put beside it"
        )
    return str(Path(context.get("folder", "."), name))


def is_plain_name(name: str) -> bool:
    """Whether a name leads nowhere but to a file in the same folder, on any system.

    Parameters
    ----------
    name : str
        The name.

    Examples
    --------
    >>> [is_plain_name(name) for name in ("pmma.csv", "../pmma.csv", "C:pmma.csv", ".profile")]
    [True, False, False, False]
    """
    kinds = (PurePosixPath, PureWindowsPath)
    is_whole = bool(name) and all(kind(name).name == name for kind in kinds)
    return is_whole and not name.startswith(".") and name.isprintable() and not _is_special(name)


def _is_special(name: str) -> bool:
    """Whether Windows takes it for a device, or for another name."""
    return name[-1:] in (".", " ") or bool(_DEVICE.match(name))


#: The path of a file, relative to the folder of the case file unless it is absolute.
DataFile = Annotated[str, AfterValidator(beside_the_case)]
