"""Names of files in the folder of a case."""

from __future__ import annotations

import re
from pathlib import PurePosixPath, PureWindowsPath

#: Device names of Windows, with any suffix.
_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d) *(\.|$)", re.IGNORECASE)


def is_plain_name(name: str) -> bool:
    """True if a name is that of a file in the same folder, on any system."""
    kinds = (PurePosixPath, PureWindowsPath)
    is_whole = bool(name) and all(kind(name).name == name for kind in kinds)
    return is_whole and not name.startswith(".") and name.isprintable() and not _is_special(name)


def _is_special(name: str) -> bool:
    """True if Windows reads the name as a device or as another name."""
    return name[-1:] in (".", " ") or bool(_DEVICE.match(name))
