"""Figures of creep laws and of what was fitted."""
