"""Half-space operators: influence coefficients, convolution, stresses below the surface."""
