"""Damage to files: the error where it is noticed, and a notice where it would not be."""

from __future__ import annotations

import logging
from functools import cache
from pathlib import Path
from typing import Any

from viscontact.units.visible import visible

_LOG = logging.getLogger("viscontact")


class DamagedFileError(ValueError):
    """A file is not as it was written; `fault` is the message without its remedy."""

    def __init__(self, path: str | Path, what: str) -> None:
        self.path, self.what = path, what
        self.fault = (
            f"{path} is damaged, or was changed by another program: {what} are not those that were "
            "written"
        )
        super().__init__(f"{self.fault}; restore it from a copy, or compute it again")

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what makes the error in another process."""
        return type(self), (self.path, self.what)


@cache  # once for each file
def note_unchecked(path: Path) -> None:
    """Write a line in the log about a file without digests."""
    _LOG.warning(
        "%s has no digests, as from an earlier version or another program: damage to it would not "
        "be noticed",
        visible(str(path)),
    )
