"""Indenter shapes: each gives its initial gap to a plane."""

from viscontact.bodies.indenters import *
from viscontact.bodies.indenters import __all__ as __all__
