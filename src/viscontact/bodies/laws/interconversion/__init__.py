"""Interconversion of creep and relaxation, in closed form and by numbers."""
