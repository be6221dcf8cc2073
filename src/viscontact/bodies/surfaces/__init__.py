"""Measured surfaces: reading, repair, levelling, resampling, and conversion to an indenter."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: few cases need them.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
