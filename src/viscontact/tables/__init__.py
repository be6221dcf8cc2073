"""Measured tables: CSV files and spreadsheets whose header names columns and units."""

from viscontact.tables.given_columns import GivenColumns, with_typed_meanings
from viscontact.tables.lines import read_line
from viscontact.tables.names import QUANTITIES
from viscontact.tables.reader import read_table
from viscontact.tables.rows import read_plain, read_rows, read_source
from viscontact.tables.sheets import is_spreadsheet, split_sheet
from viscontact.tables.table import Table
from viscontact.tables.text import (
    Row,
    decimal_number,
    looks_like_number,
    read_text,
    require_file,
)

__all__ = [
    "QUANTITIES",
    "GivenColumns",
    "Row",
    "Table",
    "decimal_number",
    "is_spreadsheet",
    "looks_like_number",
    "read_line",
    "read_plain",
    "read_rows",
    "read_source",
    "read_table",
    "read_text",
    "require_file",
    "split_sheet",
    "with_typed_meanings",
]
