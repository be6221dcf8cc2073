"""Identification of laws from creep, relaxation, oscillation and indentation measurements."""

import lazy_loader

# Names of __init__.pyi, each loaded at its first use: few runs need all of them.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
