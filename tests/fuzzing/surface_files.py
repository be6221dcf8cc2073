"""Surfaces in texts: matrices, points and lines, and what becomes of them."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from fuzzing import junk
from fuzzing.damage import damaged

_NX, _NY = 6, 5


def _height(i: int, j: int) -> str:
    return f"{0.1 * ((3 * i + 5 * j) % 7):.3f}"


def _lines(rows: list[list[str]], mark: str) -> str:
    return "\n".join(mark.join(row) for row in rows) + "\n"


_MATRIX = [[_height(i, j) for i in range(_NX)] for j in range(_NY)]
_POINTS = [[f"{2 * i}", f"{3 * j}", _height(i, j)] for j in range(_NY) for i in range(_NX)]
_LINE = [[f"{2 * i}", _height(i, 0)] for i in range(12)]
TEXTS = (
    _lines(_MATRIX, ","),
    _lines(_MATRIX, "\t"),
    _lines(_MATRIX, " "),
    _lines(_MATRIX, ";").replace(".", ","),
    _lines(_POINTS, ","),
    _lines(_POINTS, "  "),
    "x [um];y [um];height [um]\n" + _lines(_POINTS, ";"),
    "trace 1\nx/mm\tz/um\n" + _lines(_LINE, "\t"),
    _lines(_LINE, " "),
    "# Channel: Z\n# Width: 12 um\n# Height: 15 um\n# Value units: um\n" + _lines(_MATRIX, " "),
)
_LINES = ("trace 1", _lines(_LINE, " ")[:40])
_UNITS = ("indenter.height_unit=um", "indenter.spacing=[2 um, 3 um]")
_SUFFIXES = (".csv", ".csv", ".txt", ".xyz", ".asc", ".dat", ".tsv", ".x3p", ".npy", ".xlsx", ".")
_CELLS = ("-9999", "1e38", "BAD", "***", "", "nan", "1e400", "-32768", "0x1", "1,2.3", "é", "#")


@st.composite
def surface_files(draw: Any) -> tuple[str, bytes, tuple[str, ...]]:
    """Return the name of a file of a surface, its bytes, and settings of the case."""
    text = draw(junk.one_of(TEXTS))
    if draw(st.integers(0, 2)) == 0:
        number = draw(st.sampled_from(("0.", "0.1", "0.300", "3", "\n")))
        text = text.replace(number, draw(junk.one_of(_CELLS)), draw(st.sampled_from((1, 1, 5))))
    settings = _UNITS if text[0].isdigit() else ()
    if any(text.startswith(line) for line in _LINES):
        settings = (*settings, "indenter.width=10 um")
    if draw(st.integers(0, 9)) == 0:
        settings = draw(st.sampled_from(((), _UNITS, ("indenter.channel=Z",))))
    return f"given{draw(junk.one_of(_SUFFIXES))}", draw(damaged(text)), settings
