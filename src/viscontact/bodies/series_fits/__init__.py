"""Fits of exponential series to creep, relaxation and oscillation tests."""

import lazy_loader

# Names of __init__.pyi, which cases use; each is loaded at its first use: few cases are fitted.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
