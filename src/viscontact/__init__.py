"""Contact of creeping bodies: viscoelastic half-space contact mechanics, over time.

Names are loaded when first used, so that ``import viscontact`` stays fast. The stub
``__init__.pyi`` lists them, both for this module and for type checkers and editors.
"""

from viscontact.backend.lazy_names import attach_stub as _attach_stub

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = _attach_stub(__name__, __file__)
__all__ += ["__version__"]
