"""Figures: their content, decided once, and its renderers."""
