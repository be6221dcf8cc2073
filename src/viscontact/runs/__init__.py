"""Runs: one or many, prepared, forecast, recorded in a directory, as processes."""
