"""Execution of a recorded run: its check, its directory, its march and its end."""
