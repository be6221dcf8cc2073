"""Figures of pressure, contact edge, surface and stress."""
