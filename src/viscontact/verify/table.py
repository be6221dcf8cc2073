"""Table of verification results as text, Markdown or CSV."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import fields
from itertools import pairwise
from pathlib import Path

from viscontact.units.formatting import format_number, readable_unit
from viscontact.verify.case import Result

HEADINGS = (
    *("case", "reference", "quantity", "exact", "ours"),
    *("error", "bound", "order", ""),
)

#: Suffixes of the files of a table.
SUFFIXES = (".md", ".csv")


def row_of_words(result: Result) -> tuple[str, ...]:
    """Result as formatted cells, one for each of `HEADINGS`, in a readable unit."""
    unit = readable_unit(result.unit, result.exact)
    exact, ours = (format_number(value / unit.factor, 6) for value in (result.exact, result.ours))
    return (
        result.case,
        result.reference,
        result.quantity,
        f"{exact} {unit.symbol}".rstrip(),
        ours,
        f"{result.error:.1e}",
        f"{result.bound:.0e}" if result.bound else "0",
        "-" if math.isnan(result.order) else f"{result.order:.1f}",
        "ok" if result.passed else result.failure or "FAILED",
    )


def as_markdown(results: Sequence[Result]) -> str:
    """Markdown table; case and reference are given in the first row of a case only."""
    rows = [row_of_words(result) for result in results]
    shown = [
        row if row[:2] != before[:2] else ("", "", *row[2:])
        for before, row in pairwise([HEADINGS, *rows])
    ]
    lines = [HEADINGS, ("---",) * len(HEADINGS), *shown]
    return "".join(f"| {' | '.join(word.replace('|', '/') for word in line)} |\n" for line in lines)


def as_csv(results: Sequence[Result]) -> str:
    """CSV table of all fields, values in SI units."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    names = [field.name for field in fields(Result)]
    writer.writerow([*names, "passed"])
    writer.writerows(
        [*(getattr(result, name) for name in names), result.passed] for result in results
    )
    return text.getvalue()


def write_table(results: Sequence[Result], path: Path) -> None:
    """Write the table to a file.

    Parameters
    ----------
    results : sequence of Result
        The results.
    path : Path
        The file, in the format of its suffix, ``.md`` or ``.csv``.

    Raises
    ------
    ValueError
        If the suffix is not one of these.

    Examples
    --------
    >>> import tempfile
    >>> result = Result("cone", "Love 1939", "approach", "m", 2e-5, 2e-5, 0.0, 1e-3, 2.0, 0.1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_table([result], Path(folder) / "table.csv")
    ...     (Path(folder) / "table.csv").read_text(encoding="utf-8")[:23]
    'case,reference,quantity'
    """
    if path.suffix not in SUFFIXES:
        raise ValueError(f"{path}: wanted a file that ends in .md or .csv")
    text = as_markdown(results) if path.suffix == ".md" else as_csv(results)
    path.write_text(text, encoding="utf-8")
