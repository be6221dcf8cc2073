"""Time integration of the viscoelastic half-space: hereditary integral, time steps, their error.

Because the half-space kernel separates into space and time, the displacement is the hereditary
integral u(t) = ∫ J(t - t') dq(t') of the unit displacement q = K p, which the contact solver
computes anyway: the load history costs no convolution in space.
"""

from viscontact.backend.lazy_names import attach_stub

# Names of __init__.pyi, each loaded at its first use: few runs need all of them.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
