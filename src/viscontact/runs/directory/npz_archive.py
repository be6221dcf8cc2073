"""Plain data in an `.npz` archive: arrays in NumPy's format, the rest as JSON, with checksums."""

from __future__ import annotations

import json
import struct
import zipfile
import zlib
from typing import Any, BinaryIO

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.mechanics.time_integration.restart_data import RestartData

#: Name of the JSON outline among the arrays, and the key in it that refers to an array.
_OUTLINE, _ARRAY = "outline", "__array__"

#: Exceptions of reading damaged bytes.
_DAMAGE = (
    *(ValueError, LookupError, TypeError, OverflowError, EOFError, OSError),
    *(zipfile.BadZipFile, zlib.error, struct.error),
    RuntimeError,  # an archive that seems to be encrypted, or of a kind not known
)


def write_plain(file: BinaryIO, restart_data: RestartData) -> None:
    """Write arrays, numbers, texts and None, in lists and dicts, as an ``.npz`` archive."""
    arrays: list[Numbers] = []
    outline = json.dumps(_outline(restart_data, arrays))
    with zipfile.ZipFile(file, "w") as archive:
        _add(archive, _OUTLINE, np.frombuffer(outline.encode(), dtype=np.uint8))
        for index, array in enumerate(arrays):
            _add(archive, f"a{index}", array)


def _add(archive: zipfile.ZipFile, name: str, array: Numbers) -> None:
    """Add an array in NumPy's format without copying it, which would take longer than a step."""
    kept = array if array.flags.c_contiguous or array.flags.f_contiguous else array.copy()
    with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
        header = np.lib.format.header_data_from_array_1_0(kept)
        np.lib.format.write_array_header_1_0(member, header)
        if kept.size:
            in_order = kept if kept.flags.c_contiguous else kept.T
            member.write(in_order.data.cast("B"))


def read_plain(file: BinaryIO) -> RestartData:
    """Read the data of `write_plain` to the last bit; ValueError if incomplete or damaged."""
    file.seek(0)
    try:
        # Without pickles: reading a file must never run what is in it.
        with np.load(file, allow_pickle=False) as archive:
            # Before any header is used: a damaged one could ask for all memory.
            if archive.zip.testzip() is not None:
                raise ValueError("a checksum is wrong")
            read = _restore(json.loads(bytes(archive[_OUTLINE]).decode()), archive)
    except _DAMAGE as error:
        raise ValueError("it is damaged, or was written by something else") from error
    if not isinstance(read, dict):
        raise ValueError("it is damaged, or was written by something else")
    return read


def outline_of(file: BinaryIO) -> Any:
    """Read the outline of `write_plain`, without the arrays; ValueError if there is none."""
    try:
        with zipfile.ZipFile(file) as archive:
            # Behind the header, which is one line.
            return json.loads(archive.read(f"{_OUTLINE}.npy").partition(b"\n")[2])
    except _DAMAGE as error:
        raise ValueError("it is damaged, or was written by something else") from error


def _outline(value: Any, arrays: list[Numbers]) -> Any:
    if isinstance(value, np.ndarray):
        arrays.append(value)
        return {_ARRAY: len(arrays) - 1}
    if isinstance(value, dict):
        return {key: _outline(each, arrays) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_outline(each, arrays) for each in value]
    return value.item() if isinstance(value, np.generic) else value


def _restore(value: Any, archive: Any) -> Any:
    if isinstance(value, dict) and _ARRAY in value:
        return archive[f"a{value[_ARRAY]}"]
    if isinstance(value, dict):
        return {key: _restore(each, archive) for key, each in value.items()}
    if isinstance(value, list):
        return [_restore(each, archive) for each in value]
    return value
