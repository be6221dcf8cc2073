"""Measured surfaces: reading, repair, levelling, conversion to an indenter, and a theory."""

from viscontact.bodies.surfaces import *
from viscontact.bodies.surfaces import __all__ as _names
from viscontact.results.persson import persson_area as persson_area
from viscontact.results.persson import persson_sliding as persson_sliding

__all__ = [*_names, "persson_area", "persson_sliding"]
