"""Frictional equilibrium of one time step: tractions along the surface, within what slips."""
