"""Fits of exponential series to creep, relaxation and oscillation tests."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, which cases use; each is loaded at its first use: few cases are fitted.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
