"""Pressures that are given: maps and formulas, and the displacement under them."""
