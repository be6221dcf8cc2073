"""Runs in processes of their own: arguments, start, progress and stop."""
