"""Time integration of the viscoelastic half-space: hereditary integral, time steps, their error.

Because the half-space kernel separates into space and time, the displacement is the hereditary
integral u(t) = ∫ J(t - t') dq(t') of the unit displacement q = K p, which the contact solver
computes anyway: the load history costs no convolution in space.
"""
