"""Case files: reading, checking, and conversion to the objects of a run.

Names are loaded at their first use, so that the shipped cases are listed fast.
"""

from viscontact.backend.lazy_names import attach_stub as _attach_stub

__getattr__, __dir__, __all__ = _attach_stub(__name__, __file__)
