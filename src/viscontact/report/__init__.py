"""Runs and studies as self-contained pages of HTML, to look at and to send."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: a report is of one kind.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
