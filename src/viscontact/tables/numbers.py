"""Numbers in the cells of a table."""

from __future__ import annotations

import re

_NUMBER = re.compile(r"[+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][+-]?\d+)?")
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)


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
    if not _NUMBER.fullmatch(cell):
        raise ValueError(f"{cell[:40]!r} is not a number")
    return cell.replace(",", ".")
