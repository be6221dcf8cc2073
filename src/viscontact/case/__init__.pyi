"""Public names of `viscontact.case`, for type checkers and the lazy loading in `__init__.py`."""

from .case import Case as Case
from .errors import CaseError as CaseError
from .incomplete_case import Parts as Parts
from .incomplete_case import read_parts as read_parts
from .reader import read_case as read_case
from .reader import read_case_text as read_case_text
from .sections import case_schema as case_schema
from .single_material import read_material as read_material
from .single_material import read_section as read_section
from .single_material import shipped_material as shipped_material
