"""Load histories: force or approach over time, eccentricity and tilt."""

from viscontact.bodies.loads import *
from viscontact.bodies.loads import __all__ as __all__
