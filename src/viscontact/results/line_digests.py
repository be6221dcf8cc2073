"""Lines of JSON that end in a digest of what is before it, by which readers notice damage."""

from __future__ import annotations

import json
import re
import zlib
from typing import Any

#: Key of the digest, and of the number of a line in a progress log.
DIGEST, ROW = "digest", "row"
_MARK = f'"{DIGEST}": "'.encode()
_END = re.compile(rb'([0-9a-f]{8})"\}\]?\s*\Z')
_DAMAGED = "is damaged: it is not as it was written"


def with_digest(line: bytes) -> bytes:
    """Add a digest to JSON that is an object, or a list which ends in one.

    Examples
    --------
    >>> with_digest(b'{"time": 1.0}')
    b'{"time": 1.0, "digest": "d3822b00"}'
    """
    end = b"}]" if line.startswith(b"[") else b"}"
    body = line.removesuffix(end)
    head = body if body.endswith(b"{") else body + b", "
    return head + _MARK + f'{zlib.crc32(head):08x}"'.encode() + end


def is_as_written(line: bytes, row: int | None = None) -> bool:
    """True if a line has the right digest, False if it has none; else ValueError.

    A `row` is the number that the line must have.
    """
    head, mark, tail = line.rpartition(_MARK)
    if not mark:
        return False
    found = _END.match(tail)
    if found is None or int(found[1], 16) != zlib.crc32(head):
        raise ValueError(_DAMAGED)
    if row is not None and not head.endswith(f'"{ROW}": {row}, '.encode()):
        raise ValueError("is not the line that was written there")
    return True


def read_entries(line: bytes, row: int | None = None) -> dict[str, Any]:
    """Read an object without its digest; ValueError if it is damaged."""
    is_as_written(line, row)
    found = json.loads(line)
    if not isinstance(found, dict):
        raise ValueError("must be an object of JSON")
    found.pop(DIGEST, None)
    return found
