"""Contacts of bodies in steady motion: one contact for each speed, without steps in time."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: few runs need all of them.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
