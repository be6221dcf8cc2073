"""Measured surfaces: reading, repair, levelling, resampling, and conversion to an indenter."""

from viscontact.bodies.surfaces import *
from viscontact.bodies.surfaces import __all__ as __all__
