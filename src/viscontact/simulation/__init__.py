"""Runs over time and over speed: checks, grids, marches, error bars."""
