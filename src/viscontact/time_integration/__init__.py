"""What a viscoelastic body remembers: time without space.

Because the half-space kernel separates, the displacement is the Boltzmann integral
u(t) = ∫ J(t - t') dq(t') over the *elastic* displacement q = K p per unit compliance, which the
contact solver computes anyway: history costs no convolution.
"""
