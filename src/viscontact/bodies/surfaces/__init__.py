"""Measured surfaces: reading, repair, levelling, resampling, and conversion to an indenter."""

import lazy_loader

# Names of __init__.pyi, each loaded at its first use: few cases need them.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
