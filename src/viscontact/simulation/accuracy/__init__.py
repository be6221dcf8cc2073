"""Error bars: coarser runs of the same problem, and Richardson extrapolation."""
