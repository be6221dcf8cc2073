"""Case files: reading, checking, and conversion to the objects of a run."""

from viscontact.case.case import Case
from viscontact.case.errors import CaseError
from viscontact.case.parts import Parts, read_parts
from viscontact.case.reader import read_case, read_case_text
from viscontact.case.sections import case_schema
from viscontact.case.single_material import read_material, read_section, shipped_material

__all__ = [
    "Case",
    "CaseError",
    "Parts",
    "case_schema",
    "read_case",
    "read_case_text",
    "read_material",
    "read_parts",
    "read_section",
    "shipped_material",
]
