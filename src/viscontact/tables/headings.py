"""Heading of a table: the row that names its columns, wherever it stands in a file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.tables.text import Row, looks_like_number

#: True for the text of a cell that names a column.
Names = Callable[[str], bool]

# Rows from the names to the first numbers: units, and a line of remarks.
_TO_NUMBERS = 3
_SIGNAL = re.compile(r"Sig\d+")
# Words before the columns in comments of instruments: "# columns: time height".
_LEADING_WORDS = ("columns:", "units:", "fancynames:")


@dataclass(frozen=True)
class FoundTable:
    """Rows of a table from its heading on; `known` tells how many of its columns are named.

    `further` are the lines of all headings, where a file has tables with different ones.
    """

    rows: list[Row]
    known: int
    further: tuple[int, ...] = ()


def find_table(rows: list[Row], comments: list[Row], names: Names) -> FoundTable:
    """Rows from the row on that names most columns, with numbers below it.

    Lines above it are left out, as spreadsheets do. Where none names a column, a comment above the
    numbers may; where that does not either, the row above the first numbers is returned.
    """
    numbers = _first_of_numbers(rows)
    if numbers is not None:
        heading = _listed_signals(rows[:numbers], len(rows[numbers].cells))
        if heading and _count(heading[0], names):
            return FoundTable([*heading, *rows[numbers:]], _count(heading[0], names))
    best, known = _best_heading(rows, names)
    if known:
        return FoundTable(_joined(rows, best), known, _different(rows, best, names))
    if numbers is not None:
        heading = _commented_heading(rows[numbers], comments, names)
        if heading:
            return FoundTable([*heading, *rows[numbers:]], _count(heading[0], names))
    return FoundTable(rows[_likeliest(rows, numbers) :], 0)


def _best_heading(rows: list[Row], names: Names) -> tuple[int, int]:
    """Index of the row that names most columns, and their number; those above numbers first."""
    best = (False, 0)
    index = 0
    for i, row in enumerate(rows):
        if any(map(looks_like_number, row.cells)):
            continue
        known = _count(row, names)
        found = (_stands_above_numbers(rows, i, names), known)
        # Of equal ones without numbers between them, the lower one belongs to the numbers.
        if known and (found > best or (found == best and not _are_numbers(rows[index:i]))):
            best, index = found, i
    return index, best[1]


def _are_numbers(rows: list[Row]) -> bool:
    return any(map(_is_of_numbers, rows))


def _count(row: Row, names: Names) -> int:
    return sum(bool(cell) and names(cell) for cell in row.cells)


def _stands_above_numbers(rows: list[Row], index: int, names: Names) -> bool:
    """True if there are numbers in a known column, at most two lines below its name."""
    places = [place for place, cell in enumerate(rows[index].cells) if cell and names(cell)]
    return any(
        looks_like_number(row.cells[place])
        for row in rows[index + 1 : index + 1 + _TO_NUMBERS]
        for place in places
        if place < len(row.cells)
    )


def _first_of_numbers(rows: list[Row]) -> int | None:
    """Index of the first of the consecutive rows of a width that hold most numbers, or None."""
    best, most = None, 0
    first, count = 0, 0
    for i, row in enumerate(rows):
        if not _is_of_numbers(row):
            count = 0
            continue
        if not count or len(row.cells) != len(rows[i - 1].cells):
            first, count = i, 0
        count += sum(map(looks_like_number, row.cells))
        if count > most:
            best, most = first, count
    return best


def _is_of_numbers(row: Row) -> bool:
    """True for a row of a table without names: half of its cells, or more, are numbers."""
    filled = [cell for cell in row.cells if cell]
    return 2 * sum(map(looks_like_number, filled)) >= len(filled)


def _listed_signals(above: list[Row], width: int) -> list[Row]:
    """Heading of a table whose signals are listed above it, one in a line: "Sig2, Temperature"."""
    listed = [row for row in above if len(row.cells) > 1 and _SIGNAL.fullmatch(row.cells[0])]
    if len(listed) != width:
        return []
    return [Row(listed[0].line, tuple(row.cells[1] for row in listed))]


def _likeliest(rows: list[Row], numbers: int | None) -> int:
    """Index of the row that looks most like a heading where none has a known name."""
    if not numbers:
        return 0
    least = max(len(rows[numbers].cells) - 1, 1)
    above = range(max(numbers - _TO_NUMBERS, 0), numbers)
    filled = {i: sum(map(bool, rows[i].cells)) for i in above}
    named = [i for i in above if not any(map(looks_like_number, rows[i].cells))]
    return max((i for i in named if filled[i] >= least), key=lambda i: (filled[i], -i), default=0)


def _commented_heading(first: Row, comments: list[Row], names: Names) -> list[Row]:
    """Names, and units if they have a comment of their own, above the first row of numbers."""
    above = [_without_leading_word(row) for row in comments if row.line < first.line]
    fitting = [row for row in above if len(row.cells) == len(first.cells)]
    named = [i for i, row in enumerate(fitting) if _count(row, names)]
    if not named:
        return []
    chosen = max(named, key=lambda i: (_count(fitting[i], names), i))
    return fitting[chosen : chosen + 2]


def _without_leading_word(row: Row) -> Row:
    word, _, rest = row.cells[0].partition(" ")
    if word.lower() in _LEADING_WORDS:
        cells = (rest.strip(), *row.cells[1:]) if rest.strip() else row.cells[1:]
        return Row(row.line, tuple(cells))
    return row


def _different(rows: list[Row], chosen: int, names: Names) -> tuple[int, ...]:
    """Lines of all headings of two known names or more; none if they are all alike."""
    found: list[int] = []
    for i, row in enumerate(rows):
        is_heading = not any(map(looks_like_number, row.cells)) and (
            i == chosen or (_count(row, names) > 1 and _stands_above_numbers(rows, i, names))
        )
        if is_heading and found and not _are_numbers(rows[found[-1] : i]):
            found[-1] = chosen if found[-1] == chosen else i  # one table has one of them
        elif is_heading:
            found.append(i)
    alike = {rows[i].cells for i in found} == {rows[chosen].cells}
    return () if alike or len(found) < 2 else tuple(rows[i].line for i in found)


def _joined(rows: list[Row], start: int) -> list[Row]:
    """Rows from a heading on; where it comes again, its rows are those of one table.

    Rheometers write a block for each interval of a test. The lines of text above a repeated heading
    and the heading itself are left out.
    """
    heading = rows[start]
    again = [i for i in range(start + 1, len(rows)) if rows[i].cells == heading.cells]
    if not again:
        return rows[start:]
    blocks = [rows[first:last] for first, last in zip([start, *again], [*again, None], strict=True)]
    kept = list(_without_text_below(blocks[0], heading, last=False))
    units = kept[1] if len(kept) > 1 and not any(map(looks_like_number, kept[1].cells)) else None
    for number, block in enumerate(blocks[1:], start=2):
        body = list(_without_text_below(block, heading, last=number == len(blocks)))[1:]
        same = units is not None and body and body[0].cells == units.cells
        kept += body[1:] if same else body
    return kept


def _without_text_below(block: list[Row], heading: Row, *, last: bool) -> Iterator[Row]:
    """Rows of a block without the lines of text at its end, which belong to the next one."""
    end = len(block)
    if not last:
        width = sum(map(bool, heading.cells))
        while end > 1 and _is_text(block[end - 1], width):
            end -= 1
    yield from block[:end]


def _is_text(row: Row, width: int) -> bool:
    """True for a line above a heading: a text first, and fewer cells than the table has."""
    filled = [cell for cell in row.cells if cell]
    is_fewer = len(filled) < width or filled[0].endswith(":")
    return is_fewer and not looks_like_number(filled[0])
