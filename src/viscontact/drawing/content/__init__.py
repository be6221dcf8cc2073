"""Figures as plain data, made from results without a plotting library."""
