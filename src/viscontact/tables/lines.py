"""Reader of lines drawn by points: roller profiles and cross-sections in tables."""

from __future__ import annotations

import re
from os import PathLike
from pathlib import Path

from viscontact.tables.reader import read_table
from viscontact.tables.rows import read_source

#: Signs of the levels: a drop is positive downwards, a measured height upwards.
_LEVELS = {"drop": 1.0, "height": -1.0}


def read_line(path: str | PathLike[str], along: str) -> tuple[list[float], list[float]]:
    r"""Read a line, positions and drops, from a CSV file or a spreadsheet.

    Parameters
    ----------
    path : path-like
        The file, as `read_table` takes it; its header names columns and units, as
        ``x [mm], drop [um]``, or a height in place of the drop. Other columns are left out.
    along : str
        Name of the column of positions: ``"x"``, ``"y"`` or ``"r"``.

    Returns
    -------
    positions, drops : list of float
        In the file's order [m]; a height is a negative drop.

    Raises
    ------
    ValueError
        If the file cannot be read, a column is missing, or both a drop and a height are there.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "crown.csv")
    >>> _ = file.write_text("x;height\nmm;um\n0;1,5\n4;-2\n")
    >>> read_line(file, "x")
    ([0.0, 0.004], [-1.5e-06, 2e-06])
    """
    path = Path(path)
    heading = read_source(path, lambda cell: _name(cell) in (along, *_LEVELS)).found.rows[0]
    names = {cell: _name(cell) for cell in heading.cells if cell}
    levels = [name for name in names.values() if name in _LEVELS]
    if along not in names.values() or len(levels) != 1:
        raise ValueError(
            f"{path.name}: the columns {along} and drop (or height) are needed, as '{along} [mm], "
            f"drop [um]', got {', '.join(map(repr, names)) or 'none'}"
        )
    wanted = {along, levels[0]}
    table = read_table(
        path, {cell: name if name in wanted else None for cell, name in names.items()}
    )
    sign = _LEVELS[levels[0]]
    return table[along].tolist(), [sign * level for level in table[levels[0]].tolist()]


def _name(cell: str) -> str:
    found = re.match(r"\s*(\w+)", cell)
    return found[1].lower() if found else ""
