"""Measured tables and load files: good ones, and what becomes of them."""

from __future__ import annotations

import math
from typing import Any

from hypothesis import strategies as st

from fuzzing import junk
from fuzzing.damage import damaged

_TIMES = (0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0)


def _rows(header: str, rows: list[tuple[float, ...]], mark: str = ",") -> str:
    return "\n".join([header, *(mark.join(f"{v:.6g}" for v in row) for row in rows)]) + "\n"


def _creep(t: float) -> float:
    return 1.0 - 0.5 * math.exp(-t / 10)


TABLES = {
    "load.csv": _rows("time [s], force [N]", [(0, 0), (1, 4), (2, 4), (3, 0)]),
    "approach.csv": _rows("t [s];approach [um]", [(0, 0), (1, 4), (2, 4)], ";"),
    "creep.csv": _rows("time [s], creep_compliance [1/MPa]", [(t, _creep(t)) for t in _TIMES]),
    "relax.csv": _rows("t (s)\tG (MPa)", [(t, 1 / _creep(t)) for t in _TIMES], "\t"),
    "dma.csv": _rows(
        "f [Hz], E' [MPa], E'' [MPa]",
        [(f, 100 + 900 * f**2 / (1 + f**2), 900 * f / (1 + f**2)) for f in _TIMES],
    ),
    "sets.csv": _rows(
        "Set, T [degC], omega [rad/s], G' [MPa], tan delta",
        [
            (s, 20 + 10 * s, w, 1 + 9 * (x := w * 10**s) ** 2 / (1 + x**2), 0.2)
            for s in (0, 1)
            for w in _TIMES
        ],
    ),
    "phase.csv": _rows(
        "#made by hand\n## f/Hz\t|G*|/MPa\tdelta/deg",
        [(f, 100 * f**0.2, 18.0) for f in _TIMES],
        "\t",
    ),
    "storage.csv": _rows("f [Hz];E' [MPa]", [(f, 100 * f**0.2) for f in _TIMES], ";"),
    "blocks.csv": "Project:\tgel\n"
    + "".join(
        f"Interval:\t{k}\nNo.\ttime\tG\tT\n\ts\tMPa\t°C\n"
        + "".join(f"{i}\t{t}\t{1 / _creep(t)}\t{20 + k}\n" for i, t in enumerate(_TIMES))
        for k in (1, 2)
    ),
    "record.csv": _rows(
        "time [s], approach [um], force [uN]",
        [(0.1 * k, 0.1 * k, 50 * (0.1 * k) ** 1.5) for k in range(12)],
    ),
}

_HEADINGS = (
    *("time [s]", "t", "t (s)", "time / s", "time in min", "f [Hz]", "omega [rad/s]", "ω [1/s]"),
    *(
        "force [kN]",
        "force",
        "force [mm]",
        "approach [um]",
        "G [MPa]",
        "E' (Pa)",
        "E''",
        "J [1/MPa]",
    ),
    *("T [°C]", "T [K]", "Set", "aT", "log_aT", "tan delta", "modulus [MPa]", "tilt_x [mrad]"),
    *("", "[s]", "[]", "time []", "time [s] [s]", "((((((((((", "time" * 60, "a" * 300, "time\0"),
    *("Sig1", "columns: t", "Interval data:", "|G*| [Pa]", "delta [°]", "Sec", "x/µm", "Load"),
    *("E_1", "remark", "eccentricity_x [mm]", "1", "nan", "creep_compliance [1/GPa]", "time [s)"),
)

# Lines that instruments write above a table.
_ABOVE = ("", "", "Test:|gel", "[step]", "1|2|3", "Time:|12:30", "# note", "s|Pa", "time [s]|force")


def tables() -> st.SearchStrategy[tuple[str, bytes]]:
    """Return the name of the table that it began as, and the bytes that it became."""
    return st.sampled_from(sorted(TABLES)).flatmap(
        lambda name: st.tuples(st.just(name), _changed(TABLES[name]))
    )


def _cells() -> st.SearchStrategy[str]:
    return st.one_of(junk.number_texts(), junk.one_of(_HEADINGS), junk.texts())


@st.composite
def _changed(draw: Any, text: str) -> bytes:
    mark = next(mark for mark in "\t;," if mark in text)
    rows = [line.split(mark) for line in text.splitlines()]
    for _ in range(draw(st.integers(0, 3))):
        _change(draw, rows)
    rows[:0] = [line.split("|") for line in draw(st.lists(st.sampled_from(_ABOVE), max_size=4))]
    mark = draw(st.sampled_from((mark, mark, mark, ",", ";", "\t", " ", "|", ", ", "\0")))
    joined = draw(st.sampled_from(("\n", "\n", "\n", "\r\n", "\r", "\n\n", "\u2028", "\x0b")))
    return draw(damaged(joined.join(mark.join(row) for row in rows) + joined))


def _change(draw: Any, rows: list[list[str]]) -> None:
    """Change a table of cells in one respect."""
    if not rows:
        return
    row = draw(st.integers(0, len(rows) - 1))
    what = draw(st.sampled_from(("cell", "heading", "ragged", "drop", "double", "swap", "column")))
    if what == "cell" and rows[row]:
        rows[row][draw(st.integers(0, len(rows[row]) - 1))] = draw(_cells())
    elif what == "heading" and rows[0]:
        rows[0][draw(st.integers(0, len(rows[0]) - 1))] = draw(junk.one_of(_HEADINGS))
    elif what == "ragged":
        rows[row] = rows[row][:-1] if draw(st.booleans()) else [*rows[row], draw(_cells())]
    elif what == "drop":
        del rows[row : row + draw(st.integers(1, len(rows)))]
    elif what == "double":
        rows[row:row] = [list(rows[row])] * draw(st.sampled_from((1, 2, 300)))
    elif what == "swap":
        rows[row], rows[-1] = rows[-1], rows[row]
    elif what == "column":
        heading, entry = draw(junk.one_of(_HEADINGS)), draw(_cells())
        for place, cells in enumerate(rows):
            cells.append(entry if place else heading)
