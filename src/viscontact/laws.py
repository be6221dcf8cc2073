"""Linear viscoelastic creep laws: compliance Phi(t) and shear modulus G(t)."""

from viscontact.bodies.laws import *
from viscontact.bodies.laws import __all__ as __all__
