"""Files that are being uploaded: written to the disk as they arrive."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from viscontact.runs.directory.atomic_files import put_in_place
from viscontact.web.workspace.problems import RequestError

#: Largest number of files in a folder, and of uploads at the same time.
MOST_FILES, MOST_UPLOADS = 500, 4
#: Suffix of files that are not yet whole.
_PART = ".upload"


class Upload:
    """File that arrives in parts."""

    def __init__(self, path: Path, fresh: Path, file: BinaryIO) -> None:
        self.size = 0
        self._path, self._fresh, self._file = path, fresh, file

    def write(self, part: bytes) -> None:
        """Append a part."""
        self.size += self._file.write(part)

    def keep(self) -> None:
        """Put the whole file in its place."""
        self._file.close()
        put_in_place(self._fresh, self._path)


class Uploads:
    """Uploads to a folder, limited in number."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._active = folder, 0
        for left in folder.glob(f".*{_PART}"):  # by a server that was killed
            with suppress(OSError):
                left.unlink()

    @contextmanager
    def receiving(self, path: Path) -> Iterator[Upload]:
        """Receive a file within the block, in place of one of the same name; RequestError."""
        self._require_room(path)
        fresh = path.with_name(f".{secrets.token_hex(6)}{_PART}")
        self._active += 1
        try:
            with fresh.open("wb") as file:
                yield Upload(path, fresh, file)
        except OSError as error:
            why = f"{path.name} cannot be stored: {error.strerror or error}"
            raise RequestError(507, why) from error
        finally:
            self._active -= 1
            with suppress(OSError):  # exists only after a failure
                fresh.unlink()

    def _require_room(self, path: Path) -> None:
        if self._active >= MOST_UPLOADS:
            why = f"{MOST_UPLOADS} files are being uploaded already; try it again in a moment"
            raise RequestError(429, why, retry_after=2)
        names = [each.name for each in self._folder.iterdir() if not each.name.startswith(".")]
        if path.name not in names and len(names) >= MOST_FILES:
            raise RequestError(
                507,
                f"the folder has {len(names)} files, and takes {MOST_FILES} at most; remove some "
                "of them",
            )
