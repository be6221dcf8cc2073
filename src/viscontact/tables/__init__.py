"""Measured tables: CSV files whose header names columns and units, as instruments export them."""

from viscontact.tables.lines import read_line
from viscontact.tables.names import QUANTITIES
from viscontact.tables.reader import read_table
from viscontact.tables.table import Table
from viscontact.tables.text import read_text

__all__ = ["QUANTITIES", "Table", "read_line", "read_table", "read_text"]
