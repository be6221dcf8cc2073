"""Exact solutions for verification, in SI units, independent of the solver.

The elastic ones take the contact modulus E* [Pa], the viscoelastic ones a creep compliance
J(t) [1/Pa] and its convolution inverse M(t) [Pa] as callables, or just one of the two.
"""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: few runs need all of them.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
