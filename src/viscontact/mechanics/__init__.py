"""Mechanics of contact: half-spaces and layers, memory, the problem and its solver."""
