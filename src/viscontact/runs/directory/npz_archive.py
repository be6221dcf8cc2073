"""Plain data in a file: arrays as NumPy writes them, all else as JSON, both checked when read."""

from __future__ import annotations

import json
import struct
import zipfile
import zlib
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from viscontact.time_integration.restart_data import RestartData

#: Where the outline lies among the arrays, and what stands in it for an array.
_OUTLINE, _ARRAY = "outline", "__array__"

#: What reading says of bytes that are not what was written.
_DAMAGE = (
    *(ValueError, LookupError, TypeError, OverflowError, EOFError, OSError),
    *(zipfile.BadZipFile, zlib.error, struct.error),
    RuntimeError,  # an archive that seems to be encrypted, or of a kind not known
)


def write_plain(file: BinaryIO, restart_data: RestartData) -> None:
    """Write plain data as an ``.npz`` archive.

    Parameters
    ----------
    file : binary file
        Where to.
    restart_data : dict
        Arrays, numbers, texts and None, in lists and dicts.

    Examples
    --------
    >>> import io
    >>> file = io.BytesIO()
    >>> write_plain(file, {"work": 1.5, "past": [None, "left"]})
    >>> read_plain(file)
    {'work': 1.5, 'past': [None, 'left']}
    """
    arrays: list[NDArray[Any]] = []
    outline = json.dumps(_outlined(restart_data, arrays))
    with zipfile.ZipFile(file, "w") as archive:
        _add(archive, _OUTLINE, np.frombuffer(outline.encode(), dtype=np.uint8))
        for index, array in enumerate(arrays):
            _add(archive, f"a{index}", array)


def _add(archive: zipfile.ZipFile, name: str, array: NDArray[Any]) -> None:
    """Add an array as NumPy does, but without copies of it, which take more than a step may."""
    kept = array if array.flags.c_contiguous or array.flags.f_contiguous else array.copy()
    with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
        header = np.lib.format.header_data_from_array_1_0(kept)
        np.lib.format.write_array_header_1_0(member, header)
        if kept.size:
            in_order = kept if kept.flags.c_contiguous else kept.T
            member.write(in_order.data.cast("B"))


def read_plain(file: BinaryIO) -> RestartData:
    """Read what `write_plain` has written.

    Parameters
    ----------
    file : binary file
        Where from; its length and checksums are looked at.

    Returns
    -------
    dict
        The same data, to the last bit.

    Raises
    ------
    ValueError
        If anything in it is not as it was written.

    Examples
    --------
    >>> import io
    >>> read_plain(io.BytesIO(b"half a file"))
    Traceback (most recent call last):
    ...
    ValueError: it is damaged, or was written by something else
    """
    file.seek(0)
    try:
        # Without pickles: reading a file must never run what is in it.
        with np.load(file, allow_pickle=False) as archive:
            # Before any header is believed, lest a damaged one asks for all memory there is.
            if archive.zip.testzip() is not None:
                raise ValueError("a checksum is wrong")
            read = _filled(json.loads(bytes(archive[_OUTLINE]).decode()), archive)
    except _DAMAGE as error:
        raise ValueError("it is damaged, or was written by something else") from error
    if not isinstance(read, dict):
        raise ValueError("it is damaged, or was written by something else")
    return read


def outline_of(file: BinaryIO) -> Any:
    """Read what `write_plain` has written but for the arrays, which need not be sound.

    Parameters
    ----------
    file : binary file
        Where from.

    Raises
    ------
    ValueError
        If there is no such thing in it.

    Examples
    --------
    >>> import io
    >>> file = io.BytesIO()
    >>> write_plain(file, {"work": 1.5})
    >>> outline_of(file)
    {'work': 1.5}
    """
    try:
        with zipfile.ZipFile(file) as archive:
            # Behind the header, which is one line.
            return json.loads(archive.read(f"{_OUTLINE}.npy").partition(b"\n")[2])
    except _DAMAGE as error:
        raise ValueError("it is damaged, or was written by something else") from error


def _outlined(value: Any, arrays: list[NDArray[Any]]) -> Any:
    if isinstance(value, np.ndarray):
        arrays.append(value)
        return {_ARRAY: len(arrays) - 1}
    if isinstance(value, dict):
        return {key: _outlined(each, arrays) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_outlined(each, arrays) for each in value]
    return value.item() if isinstance(value, np.generic) else value


def _filled(value: Any, archive: Any) -> Any:
    if isinstance(value, dict) and _ARRAY in value:
        return archive[f"a{value[_ARRAY]}"]
    if isinstance(value, dict):
        return {key: _filled(each, archive) for key, each in value.items()}
    if isinstance(value, list):
        return [_filled(each, archive) for each in value]
    return value
