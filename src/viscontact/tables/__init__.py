"""Measured tables: CSV files and spreadsheets whose header names columns and units."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: few runs need all of them.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
