"""Sweeps, many runs of one command: their designs, manifest, states and joint result."""
