"""Case files: reading, checking, and conversion to the objects of a run.

Names are loaded at their first use, so that the shipped cases are listed fast.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
