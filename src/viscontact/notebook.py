"""Display of objects and results in notebooks and terminals: small drawings and tables."""

from viscontact.drawing.svg import *
from viscontact.drawing.svg import __all__ as __all__
