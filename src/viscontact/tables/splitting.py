"""Rows of cells of a text file: the separator, and lines that are comments."""

from __future__ import annotations

import csv
import io
import itertools
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.tables.text import MOST_ROWS, Row, looks_like_number, read_text

_COMMENTS = ("#", "%", "//")
_COMMENT = re.compile(r"\s*(?:#|%|//)[#%\s]*")
# Of equal votes the first one separates, and a comma may then be a decimal mark.
_SEPARATORS = "\t;,|"
#: Blanks as the separator.
_BLANKS = " "
# Lines at the beginning and at the end of a file that decide on the separator.
_FIRST, _LAST = 400, 100
# Comments that may hold a heading: instruments write some tens of lines.
_MOST_COMMENTS = 2000
# Also with separators of thousands, which are refused later.
_NUMBER = re.compile(r"[+-]?[.,]*\d[\d.,]*(?:[eE][+-]?\d+)?")
# A name and its unit are one cell: "time [s]".
_BEFORE_UNIT = re.compile(r"\s+(?=[\[(])")
_WIDE_BLANK = re.compile(r"\s{2,}")


@dataclass(frozen=True)
class TextRows:
    """Rows of a text that are neither empty nor comments, and comments as rows."""

    rows: list[Row]
    comments: list[Row]


def rows_of_text(path: Path, example: str) -> TextRows:
    """Rows of a text file; `example`, a first row, is for messages."""
    text = read_text(path)
    lines = [line for line in _lines(text) if line.strip()]
    plain = [line for line in lines if not _is_comment(line)]
    mark = _separator(plain)
    rows: list[Row] = []
    try:
        for row in _rows_at_blanks(text) if mark == _BLANKS else _rows_at(text, mark):
            rows.append(row)
            if len(rows) > MOST_ROWS:
                raise ValueError(
                    f"{path.name}: more than {MOST_ROWS} rows; keep fewer of the measured points"
                )
    except csv.Error as error:
        raise ValueError(f"{path.name}: cannot be read as CSV: {error}") from error
    if not rows:
        raise ValueError(f"{path.name} is empty; a table begins with e.g. {example!r}")
    return TextRows(rows, list(_comment_rows(text, mark)))


def _separator(lines: Sequence[str]) -> str:
    """Character between the cells: the one that leaves most numbers whole."""
    # Lines above the table may have other ones, so that the rows of numbers decide.
    sample = [*lines[:_FIRST], *lines[_FIRST:][-_LAST:]]
    votes = {mark: sum(_share_of_numbers(line, mark) for line in sample) for mark in _SEPARATORS}
    votes[_BLANKS] = sum(_share_of_numbers(line, _BLANKS) for line in sample)
    best = max(votes.values())
    if best == 0:
        first = lines[0] if lines else ""
        return next((mark for mark in _SEPARATORS[:-1] if mark in first), ",")
    return next(mark for mark, vote in votes.items() if vote >= best * (1 - 1e-12))


def _share_of_numbers(line: str, mark: str) -> float:
    """Share of numbers among the cells of a line; 0 for a single cell, or mostly other ones."""
    if mark == "," and (";" in line or "\t" in line):
        return 0.0  # decimal marks, more likely than separators
    cells = line.split(None if mark == _BLANKS else mark)
    filled = [cell for cell in (cell.strip().strip('"') for cell in cells) if cell]
    if mark == _BLANKS and any(cell.endswith(",") for cell in filled):
        return 0.0  # no decimal mark is the last of a number: the commas separate
    numbers = sum(bool(_NUMBER.fullmatch(cell)) or looks_like_number(cell) for cell in filled)
    share = numbers / max(len(filled), 1)
    # "5 N" is one cell; only numbers side by side are cells between blanks.
    least = 2 if mark == _BLANKS else 1
    return share if len(cells) > 1 and share >= 0.5 and numbers >= least else 0.0


def _rows_at(text: str, separator: str) -> Iterator[Row]:
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, skipinitialspace=True)
    for cells in reader:
        if any(cell.strip() for cell in cells) and not _is_comment(cells[0]):
            yield Row(reader.line_num, tuple(cell.strip() for cell in cells))


def _rows_at_blanks(text: str) -> Iterator[Row]:
    for number, line in enumerate(_lines(text), start=1):
        if line.strip() and not _is_comment(line):
            yield Row(number, _cells_at_blanks(line))


def _cells_at_blanks(line: str) -> tuple[str, ...]:
    """Cells of a line whose separators are blanks; a unit in brackets belongs to its name."""
    cells = line.split()
    if all(map(looks_like_number, cells)):
        return tuple(cells)
    wide = _WIDE_BLANK.split(line.strip())
    if len(wide) > 1:
        return tuple(wide)
    joined = _BEFORE_UNIT.sub("\0", line.strip())
    return tuple(cell.replace("\0", " ") for cell in joined.split())


def _comment_rows(text: str, separator: str) -> Iterator[Row]:
    """Comments as rows of cells, without their marks."""
    for number, line in enumerate(itertools.islice(_lines(text), _MOST_COMMENTS), start=1):
        if not _is_comment(line):
            continue
        bare = line[_COMMENT.match(line).end() :]  # type: ignore[union-attr]  # is a comment
        if not bare.strip():
            continue
        cells = _cells_at_blanks(bare) if separator == _BLANKS else bare.split(separator)
        yield Row(number, tuple(cell.strip().strip('"') for cell in cells))


def _lines(text: str) -> Iterator[str]:
    """Lines as the reader of CSV counts them: at line feeds and carriage returns only."""
    return iter(io.StringIO(text, newline=None))


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith(_COMMENTS)
