"""Surfaces from text files and spreadsheets, by their content."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path

from viscontact.bodies.surfaces.bare_numbers import is_bare, surface_of_numbers
from viscontact.bodies.surfaces.instrument_files import UnknownFormatError, read_instrument
from viscontact.bodies.surfaces.point_tables import heading_of_points, read_points, stated_columns
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.units import Units
from viscontact.tables import is_spreadsheet, read_plain

#: Suffixes of tables, whatever their content is.
TABLES = (".csv", ".txt", ".tsv")
# "# Width: 12 µm": comments that state sizes, which SurfaceTopography reads.
_STATEMENT = re.compile(r"\w\s*[:=]")
_SAMPLED = 4096


def read_text_map(path: Path, units: Units, channel: str | None) -> Surface:
    """Read a map or a line scan from a text file or a spreadsheet."""
    # Rows of bare numbers are scan lines along x, or points; a header such as ``x [um], y [um],
    # height [nm]`` is followed by a row for each point, in any order. All other texts and
    # workbooks are those of instruments, if SurfaceTopography knows them.
    if not is_spreadsheet(path) and _states_sizes(path):
        with suppress(UnknownFormatError):
            return read_instrument(path, units, channel)
    try:
        source, text = read_plain(path, is_bare)
    except ValueError:
        if is_spreadsheet(path) or path.suffix.lower() in TABLES:
            raise
        return read_instrument(path, units, channel)  # a head of text above bytes
    if is_bare(text.rows):
        _require_no_channel(path, channel)
        return surface_of_numbers(source.name, text.rows, units)
    if stated_columns(heading_of_points(path)):
        _require_no_channel(path, channel)
        units.require_none()
        return read_points(path)
    return _of_instrument(path, units, channel)


def _states_sizes(path: Path) -> bool:
    """True for a text that begins with comments of names and values."""
    with path.open("rb") as file:
        lines = file.read(_SAMPLED).decode("latin-1").splitlines()
    first = next((line for line in lines if line.strip()), "")
    return first.startswith("#") and any(
        line.startswith("#") and _STATEMENT.search(line) for line in lines
    )


def _of_instrument(path: Path, units: Units, channel: str | None) -> Surface:
    try:
        return read_instrument(path, units, channel)
    except UnknownFormatError:
        if is_spreadsheet(path) or path.suffix.lower() in TABLES:
            return read_points(path)  # refuses its columns by name
        raise


def _require_no_channel(path: Path, channel: str | None) -> None:
    if channel is not None:
        raise ValueError(f"channel: {path.name} is a table and has none; leave it out")
