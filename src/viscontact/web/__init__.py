"""Calculator page: a web server for one user on their own machine.

Only the command `serve` imports it.
"""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: the page is shown before.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
