"""Array types, Fourier transforms and threads: what the numerical rooms stand on."""
