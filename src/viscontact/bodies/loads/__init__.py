"""Load histories: force or approach over time, eccentricity and tilt."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: a case has few of all kinds.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
