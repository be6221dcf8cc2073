"""Runs: single or parallel, their checks and forecasts, run directories and processes."""
