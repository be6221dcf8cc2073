from .given_columns import GivenColumns, with_typed_meanings
from .lines import read_line
from .names import QUANTITIES
from .reader import read_table
from .rows import read_plain, read_rows, read_source
from .sheets import is_spreadsheet, split_sheet
from .table import Table
from .text import Row, decimal_number, looks_like_number, read_text, require_file

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
