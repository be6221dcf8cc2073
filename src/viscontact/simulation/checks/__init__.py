"""Argument checks, and accuracy warnings as dicts of kind to sentence, empty if there is none."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: few runs need all of them.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
