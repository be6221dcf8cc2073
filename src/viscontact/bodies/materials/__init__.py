"""Materials: elastic constants and creep law, J(t), the shipped library, cards."""

import lazy_loader

# Names of __init__.pyi, which results record; each is loaded at its first use.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
