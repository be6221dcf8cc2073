"""Text files of instruments: encoding, rows of cells, and numbers in them."""

from __future__ import annotations

import difflib
import re
from os import PathLike
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass

#: Upper limit on the rows of a table; larger records are to be thinned out.
MOST_ROWS = 1_000_000
# Upper limit on a file of measured points; larger records are to be thinned out.
_LARGEST_FILE = 50_000_000
# Characters that decide on the encoding of a text without a byte-order mark.
_SAMPLED = 2000

_BYTE_ORDER_MARKS = ((b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"), (b"", "utf-8-sig"))
# Spreadsheets under another name: packed (xlsx, also those of other programs) and older (xls).
_WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")
_NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?")
_DATE = re.compile(r"\d{4}-\d\d-\d\d.*|(?:\d+ days?, )?\d+:\d\d(?::[\d.]+)?")
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)


@dataclass(frozen=True)
class Row:
    """One row of a file: its line number, from 1, and its cells without blanks around them."""

    line: int
    cells: tuple[str, ...]


def require_file(path: str | PathLike[str]) -> Path:
    """Return the path of an existing file, or refuse it with the nearest name.

    Parameters
    ----------
    path : path-like
        The given path.

    Returns
    -------
    Path
        The path.

    Raises
    ------
    ValueError
        If there is no such file, or it is a directory or a device.
    """
    path = Path(path)
    try:
        if path.is_dir():
            raise ValueError(f"{path}: is a directory; name the file in it")
        if not path.exists():
            raise ValueError(f"no such file {path}{_nearest(path)}")
        if not path.is_file():  # a device may be endless
            raise ValueError(f"{path}: is no file")
    except (OSError, ValueError) as error:  # ValueError: invalid characters in the name
        if str(error).startswith((f"{path}: ", "no such file ")):
            raise
        raise ValueError(f"cannot read {str(path)!r}: {error}") from error
    return path


def read_text(path: Path) -> str:
    """Read a text file of a program or instrument in any common encoding.

    Parameters
    ----------
    path : Path
        A file of no more than 50 MB in UTF-8, UTF-16, Windows-1252 or
        Latin-1.

    Returns
    -------
    str
        Its text.

    Raises
    ------
    ValueError
        If it cannot be read, is too large, or is no text.
    """
    try:
        with require_file(path).open("rb") as file:
            data = file.read(_LARGEST_FILE + 1)
    except OSError as error:
        raise ValueError(f"cannot read {str(path)!r}: {error}") from error
    if len(data) > _LARGEST_FILE:
        raise ValueError(
            f"{path.name}: larger than {_LARGEST_FILE // 1_000_000} MB; keep fewer points"
        )
    if data.startswith(_WORKBOOKS):
        raise ValueError(
            f"{path.name}: a spreadsheet or another packed file, not a text; the name of a "
            "spreadsheet ends in .xlsx, .xlsm, .xls or .ods"
        )
    text = _decode(data)
    if text is None or any(ord(c) < 32 and c not in "\t\n\r\f\v" for c in text):
        raise ValueError(
            f"{path.name}: is no text file in UTF-8, UTF-16 or Latin-1; export it as plain text"
        )
    return text


def looks_like_number(cell: str) -> bool:
    """Return True for a cell that is a number rather than a name or a unit.

    Examples
    --------
    >>> looks_like_number("0,5"), looks_like_number("nan"), looks_like_number("1/MPa")
    (True, True, False)
    """
    return bool(_NUMBER.fullmatch(cell) or _NOT_FINITE.fullmatch(cell))


def decimal_number(cell: str, mark: str) -> str:
    """Return the digits of a number with a decimal point, or raise ValueError.

    Parameters
    ----------
    cell : str
        Text of the cell.
    mark : str
        The decimal mark of the file: a point or a comma.

    Returns
    -------
    str
        The same number as Python writes it.

    Raises
    ------
    ValueError
        If it is empty, text, not finite, or written with the other mark.

    Examples
    --------
    >>> decimal_number("-0,5e3", ",")
    '-0.5e3'
    """
    if not cell:
        raise ValueError("the cell is empty; fill it in or leave the row out")
    if _NOT_FINITE.fullmatch(cell):
        raise ValueError(f"must be a finite number, got {cell!r}")
    if mark == "," and "." in cell and re.fullmatch(r"[\d.,eE+-]+", cell):
        raise ValueError(
            f"got {cell!r} in a file of decimal commas; write one decimal mark and no thousands "
            "separators"
        )
    if _DATE.fullmatch(cell):
        raise ValueError(
            f"{cell!r} is a date or a time of day, not a number; write times as numbers, such as "
            "seconds since the start (spreadsheets turn entries such as 1.2 or 3/4 into dates)"
        )
    if not _NUMBER.fullmatch(cell):
        raise ValueError(f"{cell[:40]!r} is not a number")
    return cell.replace(",", ".")


def _nearest(path: Path) -> str:
    try:
        names = [entry.name for entry in path.parent.iterdir()]
    except (OSError, ValueError):  # no such folder, or not readable
        return ""
    near = difflib.get_close_matches(path.name, names, n=1)
    return f"; did you mean '{path.parent / near[0]}'?" if near else ""


def _decode(data: bytes) -> str | None:
    marked = next(encoding for mark, encoding in _BYTE_ORDER_MARKS if data.startswith(mark))
    if marked == "utf-8-sig":
        marked = _unmarked_utf_16(data) or marked
    # Latin-1 last: it accepts all bytes.
    encodings = (marked,) if marked.startswith("utf-16") else (marked, "cp1252", "latin-1")
    for encoding in encodings:
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    return None


def _unmarked_utf_16(data: bytes) -> str | None:
    """Byte order of a text in UTF-16 without a mark: every other byte is mostly zero."""
    half = len(data[: 2 * _SAMPLED]) // 2
    for offset, encoding in ((1, "utf-16-le"), (0, "utf-16-be")):
        if data[offset : 2 * half : 2].count(0) > 0.8 * half > 0:
            return encoding
    return None
