"""Measured tables: CSV files whose header names columns and units."""

from viscontact.tables.lines import read_line
from viscontact.tables.names import QUANTITIES
from viscontact.tables.reader import read_table
from viscontact.tables.table import Table
from viscontact.tables.text import (
    Row,
    decimal_number,
    looks_like_number,
    read_rows,
    read_text,
    require_file,
)

__all__ = [
    "QUANTITIES",
    "Row",
    "Table",
    "decimal_number",
    "looks_like_number",
    "read_line",
    "read_rows",
    "read_table",
    "read_text",
    "require_file",
]
