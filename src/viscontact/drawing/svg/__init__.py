"""Display of objects and results in notebooks and terminals: small drawings and tables.

Objects call it by themselves (`viscontact.units.display`). Drawings are SVG written by hand, so
that they need no plotting library, take the colours of the page around them, and stay small.
"""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: pages need the elements of HTML only.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
