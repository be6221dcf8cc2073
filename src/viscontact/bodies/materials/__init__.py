"""Materials: elastic constants and creep law, J(t), the shipped library, cards."""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, which results record; each is loaded at its first use.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
