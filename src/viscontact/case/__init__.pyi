from . import error_messages
from .case import Case
from .errors import CaseError
from .incomplete_case import Parts, read_parts
from .reader import read_case, read_case_text
from .sections import case_schema
from .single_material import read_material, read_section, shipped_material

__all__ = [
    "Case",
    "CaseError",
    "Parts",
    "case_schema",
    "error_messages",
    "read_case",
    "read_case_text",
    "read_material",
    "read_parts",
    "read_section",
    "shipped_material",
]
