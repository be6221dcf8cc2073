"""Seal at the end of a result file: checksums of its bytes, checked before HDF5 reads it."""

# HDF5 ends the process or reads for ever at some damages of its own structure, such as sizes in a
# heap. It ignores what is behind its last byte; a program that changes the file cuts the seal off.

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import BinaryIO

from viscontact.results.damage import DamagedFileError

#: Bytes with a checksum of their own, and the number of such blocks. The structure is at the
#: beginning of a file; in a larger file, damage to fields behind it is noticed by their digests.
_BLOCK, _MOST = 2**20, 256
#: Bytes that are read at a time.
_PIECE = 2**16
#: End of a seal: number of bytes before it, CRC-32 of the seal so far, and what a seal is known by.
_END = struct.Struct("<QI12s")
_MARK = b"viscontactCS"


def seal(path: Path) -> None:
    """Add a seal to a closed file."""
    with path.open("r+b") as file:
        sums, size = _checksums(file), file.seek(0, 2)
        sums += struct.pack("<Q", size)
        file.write(sums[:-8] + _END.pack(size, zlib.crc32(sums), _MARK))


def check_seal(path: Path) -> bool:
    """Return whether a file has a seal; DamagedFileError if its bytes are not those sealed."""
    with path.open("rb") as file:
        length = file.seek(0, 2)
        if length < _END.size:
            return False
        file.seek(length - _END.size)
        size, digest, mark = _END.unpack(file.read(_END.size))
        count = min(-(-size // _BLOCK), _MOST)
        if mark != _MARK or length != size + 4 * count + _END.size:
            return False
        file.seek(size)
        sums = file.read(4 * count)
        if zlib.crc32(sums + struct.pack("<Q", size)) != digest:
            raise DamagedFileError(path, "its checksums")
        if _checksums(file, size) != sums:
            raise DamagedFileError(path, "its bytes")
    return True


def _checksums(file: BinaryIO, size: int | None = None) -> bytes:
    """CRC-32 of each block among the first bytes of a file."""
    file.seek(0)
    left = min(_MOST * _BLOCK, file.seek(0, 2) if size is None else size)
    file.seek(0)
    found = b""
    while left > 0:
        wanted, digest = min(_BLOCK, left), 0
        while wanted > 0 and (piece := file.read(min(_PIECE, wanted))):
            digest = zlib.crc32(piece, digest)
            wanted, left = wanted - len(piece), left - len(piece)
        if wanted > 0:  # the file has become shorter
            break
        found += struct.pack("<I", digest)
    return found
