"""Figures of contacts in steady motion: friction over speed, pressure along the motion."""
